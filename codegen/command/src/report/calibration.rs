//! Reports a fit as tables of text or as one JSON object.
//!
//! | key | value |
//! |---|---|
//! | `mechanism`, `data`, `read` | as in `compare` |
//! | `parameters` | `{name, unit, start, value, deviation, interval, bound}` each, in SI or requested units; `deviation` and `interval` (of 95 %) are null if the motion does not determine the parameter, `bound` is the end of its range that the value has reached |
//! | `correlations` | a row for each parameter; null if either parameter is undetermined |
//! | `columns` | `{column, quantity, unit, count, deviation, rms_before, rms_after, noise, reduced, chance, runs, expected_runs, explained}` each, in the unit of the column; undetermined values are null; `counts_turns` is true of the rate of an angle in `1/min` or `Hz` |
//! | `trusted`, `reasons` | true if the fit can be trusted, and the reasons against it, in sentences |
//! | `freedom` | number of measured values minus number of determined parameters |
//! | `rank`, `condition` | number of determined combinations, and condition of the scaled sensitivities |
//! | `indistinct` | `{parameters, changes, index}` each: combinations that the data do not determine (`index` null) or barely determine |

use std::io::{self, Write};

use linkwright_calibrate::{Fit, Identification};
use linkwright_codegen::stages::system::System;
use linkwright_codegen::stages::units::OutputUnit;
use linkwright_solver::number::{counted, fixed, scientific};
use serde::Serialize;

use super::aligned::aligned;
use super::measured_data::{taken_for, write_data, write_notes};
use linkwright_solver::data::{Data, Measured};

/// Decimals of numbers in scientific notation.
const DIGITS: usize = 2;

/// Decimals of residuals.
const RESIDUAL_DIGITS: usize = 3;

/// Reduced χ² below which a column is refused for its runs.
const RUNS_LIMIT: f64 = 2.0;

/// Largest number of parameters whose correlations are printed.
const TABLED: usize = 12;

/// Fit to report.
pub struct Report<'a> {
    /// Name of the mechanism in messages.
    pub title: String,
    /// Measured values.
    pub data: &'a Data,
    /// Equations.
    pub system: &'a System,
    /// Names of the fitted parameters.
    pub names: &'a [String],
    /// Values of the parameters at the start, in SI units.
    pub start: &'a [f64],
    /// Result.
    pub fit: &'a Fit,
}

impl Report<'_> {
    /// Unit in which a parameter is reported.
    fn unit(&self, place: usize) -> OutputUnit {
        let mechanism = &self.system.mechanism;
        let mut parameters = mechanism.parameters.iter();
        let parameter = parameters.find(|it| it.name == self.names[place]);
        let si = parameter.map_or(String::new(), |it| it.dimension.unit_if_known());
        mechanism.units.of_tables().of(&si)
    }

    /// Returns the residuals of a column before and after the fit (root mean square), in the unit of the column.
    fn left(&self, column: usize) -> [f64; 2] {
        let unit = self.data.measured[column].scale.unit;
        [0, 1].map(|stage: usize| {
            let residuals = self.fit.residuals[stage][column].iter().flatten();
            let (count, square) = residuals.fold((0.0_f64, 0.0), |(count, square), it| {
                (count + 1.0, square + it * it)
            });
            unit.of_si((square / count.max(1.0)).sqrt())
        })
    }
}

impl Report<'_> {
    /// Returns the reasons against trusting the fit, one sentence each.
    pub fn reasons(&self) -> Vec<String> {
        let fit = self.fit;
        let mut reasons = Vec::new();
        for (place, name) in self.names.iter().enumerate() {
            if !fit.identified.determines(place) && fit.at_bound[place].is_none() {
                reasons.push(format!(
                    "`{name}` is not determined and keeps its value {}",
                    with_unit(fit.values[place], &self.unit(place))
                ));
            }
            if let Some(bound) = fit.at_bound[place] {
                let bound = with_unit(bound, &self.unit(place));
                reasons.push(format!("`{name}` ends at its bound {bound}"));
            }
        }
        if fit.freedom == 0 {
            reasons.push("no redundant value remains to judge the fit".to_string());
        }
        for (place, own) in self.data.measured.iter().enumerate() {
            if fit.goodness.explains(place) != Some(false) {
                continue;
            }
            let goodness = &fit.goodness.columns[place];
            let unit = &own.scale.text;
            let noise = own.scale.unit.of_si(goodness.noise.unwrap_or(f64::NAN));
            let left = self.left(place)[1];
            let [left, noise] = [left, noise].map(|it| scientific(it, DIGITS));
            let told = match goodness.is_given {
                true => "`--deviation` says",
                false => "neighboring rows show",
            };
            reasons.push(match goodness.runs {
                Some((runs, expected, _)) if goodness.reduced.is_some_and(|it| it < RUNS_LIMIT) => {
                    format!(
                        "the residual of `{}` is not noise: its signs change in {runs} runs, where {expected:.0} are expected",
                        own.name
                    )
                }
                _ => format!(
                    "{left} {unit} are left of `{}`, where {told} a noise of {noise} {unit}",
                    own.name
                ),
            });
        }
        if reasons.is_empty() && !fit.goodness.explains_all() {
            reasons.push(
                "the residuals of all columns together exceed the noise that neighboring rows show"
                    .to_string(),
            );
        }
        reasons
    }
}

