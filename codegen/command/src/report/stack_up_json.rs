//! Writes the spread of measures by tolerances as one JSON object.
//!
//! | key | value |
//! |---|---|
//! | `mechanism`, `motion` | name of the mechanism, and of the motion if there are several |
//! | `t` | times of the frames (s) |
//! | `sources` | `{source, unit, value, distribution, extent}` each; `distribution` is `uniform` with its half width, `normal` with its standard deviation, or `disc` with the radius of a pin's clearance |
//! | `samples` | `{count, interrupted, sequence, seed, unassembled, ended, failure}`, absent without samples; `interrupted` is true if Ctrl-C ended the sampling, and `failure` is the first one in words |
//! | `measures` | `{measure, unit, derivatives, nominal, worst_case, deviation, slopes, largest_worst_case, largest_deviation, sampled}` each |
//! | … `derivatives` | `exact`, or `differences` |
//! | … `nominal`, `worst_case`, `deviation` | by frame; null where a neighboring mechanism cannot be solved |
//! | … `slopes` | derivatives by frame, then by parameter, in the units of both; two for a pin, along the axes of its first body |
//! | … `largest_worst_case`, `largest_deviation` | `{value, t, parts}`: `parts` are the shares of the sources, in the worst case in the unit of the measure, and in the variance as fractions |
//! | … `sampled` | absent without samples: `count`, `mean`, `deviation`, `error_of_deviation`, `quantiles` by frame, and `departures`, empty where the first order is enough: `{of, t, linear, sampled, frames}`, `of` the `mean` and the `deviation` |
//! | `quantiles` | shares that belong to the quantiles |
//! | `error` | reason of an early end of the nominal motion, if there is one |

use std::io::{self, Write};

use linkwright_codegen::stages::model::{Distribution, si_unit};
use linkwright_codegen::stages::units::OutputUnit;
use linkwright_solver::View as _;
use linkwright_solver::stack_up::{LinearSpread, QUANTILES, SampledMeasure, departures};
use serde::Serialize;

use super::stack_up::{Report, largest};

#[derive(Serialize)]
struct Object<'a> {
    mechanism: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    motion: Option<&'a str>,
    t: &'a [f64],
    sources: Vec<Source<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    samples: Option<Samples<'a>>,
    measures: Vec<Measure>,
    quantiles: [f64; 3],
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<&'a str>,
}

#[derive(Serialize)]
struct Source<'a> {
    source: &'a str,
    unit: String,
    value: f64,
    distribution: &'a str,
    extent: f64,
}

#[derive(Serialize)]
struct Samples<'a> {
    count: usize,
    interrupted: bool,
    sequence: &'a str,
    seed: u64,
    unassembled: usize,
    ended: usize,
    failure: Option<&'a str>,
}

#[derive(Serialize)]
struct Measure {
    measure: String,
    unit: String,
    derivatives: &'static str,
    nominal: Vec<f64>,
    worst_case: Vec<f64>,
    deviation: Vec<f64>,
    slopes: Vec<Vec<f64>>,
    largest_worst_case: Option<Largest>,
    largest_deviation: Option<Largest>,
    #[serde(skip_serializing_if = "Option::is_none")]
    sampled: Option<Sampled>,
}

#[derive(Serialize)]
struct Largest {
    value: f64,
    t: f64,
    parts: Vec<f64>,
}

#[derive(Serialize)]
struct Sampled {
    count: Vec<usize>,
    mean: Vec<f64>,
    deviation: Vec<f64>,
    error_of_deviation: Vec<f64>,
    quantiles: Vec<[f64; 3]>,
    departures: Vec<Departed>,
}

#[derive(Serialize)]
struct Departed {
    of: &'static str,
    t: f64,
    linear: f64,
    sampled: f64,
    frames: usize,
}

