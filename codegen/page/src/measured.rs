//! Writes the extremes of measures and the broken limits of a motion, as text and for JSON.

use std::io::{self, Write};

use linkwright_codegen::stages::units::OutputUnit;
use linkwright_solver::measure_watch::TimedValue;
use linkwright_solver::number::time;
use linkwright_solver::{Check, View};
use serde::Serialize;

/// Digits of a printed value.
const DIGITS: usize = 9;

/// Relative difference of extremes below which a measure is printed as constant.
const CONSTANT: f64 = 1e-12;

/// Units of the printed time of an extreme, per second.
const TIME_UNITS: f64 = 1e7;

/// Extremes of a measure.
#[derive(Serialize)]
pub struct Extremes<'a> {
    measure: &'a str,
    unit: String,
    smallest: Timed,
    largest: Timed,
}

/// Value at a time.
#[derive(Serialize)]
pub struct Timed {
    value: f64,
    t: f64,
}

/// Broken limit.
#[derive(Serialize)]
pub struct Broken<'a> {
    measure: &'a str,
    limit: String,
    intervals: &'a [[f64; 2]],
    beyond: f64,
    t: f64,
}

/// Returns the extremes of all measures.
pub fn extremes(check: &Check) -> Vec<Extremes<'_>> {
    let mechanism = &check.interpreted.system().mechanism;
    let units = mechanism.units.of_tables();
    let ranges = check.measured.ranges.iter().map(|range| {
        let measurement = &mechanism.measurements[range.measurement];
        let unit = units.of(&measurement.unit());
        let timed = |it: TimedValue| Timed {
            value: unit.of_si(it.value),
            t: it.t,
        };
        Extremes {
            measure: &measurement.name,
            smallest: timed(range.smallest),
            largest: timed(range.largest),
            unit: unit.name.clone(),
        }
    });
    ranges.collect()
}

/// Returns the broken limits.
pub fn broken(check: &Check) -> Vec<Broken<'_>> {
    let mechanism = &check.interpreted.system().mechanism;
    let units = mechanism.units.of_tables();
    let broken = check.measured.broken.iter().map(|broken| {
        let limit = &mechanism.limits[broken.limit];
        let measurement = &mechanism.measurements[limit.measurement];
        let unit = units.of(&measurement.unit());
        Broken {
            measure: &measurement.name,
            limit: limit.text(&units),
            intervals: &broken.intervals,
            beyond: unit.of_si(-limit.margin(broken.worst.value)),
            t: broken.worst.t,
        }
    });
    broken.collect()
}

/// Writes the extremes of measures, and where limits are broken; nothing if nothing is measured.
///
/// # Errors
/// Errors of `output`.
pub fn write(check: &Check, output: &mut dyn Write) -> io::Result<()> {
    let mechanism = &check.interpreted.system().mechanism;
    let units = mechanism.units.of_tables();
    let ranges = &check.measured.ranges;
    if let (Some([from, to]), false) = (check.range, ranges.is_empty()) {
        let [from, to] = [from, to].map(time);
        writeln!(
            output,
            "\nmeasures from t = {from} s to {to} s, between frames too"
        )?;
    }
    let names = mechanism.measurements.iter().map(|it| it.name.len());
    let width = names.max().unwrap_or(0);
    for range in ranges {
        let measurement = &mechanism.measurements[range.measurement];
        let unit = units.of(&measurement.unit());
        let name = &measurement.name;
        if is_constant(range.smallest.value, range.largest.value) {
            let value = unit.labeled(unit.rounded(range.smallest.value, DIGITS));
            writeln!(output, "  {name:width$}  always {value}")?;
            continue;
        }
        let [low, high] = [range.smallest, range.largest].map(|it| text(it, &unit));
        writeln!(output, "  {name:width$}  from {low} to {high}")?;
    }
    for broken in &check.measured.broken {
        let limit = &mechanism.limits[broken.limit];
        let measurement = &mechanism.measurements[limit.measurement];
        let unit = units.of(&measurement.unit());
        let beyond = unit.labeled(unit.rounded(-limit.margin(broken.worst.value), DIGITS));
        writeln!(
            output,
            "broken: `{}` must be {}; it is beyond by up to {beyond}, at t = {} s",
            measurement.name,
            limit.text(&units),
            time((broken.worst.t * TIME_UNITS).round() / TIME_UNITS)
        )?;
        for [first, last] in &broken.intervals {
            let [first, last] = [*first, *last].map(time);
            writeln!(output, "  from t = {first} s to {last} s")?;
        }
    }
    Ok(())
}

/// True if the extremes of a quantity differ by rounding alone.
pub fn is_constant(low: f64, high: f64) -> bool {
    high - low <= CONSTANT * low.abs().max(high.abs())
}

/// Returns a value with its unit and its time.
pub(crate) fn text(it: TimedValue, unit: &OutputUnit) -> String {
    let value = unit.labeled(unit.rounded(it.value, DIGITS));
    format!("{value} at t = {} s", time_of_extreme(it.t))
}

/// Returns the time of an extreme, in s. An extreme is flat: half of the digits of a number determine its time.
pub(crate) fn time_of_extreme(t: f64) -> String {
    time((t * TIME_UNITS).round() / TIME_UNITS)
}
