//! Writes the spread of measures by tolerances as text.

use std::io::{self, Write};

use linkwright_codegen::stages::model::{Distribution, si_unit};
use linkwright_codegen::stages::units::{OutputUnit, OutputUnits};
use linkwright_solver::number::{counted, time};
use linkwright_solver::stack_up::{
    LinearSpread, Moments, QUANTILES, SampledSpread, StackUp, Toleranced, departures,
};
use linkwright_solver::{Interpreted, View as _};

use super::aligned::aligned;

/// Digits of a printed spread, and of a value about which it lies.
const DIGITS: usize = 4;
const VALUE_DIGITS: usize = 9;

/// Spread to report.
pub struct Report<'a> {
    /// Mechanism.
    pub blocks: &'a Interpreted,
    /// First order.
    pub spread: &'a StackUp,
    /// Sampled mechanisms; `None` without samples.
    pub sampled: Option<&'a SampledSpread>,
    /// Sequence of the samples, in words.
    pub sequence: &'a str,
    /// Seed of the samples.
    pub seed: u64,
}

impl Report<'_> {
    /// Returns the units of the report.
    pub fn units(&self) -> OutputUnits {
        self.blocks.system().mechanism.units.of_tables()
    }

    /// Returns name and unit of each measure.
    pub fn measures(&self) -> Vec<(String, OutputUnit)> {
        let units = self.units();
        let measurements = self.blocks.system().mechanism.measurements.iter();
        measurements
            .map(|it| (it.name.clone(), units.of(&it.unit())))
            .collect()
    }

    /// Returns the sources of spread: parameters, and loose pins by their first component.
    pub fn sources(&self) -> Vec<&Toleranced> {
        let all = self.spread.toleranced.iter();
        all.filter(|it| it.begins_source()).collect()
    }

    /// Returns the name of a source: that of a parameter, or of the joint of a loose pin.
    pub fn source_name(&self, it: &Toleranced) -> &str {
        let mechanism = &self.blocks.system().mechanism;
        let parameter = &mechanism.parameters[it.parameter];
        match it.distribution {
            Distribution::Clearance { .. } => {
                // Offsets follow the parameters, two for each clearance.
                let stated = mechanism.parameters.len() - 2 * mechanism.clearances.len();
                let clearance = &mechanism.clearances[(it.parameter - stated) / 2];
                &mechanism.joints[clearance.joint].label
            }
            _ => &parameter.name,
        }
    }
}

/// Returns the place of the largest number; `None` without numbers.
pub fn largest(values: impl Iterator<Item = f64>) -> Option<usize> {
    let numbers = values.enumerate().filter(|it| !it.1.is_nan());
    let best = numbers.reduce(|best, it| if it.1 > best.1 { it } else { best });
    best.map(|it| it.0)
}

fn short(unit: &OutputUnit, si: f64) -> String {
    unit.rounded(si, DIGITS).to_string()
}

/// Writes the first order.
///
/// # Errors
/// Errors of `output`.
pub fn write_linear(report: &Report<'_>, output: &mut dyn Write) -> io::Result<()> {
    let times = &report.spread.times;
    let mechanism = &report.blocks.system().mechanism;
    let units = report.units();
    let [first, last] = [times.first(), times.last()].map(|it| time(it.copied().unwrap_or(0.0)));
    writeln!(
        output,
        "{}: from t = {first} s to {last} s in {}",
        mechanism.title(),
        counted(times.len(), "frame")
    )?;
    let mut rows = vec![
        ["source", "value", "distribution"]
            .map(String::from)
            .to_vec(),
    ];
    for it in report.sources() {
        let parameter = &mechanism.parameters[it.parameter];
        let unit = units.of(&si_unit(parameter.dimension));
        let value = match it.distribution {
            Distribution::Clearance { .. } => String::new(),
            _ => format!("{} {}", unit.rounded(it.nominal, VALUE_DIGITS), unit.name),
        };
        let tolerance = it.distribution.text(parameter.dimension, &units);
        rows.push(vec![
            report.source_name(it).to_string(),
            value.trim_end().to_string(),
            tolerance,
        ]);
    }
    aligned(&rows, output)?;
    for ((name, unit), measure) in report.measures().iter().zip(&report.spread.measures) {
        let how = match measure.is_exact {
            true => "exact derivatives",
            false => "derivatives by differences",
        };
        writeln!(output, "\n{}, first order with {how}", headed(name, unit))?;
        write_measure(report, unit, measure, output)?;
    }
    Ok(())
}

/// Returns a name with its unit.
pub fn headed(name: &str, unit: &OutputUnit) -> String {
    match unit.name.as_str() {
        "" => name.to_string(),
        unit => format!("{name} in {unit}"),
    }
}