/// Writes the object and a line break.
///
/// # Errors
/// Errors of `output`.
pub fn write(report: &Report<'_>, output: &mut dyn Write) -> io::Result<()> {
    let mechanism = &report.blocks.system().mechanism;
    let units = report.units();
    let sources = report.sources().into_iter().map(|it| {
        let parameter = &mechanism.parameters[it.parameter];
        let unit = units.of(&si_unit(parameter.dimension));
        let (distribution, extent) = match it.distribution {
            Distribution::Uniform { half_width } => ("uniform", half_width),
            Distribution::Normal { deviation } => ("normal", deviation),
            Distribution::Clearance { radius, .. } => ("disc", radius),
        };
        Source {
            source: report.source_name(it),
            value: unit.of_si(it.nominal),
            distribution,
            extent: unit.of_si(extent),
            unit: unit.name,
        }
    });
    let measures = report.measures().into_iter().zip(&report.spread.measures);
    let measures = measures.enumerate().map(|(place, ((name, unit), linear))| {
        let sampled = report.sampled.map(|it| &it.measures[place]);
        measure(report, name, &unit, linear, sampled)
    });
    let object = Object {
        mechanism: &mechanism.name,
        motion: mechanism.motion.as_ref().map(|it| it.name.as_str()),
        t: &report.spread.times,
        sources: sources.collect(),
        samples: report.sampled.map(|it| Samples {
            count: it.count,
            interrupted: it.is_interrupted,
            sequence: report.sequence,
            seed: report.seed,
            unassembled: it.unassembled,
            ended: it.ended,
            failure: it.failure.as_ref().map(|it| it.1.as_str()),
        }),
        measures: measures.collect(),
        quantiles: QUANTILES,
        error: report.spread.ended.as_deref(),
    };
    serde_json::to_writer(&mut *output, &object).map_err(io::Error::other)?;
    writeln!(output)
}

fn measure(
    report: &Report<'_>,
    name: String,
    unit: &OutputUnit,
    linear: &LinearSpread,
    sampled: Option<&SampledMeasure>,
) -> Measure {
    let spread = report.spread;
    let units = report.units();
    let parameters = &report.blocks.system().mechanism.parameters;
    let of_parameters: Vec<f64> = spread
        .toleranced
        .iter()
        .map(|it| {
            units
                .of(&si_unit(parameters[it.parameter].dimension))
                .of_si(1.0)
        })
        .collect();
    let all = |values: &[f64]| -> Vec<f64> { values.iter().map(|it| unit.of_si(*it)).collect() };
    let slopes = linear.slopes.iter().map(|slopes| {
        let slopes = slopes.iter().zip(&of_parameters);
        slopes.map(|(slope, of)| unit.of_si(*slope) / of).collect()
    });
    let largest_of = |values: &[f64], parts: &dyn Fn(usize) -> Vec<f64>| {
        let place = largest(values.iter().copied())?;
        Some(Largest {
            value: unit.of_si(values[place]),
            t: spread.times[place],
            parts: parts(place),
        })
    };
    let toleranced = &spread.toleranced;
    Measure {
        measure: name,
        unit: unit.name.clone(),
        derivatives: match linear.is_exact {
            true => "exact",
            false => "differences",
        },
        nominal: all(&linear.nominal),
        worst_case: all(&linear.worst),
        deviation: all(&linear.deviation),
        slopes: slopes.collect(),
        largest_worst_case: largest_of(&linear.worst, &|it| all(&linear.limits(it, toleranced))),
        largest_deviation: largest_of(&linear.deviation, &|it| linear.shares(it, toleranced)),
        sampled: sampled.map(|sampled| {
            let moments = || sampled.moments.iter();
            Sampled {
                count: moments().map(|it| it.count).collect(),
                mean: moments().map(|it| unit.of_si(it.mean)).collect(),
                deviation: moments().map(|it| unit.of_si(it.deviation)).collect(),
                error_of_deviation: moments()
                    .map(|it| unit.of_si(it.error_of_deviation))
                    .collect(),
                quantiles: moments()
                    .map(|it| it.quantiles.map(|it| unit.of_si(it)))
                    .collect(),
                departures: departures(linear, sampled)
                    .into_iter()
                    .map(|it| Departed {
                        of: if it.is_of_mean { "mean" } else { "deviation" },
                        t: spread.times[it.place],
                        linear: unit.of_si(it.linear),
                        sampled: unit.of_si(it.sampled),
                        frames: it.instants,
                    })
                    .collect(),
            }
        }),
    }
}
