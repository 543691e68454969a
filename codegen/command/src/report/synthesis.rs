//! Writes the solutions of a synthesis as text.

use std::collections::BTreeSet;
use std::io::{self, Write};

use linkwright_calibrate::{Bounds, SearchCounts, StartSampling, Synthesis};
use linkwright_codegen::stages::model::si_unit;
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::View as _;
use linkwright_solver::data::Data;
use linkwright_solver::number::{counted, scientific, time};

use super::aligned::aligned;
use super::measured_data::{taken_for, write_data, write_notes};
use crate::command::synthesize::Certified;

/// Digits of a parameter, of a difference, and of a measure.
const DIGITS: usize = 9;
const DIFFERENCE_DIGITS: usize = 3;
const MEASURE_DIGITS: usize = 6;

/// Difference in sizes of its column that is put down to rounding.
const ROUNDED: f64 = 1e-10;

/// Synthesis to report.
pub struct Report<'a> {
    /// Description with the initial values.
    pub derived: &'a Derived,
    /// Table of targets.
    pub data: &'a Data,
    /// Search.
    pub synthesis: &'a Synthesis,
    /// Chosen parameters with their bounds.
    pub bounds: &'a [(String, Bounds)],
    /// Permitted difference of each column in SI units, if it is given.
    pub permitted: &'a [Option<f64>],
    /// First and last time of the motion (s).
    pub range: [f64; 2],
    /// Drive that turns once in the range; `None` for another range.
    pub turning: Option<&'a str>,
    /// Solutions, the best first.
    pub solutions: &'a [Certified],
    /// Reasons for which candidates are left out.
    pub rejected: &'a [String],
    /// Search in numbers.
    pub search: Search,
}

/// Search in numbers.
#[derive(Clone, Copy, Debug)]
pub struct Search {
    /// Counts.
    pub counts: SearchCounts,
    /// Requested counts.
    pub requested: StartSampling,
    /// True if Ctrl-C ended it.
    pub is_interrupted: bool,
}

/// Differences of a column from its targets, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Differences {
    /// Root of the mean square.
    pub rms: f64,
    /// Largest magnitude.
    pub largest: f64,
    /// Index of its row.
    pub row: usize,
}

impl Report<'_> {
    /// Returns the differences of a column.
    pub fn differences(&self, solution: &Certified, column: usize) -> Differences {
        let rows = solution.candidate.residuals[column].iter().enumerate();
        let rows = rows.filter_map(|(row, it)| Some((row, (*it)?)));
        let (mut squares, mut count) = (0.0, 0_usize);
        let (mut largest, mut at) = (0.0_f64, 0);
        for (row, residual) in rows {
            squares += residual * residual;
            count += 1;
            if residual.abs() > largest {
                (largest, at) = (residual.abs(), row);
            }
        }
        Differences {
            rms: (squares / count.max(1) as f64).sqrt(),
            largest,
            row: at,
        }
    }

    /// True if all differences of a solution are permitted.
    pub fn is_within(&self, solution: &Certified) -> bool {
        let mut permitted = self.permitted.iter().enumerate();
        permitted.all(|(column, permitted)| {
            permitted.is_none_or(|it| self.differences(solution, column).largest <= it)
        })
    }

    /// Returns the error of a search without a solution.
    pub fn without_solution(&self) -> String {
        let title = self.derived.system.mechanism.title();
        let counts = self.search.counts;
        let (cause, help) = match (counts.moving, self.rejected.first()) {
            (0, _) => (
                format!(
                    "none of {} mechanisms moves over the whole range",
                    counts.sampled
                ),
                "draw the mechanism nearer to its motion, change the bounds with `--param`, or sample more with `--samples`",
            ),
            (_, None) => (
                "no fit keeps all limits and the order of the rows".to_string(),
                "widen the bounds with `--param`, relax a limit, or fit more with `--fits`",
            ),
            (_, Some(reason)) => (
                format!("the best candidate {reason}"),
                "change the bounds with `--param`, or fit more with `--fits`",
            ),
        };
        format!("error: no solution is found for `{title}`: {cause}\n  = help: {help}")
    }

    /// Returns the names of the loops, each with the words of its mode in a solution.
    pub fn modes(&self, solution: &Certified) -> Vec<(String, &'static str)> {
        let names = self.synthesis.view().mode_names().into_iter();
        let closed = names.filter(|it| it.is_closed);
        let modes = closed.map(|it| {
            let mode = solution.candidate.modes.closed[it.place];
            let sign = match mode {
                linkwright::Branch::Positive => "positive",
                linkwright::Branch::Negative => "negative",
            };
            (it.name, sign)
        });
        modes.collect()
    }
}