/// Returns a value, given in SI units, with its unit.
fn with_unit(value: f64, unit: &OutputUnit) -> String {
    unit.labeled(unit.of_si(value))
}

fn count(measured: &Measured) -> usize {
    measured.values.iter().flatten().count()
}

/// Writes the interpretation of the table, and the parameters that this motion cannot distinguish. Both are known before the fit.
///
/// # Errors
/// Errors of `output`.
pub fn write_head(
    title: &str,
    data: &Data,
    identified: &Identification,
    output: &mut dyn Write,
) -> io::Result<()> {
    write_data(title, data, output)?;
    for sentence in identified.sentences() {
        writeln!(output, "{sentence}")?;
    }
    writeln!(output)
}

/// Writes the tables after the head.
///
/// # Errors
/// Errors of `output`.
pub fn write(report: &Report<'_>, output: &mut dyn Write) -> io::Result<()> {
    let fit = report.fit;
    let mut rows = vec![
        [
            "parameter",
            "unit",
            "before",
            "fitted",
            "deviation",
            "95 % from",
            "to",
        ]
        .map(str::to_string)
        .to_vec(),
    ];
    for (place, name) in report.names.iter().enumerate() {
        let unit = report.unit(place);
        let deviation = fit.deviations[place].map(|it| unit.of_si(it));
        let rounded = |value: f64| match deviation.filter(|it| *it > 0.0) {
            Some(deviation) => fixed(
                value,
                (1.0 - deviation.log10().floor()).clamp(0.0, 15.0) as usize,
            ),
            None => value.to_string(),
        };
        let fitted = match deviation {
            Some(_) => rounded(unit.of_si(fit.values[place])),
            None => "not determined".to_string(),
        };
        let interval = fit.intervals[place];
        let end =
            |place: usize| interval.map_or(String::new(), |it| rounded(unit.of_si(it[place])));
        rows.push(vec![
            name.clone(),
            unit.name.clone(),
            rounded(unit.of_si(report.start[place])),
            fitted,
            deviation.map_or(String::new(), |it| scientific(it, DIGITS)),
            end(0),
            end(1),
        ]);
    }
    aligned(&rows, output)?;
    let determined = fit.deviations.iter().flatten().count();
    if determined > 1 && report.names.len() <= TABLED {
        writeln!(output)?;
        let mut heading = vec!["correlation".to_string()];
        heading.extend(report.names.iter().cloned());
        let mut rows = vec![heading];
        for (name, row) in report.names.iter().zip(&fit.correlations) {
            let cells = row
                .iter()
                .map(|it| it.map_or(String::new(), |it| fixed(it, 3)));
            rows.push([name.clone()].into_iter().chain(cells).collect());
        }
        aligned(&rows, output)?;
    }
    writeln!(output)?;
    let heading = [
        "column",
        "quantity",
        "unit",
        "values",
        "rms before",
        "rms after",
        "noise",
        "χ²/ν",
    ];
    let mut rows = vec![heading.map(str::to_string).to_vec()];
    for (place, own) in report.data.measured.iter().enumerate() {
        let [quantity, unit] = taken_for(own);
        let left = report.left(place).map(|it| scientific(it, RESIDUAL_DIGITS));
        let mut row = vec![own.name.clone(), quantity, unit, count(own).to_string()];
        row.extend(left);
        let goodness = &fit.goodness.columns[place];
        let noise = goodness.noise.map(|it| own.scale.unit.of_si(it));
        row.push(noise.map_or("unknown".to_string(), |it| scientific(it, DIGITS)));
        row.push(
            goodness
                .reduced
                .map_or(String::new(), |it| scientific(it, DIGITS)),
        );
        rows.push(row);
    }
    aligned(&rows, output)?;
    writeln!(output)?;
    write_notes(report.data, output)?;
    let condition = scientific(fit.identified.condition, 1);
    match fit.identified.determines_all() {
        true => writeln!(
            output,
            "this motion determines {}: condition {condition}, {} left over",
            match report.names.len() {
                1 => "the parameter".to_string(),
                count => format!("all {count} parameters"),
            },
            counted(fit.freedom, "value")
        ),
        false => writeln!(
            output,
            "this motion determines {} of {} combinations",
            fit.identified.rank(),
            report.names.len()
        ),
    }?;
    let reasons = report.reasons();
    for reason in &reasons {
        writeln!(output, "{reason}")?;
    }
    let verdict = match (fit.is_trusted(), fit.goodness.is_judged()) {
        (false, _) => "this fit is not to be trusted",
        (true, true) => "this fit is to be trusted: noise explains the residuals",
        (true, false) => {
            "too few rows show their noise: give it with `--deviation` to judge the fit"
        }
    };
    writeln!(output, "{verdict}")
}

