//! Writes the solutions of a synthesis as one JSON object.
//!
//! | key | value |
//! |---|---|
//! | `mechanism`, `motion` | name of the mechanism, and of the motion if there are several |
//! | `data`, `rows` | path of the table, and number of its rows |
//! | `timed` | true if the rows have times |
//! | `from`, `to`, `turn` | first and last time of the motion (s), and name of the drive that turns once between them, or null |
//! | `search` | `{samples, modes, moving, fits, seed, interrupted}`: counts of sampled mechanisms, combinations of modes, mechanisms that move, and fits |
//! | `columns` | `{column, quantity, unit, tolerance}` each |
//! | `solutions` | `{squares, parameters, modes, t, residuals, within, smallest_sine, proof}` each, the best first |
//! | … `squares` | sum of the squared differences in SI units, each divided by the weight of its column |
//! | … `parameters` | `{name, unit, value, low, high}` each |
//! | … `modes` | name of each loop with its sign |
//! | … `t` | time of each row (s) |
//! | … `residuals` | targets minus solved values, column by column and row by row, in the unit of the column; null without a target |
//! | … `within` | true if all differences are permitted |
//! | … `smallest_sine` | measure of the closest approach to a singular pose; null if no pose is singular |
//! | … `proof` | `{from, to, windows, unproven_limits}`: limits that hold by located extremes between frames, without a proof |
//! | `rejected` | reasons for which candidates are left out |

use std::collections::BTreeMap;
use std::io::{self, Write};

use linkwright_codegen::stages::model::si_unit;
use serde::Serialize;

use super::synthesis::Report;
use crate::command::synthesize::Certified;

#[derive(Serialize)]
struct Object<'a> {
    mechanism: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    motion: Option<&'a str>,
    data: &'a str,
    rows: usize,
    timed: bool,
    from: f64,
    to: f64,
    turn: Option<&'a str>,
    search: SearchObject,
    columns: Vec<ColumnObject<'a>>,
    solutions: Vec<SolutionObject>,
    rejected: &'a [String],
}

#[derive(Serialize)]
struct SearchObject {
    samples: usize,
    modes: usize,
    moving: usize,
    fits: usize,
    seed: u64,
    interrupted: bool,
}

#[derive(Serialize)]
struct ColumnObject<'a> {
    column: &'a str,
    quantity: &'a str,
    unit: &'a str,
    tolerance: Option<f64>,
}

#[derive(Serialize)]
struct SolutionObject {
    squares: f64,
    parameters: Vec<ParameterObject>,
    modes: BTreeMap<String, &'static str>,
    t: Vec<f64>,
    residuals: Vec<Vec<Option<f64>>>,
    within: bool,
    smallest_sine: Option<f64>,
    proof: ProvenRange,
}

#[derive(Serialize)]
struct ParameterObject {
    name: String,
    unit: String,
    value: f64,
    low: f64,
    high: f64,
}

#[derive(Serialize)]
struct ProvenRange {
    from: f64,
    to: f64,
    windows: usize,
    unproven_limits: Vec<String>,
}

/// Writes the object and a line break.
///
/// # Errors
/// Errors of `output`.
pub fn write(report: &Report<'_>, output: &mut dyn Write) -> io::Result<()> {
    let mechanism = &report.derived.system.mechanism;
    let counts = report.search.counts;
    let columns = report.data.measured.iter().zip(report.permitted);
    let object = Object {
        mechanism: &mechanism.name,
        motion: mechanism.motion.as_ref().map(|it| it.name.as_str()),
        data: &report.data.name,
        rows: report.data.rows(),
        timed: report.data.time.is_some(),
        from: report.range[0],
        to: report.range[1],
        turn: report.turning,
        search: SearchObject {
            samples: counts.sampled,
            modes: counts.modes,
            moving: counts.moving,
            fits: counts.fitted,
            seed: report.search.requested.seed,
            interrupted: report.search.is_interrupted,
        },
        columns: columns
            .map(|(measured, permitted)| ColumnObject {
                column: &measured.name,
                quantity: &measured.quantity.name,
                unit: &measured.scale.text,
                tolerance: permitted.map(|it| measured.scale.unit.of_si(it)),
            })
            .collect(),
        solutions: report
            .solutions
            .iter()
            .map(|it| solution(report, it))
            .collect(),
        rejected: report.rejected,
    };
    serde_json::to_writer_pretty(&mut *output, &object)?;
    writeln!(output)
}

fn solution(report: &Report<'_>, solution: &Certified) -> SolutionObject {
    let mechanism = &report.derived.system.mechanism;
    let units = mechanism.units.of_tables();
    let candidate = &solution.candidate;
    let parameters = report.synthesis.names().iter().zip(&candidate.values);
    let parameters = parameters.filter_map(|(name, value)| {
        let parameter = mechanism.parameters.iter().find(|it| it.name == *name)?;
        let (_, bounds) = report.bounds.iter().find(|it| it.0 == *name)?;
        let unit = units.of(&si_unit(parameter.dimension));
        Some(ParameterObject {
            name: name.clone(),
            value: unit.of_si(*value),
            low: unit.of_si(bounds.low),
            high: unit.of_si(bounds.high),
            unit: unit.name,
        })
    });
    let residuals = candidate.residuals.iter().zip(&report.data.measured);
    let residuals = residuals.map(|(column, measured)| {
        let column = column.iter();
        let column = column.map(|it| it.map(|it| measured.scale.unit.of_si(it)));
        column.collect()
    });
    let [from, to] = solution.proof.range;
    SolutionObject {
        squares: candidate.squares,
        parameters: parameters.collect(),
        modes: report.modes(solution).into_iter().collect(),
        t: candidate.times.clone(),
        residuals: residuals.collect(),
        within: report.is_within(solution),
        smallest_sine: solution.check.smallest_measure(),
        proof: ProvenRange {
            from,
            to,
            windows: solution.proof.windows,
            unproven_limits: solution.unproven_limits.clone(),
        },
    }
}