fn write_measure(
    report: &Report<'_>,
    unit: &OutputUnit,
    measure: &LinearSpread,
    output: &mut dyn Write,
) -> io::Result<()> {
    let StackUp {
        times, toleranced, ..
    } = report.spread;
    let worst = largest(measure.worst.iter().copied());
    let spread = largest(measure.deviation.iter().copied());
    let (Some(worst), Some(spread)) = (worst, spread) else {
        return writeln!(output, "  neighboring mechanisms cannot be solved");
    };
    for (what, sign, values, place) in [
        ("largest worst case", "±", &measure.worst, worst),
        ("largest standard deviation", "", &measure.deviation, spread),
    ] {
        let (value, t) = (short(unit, values[place]), time(times[place]));
        writeln!(output, "  {what:26}  {sign}{value} at t = {t} s")?;
    }
    let limits = measure.limits(worst, toleranced);
    let shares = measure.shares(spread, toleranced);
    let mut rows = vec![
        ["source", "in the worst case", "share of variance"]
            .map(String::from)
            .to_vec(),
    ];
    let sources = report.sources();
    let mut order: Vec<usize> = (0..sources.len()).collect();
    order.sort_by(|a, b| shares[*b].total_cmp(&shares[*a]));
    for it in order {
        let name = report.source_name(sources[it]).to_string();
        let limit = format!("±{}", short(unit, limits[it]));
        rows.push(vec![name, limit, format!("{:.1} %", 100.0 * shares[it])]);
    }
    aligned(&rows, output)
}

/// Writes the spread of sampled mechanisms; nothing without samples.
///
/// # Errors
/// Errors of `output`.
pub fn write_sampled(report: &Report<'_>, output: &mut dyn Write) -> io::Result<()> {
    let Some(sampled) = report.sampled else {
        return Ok(());
    };
    writeln!(
        output,
        "\n{} by {} with seed {}{}",
        counted(sampled.count, "sampled mechanism"),
        report.sequence,
        report.seed,
        match sampled.is_interrupted {
            true => ", interrupted",
            false => "",
        }
    )?;
    let share = |count: usize| 100.0 * count as f64 / sampled.count as f64;
    for (count, what) in [
        (sampled.unassembled, "cannot be assembled"),
        (sampled.ended, "end early"),
    ] {
        if count > 0 {
            writeln!(output, "  {count} ({:.2} %) {what}", share(count))?;
        }
    }
    if let Some((failure, words)) = &sampled.failure {
        let t = time(failure.time);
        writeln!(output, "  the first failure, at t = {t} s: {words}")?;
    }
    let measures = report.measures();
    let measures = measures.iter().zip(&report.spread.measures);
    for (((name, unit), linear), sampled) in measures.zip(&sampled.measures) {
        let Some(place) = largest(sampled.moments.iter().map(|it| it.deviation)) else {
            writeln!(
                output,
                "\n{}: fewer than two are solved",
                headed(name, unit)
            )?;
            continue;
        };
        let t = time(report.spread.times[place]);
        writeln!(
            output,
            "\n{} of the samples, at t = {t} s",
            headed(name, unit)
        )?;
        let nominal = linear.nominal[place];
        let moments = &sampled.moments[place];
        write_moments(unit, nominal, moments, output)?;
        let departures = departures(linear, sampled);
        if departures.is_empty() {
            writeln!(output, "  the first order is enough in all frames")?;
        }
        for it in departures {
            let (what, digits) = match it.is_of_mean {
                true => ("mean", VALUE_DIGITS),
                false => ("standard deviation", DIGITS),
            };
            let [linear, found] = [it.linear, it.sampled].map(|it| unit.rounded(it, digits));
            let frames = counted(report.spread.times.len(), "frame");
            let t = time(report.spread.times[it.place]);
            writeln!(
                output,
                "  the first order is not enough in {} of {frames}: at t = {t} s the {what} is {found}, not {linear}",
                it.instants,
            )?;
        }
    }
    Ok(())
}

fn write_moments(
    unit: &OutputUnit,
    nominal: f64,
    moments: &Moments,
    output: &mut dyn Write,
) -> io::Result<()> {
    let signed = |si: f64| {
        let value = unit.rounded(si, DIGITS);
        match value > 0.0 {
            true => format!("+{value}"),
            false => value.to_string(),
        }
    };
    let value = unit.rounded(nominal, VALUE_DIGITS);
    let mean = signed(moments.mean - nominal);
    writeln!(output, "  departures from the nominal value, {value}")?;
    writeln!(output, "    mean               {mean}")?;
    for (share, quantile) in QUANTILES.iter().zip(moments.quantiles) {
        let share = format!("{} % are below", percent(*share));
        writeln!(output, "    {share:17}  {}", signed(quantile - nominal))?;
    }
    let deviation = short(unit, moments.deviation);
    let error = unit.rounded(moments.error_of_deviation, 2);
    writeln!(
        output,
        "  standard deviation {deviation}, with a standard error of {error}"
    )
}

/// Returns a share in percent, without the rounding of the product.
fn percent(share: f64) -> f64 {
    let percent = format!("{:.3}", 100.0 * share);
    percent.parse().unwrap_or(100.0 * share)
}