#[derive(Serialize)]
struct Object<'a> {
    mechanism: &'a str,
    data: &'a str,
    read: String,
    parameters: Vec<Parameter<'a>>,
    correlations: &'a [Vec<Option<f64>>],
    columns: Vec<Column<'a>>,
    freedom: usize,
    rank: usize,
    condition: f64,
    indistinct: Vec<Combination<'a>>,
    trusted: bool,
    reasons: Vec<String>,
}

#[derive(Serialize)]
struct Parameter<'a> {
    name: &'a str,
    unit: String,
    start: f64,
    value: f64,
    deviation: Option<f64>,
    interval: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    bound: Option<f64>,
}

#[derive(Serialize)]
struct Column<'a> {
    column: &'a str,
    quantity: &'a str,
    unit: &'a str,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    counts_turns: bool,
    count: usize,
    deviation: f64,
    rms_before: f64,
    rms_after: f64,
    noise: Option<f64>,
    reduced: Option<f64>,
    chance: Option<f64>,
    runs: Option<usize>,
    expected_runs: Option<f64>,
    explained: Option<bool>,
}

#[derive(Serialize)]
struct Combination<'a> {
    parameters: Vec<&'a str>,
    changes: Vec<f64>,
    index: Option<f64>,
}

/// Writes the object and a line break.
///
/// # Errors
/// Errors of `output`.
pub fn write_json(report: &Report<'_>, output: &mut dyn Write) -> io::Result<()> {
    let fit = report.fit;
    let parameters = report.names.iter().enumerate().map(|(place, name)| {
        let unit = report.unit(place);
        Parameter {
            start: unit.of_si(report.start[place]),
            value: unit.of_si(fit.values[place]),
            deviation: fit.deviations[place].map(|it| unit.of_si(it)),
            interval: fit.intervals[place].map(|it| it.map(|it| unit.of_si(it))),
            bound: fit.at_bound[place].map(|it| unit.of_si(it)),
            unit: unit.name,
            name,
        }
    });
    let columns = report.data.measured.iter().enumerate().map(|(place, own)| {
        let [rms_before, rms_after] = report.left(place);
        let goodness = &fit.goodness.columns[place];
        Column {
            column: &own.name,
            quantity: &own.quantity.name,
            unit: &own.scale.text,
            counts_turns: own.scale.counts_turns,
            count: count(own),
            deviation: own.scale.unit.of_si(fit.column_deviations[place]),
            rms_before,
            rms_after,
            noise: goodness.noise.map(|it| own.scale.unit.of_si(it)),
            reduced: goodness.reduced,
            chance: goodness.chance,
            runs: goodness.runs.map(|it| it.0),
            expected_runs: goodness.runs.map(|it| it.1),
            explained: fit.goodness.explains(place),
        }
    });
    let indistinct = fit.identified.indistinct.iter().map(|it| Combination {
        parameters: it
            .changes
            .iter()
            .map(|it| report.names[it.0].as_str())
            .collect(),
        changes: it.changes.iter().map(|it| it.1).collect(),
        index: it.index,
    });
    let object = Object {
        mechanism: &report.title,
        data: &report.data.name,
        read: report.data.columns.reading(),
        parameters: parameters.collect(),
        correlations: &fit.correlations,
        columns: columns.collect(),
        freedom: fit.freedom,
        rank: fit.identified.rank(),
        condition: fit.identified.condition,
        indistinct: indistinct.collect(),
        trusted: fit.is_trusted(),
        reasons: report.reasons(),
    };
    serde_json::to_writer_pretty(&mut *output, &object)?;
    writeln!(output)
}