/// Writes the report.
///
/// # Errors
/// Errors of `output`.
pub fn write(report: &Report<'_>, output: &mut dyn Write) -> io::Result<()> {
    let title = report.derived.system.mechanism.title();
    write_data(&title, report.data, output)?;
    write_notes(report.data, output)?;
    let [from, to] = report.range.map(time);
    let turn = match report.turning {
        Some(drive) => format!(", one turn of `{drive}`"),
        None => String::new(),
    };
    writeln!(output, "moves from t = {from} s to {to} s{turn}")?;
    let counts = report.search.counts;
    writeln!(
        output,
        "{} in {} of assembly modes, of which {} move over the whole range; {}{}\n",
        counted(counts.sampled, "sampled mechanism"),
        counted(counts.modes, "combination"),
        counts.moving,
        counted(counts.fitted, "fit"),
        match report.search.is_interrupted {
            true => ", interrupted",
            false => "",
        }
    )?;
    if report.solutions.is_empty() {
        return Ok(());
    }
    aligned(&rows(report), output)?;
    let proven = match report.solutions.len() {
        1 => "the solution is",
        _ => "all solutions are",
    };
    writeln!(
        output,
        "\n{proven} proven to move on one smooth path from t = {from} s to {to} s"
    )?;
    if !report.derived.system.mechanism.limits.is_empty() {
        let unproven: BTreeSet<&str> = report
            .solutions
            .iter()
            .flat_map(|it| &it.unproven_limits)
            .map(String::as_str)
            .collect();
        match unproven.is_empty() {
            true => writeln!(
                output,
                "their limits are proven to be kept, between frames too"
            )?,
            false => {
                let names: Vec<&str> = unproven.into_iter().collect();
                let names = names.join(", ");
                writeln!(
                    output,
                    "limits are kept, by located extremes between frames and without a proof for: {names}"
                )?;
            }
        }
    }
    if !report.rejected.is_empty() {
        let count = counted(report.rejected.len(), "better or equal candidate");
        writeln!(
            output,
            "left out: {count}, the first of which {}",
            report.rejected[0]
        )?;
    }
    Ok(())
}

fn rows(report: &Report<'_>) -> Vec<Vec<String>> {
    let units = report.derived.system.mechanism.units.of_tables();
    let solutions = report.solutions;
    let row = |name: String, cells: &dyn Fn(&Certified) -> String| {
        let cells = solutions.iter().map(cells);
        std::iter::once(name).chain(cells).collect::<Vec<String>>()
    };
    let numbers = (1..=solutions.len()).map(|it| format!("solution {it}"));
    let mut rows = vec![std::iter::once(String::new()).chain(numbers).collect()];
    for (column, measured) in report.data.measured.iter().enumerate() {
        let [quantity, _] = taken_for(measured);
        let name = match measured.scale.text.as_str() {
            "" => quantity,
            unit => format!("{quantity} ({unit})"),
        };
        let size = report.synthesis.targets().columns[column].size;
        let in_unit = |si: f64| match si.abs() < ROUNDED * size {
            true => "0".to_string(),
            false => scientific(measured.scale.unit.of_si(si), DIFFERENCE_DIGITS),
        };
        rows.push(row(format!("rms of {name}"), &|it| {
            in_unit(report.differences(it, column).rms)
        }));
        rows.push(row("  largest".to_string(), &|it| {
            let differences = report.differences(it, column);
            let verdict = match report.permitted[column] {
                Some(permitted) if differences.largest > permitted => ", beyond",
                _ => "",
            };
            format!(
                "{} in row {}{verdict}",
                in_unit(differences.largest),
                differences.row + 1
            )
        }));
    }
    let parameters = &report.derived.system.mechanism.parameters;
    for (place, name) in report.synthesis.names().iter().enumerate() {
        let mut named = parameters.iter().filter(|it| it.name == *name);
        let unit = named
            .next()
            .map_or(String::new(), |it| si_unit(it.dimension));
        let unit = units.of(&unit);
        let label = match unit.name.as_str() {
            "" => name.clone(),
            own => format!("{name} ({own})"),
        };
        rows.push(row(label, &|it| {
            let value = it.candidate.values[place];
            let bounds = report.bounds.iter().find(|it| it.0 == *name);
            let at = match bounds.and_then(|it| it.1.reached(value, value)) {
                Some(_) => ", at its bound",
                None => "",
            };
            format!("{}{at}", unit.rounded(value, DIGITS))
        }));
    }
    let loops = solutions.first().map_or(Vec::new(), |it| report.modes(it));
    for (place, (name, _)) in loops.into_iter().enumerate() {
        rows.push(row(name, &|it| report.modes(it)[place].1.to_string()));
    }
    let measurements = &report.derived.system.mechanism.measurements;
    for (place, measurement) in measurements.iter().enumerate() {
        let unit = units.of(&measurement.unit());
        rows.push(row(measurement.name.clone(), &|it| {
            let mut ranges = it.check.measured.ranges.iter();
            let range = ranges.find(|it| it.measurement == place);
            range.map_or(String::new(), |range| {
                let ends = [range.smallest.value, range.largest.value];
                let [low, high] = ends.map(|it| unit.rounded(it, MEASURE_DIGITS));
                unit.labeled(format!("{low} to {high}"))
            })
        }));
    }
    rows.push(row("smallest sine of a loop".to_string(), &|it| {
        let measure = it.check.smallest_measure();
        measure.map_or("none".to_string(), |it| format!("{it:.4}"))
    }));
    rows
}
