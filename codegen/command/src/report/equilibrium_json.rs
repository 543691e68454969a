//! Writes equilibria, and the path of one, as one JSON object.
//!
//! | key | value |
//! |---|---|
//! | `mechanism`, `motion` | name of the mechanism, and of the motion if there are several |
//! | `t` | time at which drivers and inputs stand (s) |
//! | `free`, `measures` | `{name, unit}` each, in the order of values |
//! | `everywhere` | true if every pose is in equilibrium; `equilibria` is then empty |
//! | `equilibria` | `{free, stability, conservative, motions, potential_energy, measures, family, connected, design_modes, broken_limits}` each |
//! | `stability` there | `stable`, `unstable` or `indifferent` |
//! | `motions` there | `{frequency, growth}` each, in Hz and 1/s |
//! | `potential_energy` there | of gravity and springs (J) |
//! | `family` there | true if other equilibria are next to it without a gap |
//! | `connected` there | true if a curve of poses connects it with the design configuration; `null` with several free coordinates |
//! | `design_modes` there | true if the assembly modes of the design configuration lead to it from its free coordinates |
//! | `broken_limits` there | names of the measures whose limits it breaks |
//! | `nearest` | index of the stable equilibrium next to the design configuration, from 0; `null` without any |
//! | `left_out` | number of equilibria with an input outside of its range |
//! | `interrupted` | true if Ctrl-C has ended the search |
//! | `curves` | for one free coordinate, the ends of each followed curve of poses: `closed`, `window` or `singular` |
//! | `starts`, `settled` | for several, the number of starts, and of those that led to an equilibrium |
//! | `path` | with `--path`: `{name, unit, of, rows, events, end}` |
//! | `rows` there | `{value, free, measures, stability}` each |
//! | `events` there | `{kind, value, free, measures, before, behind, place}` each; `kind` is `fold` or `change_of_stability`, and `place` the number of rows before it |
//! | `end` there | `last`, `first`, `closed`, `lost`, `long` or `interrupted` |

use std::io::{self, Write};

use linkwright_codegen::stages::system::System;
use linkwright_solver::equilibrium::{
    Coverage, CurveEnd, Equilibria, Equilibrium, PathEnd, PathEventKind, PathRow,
};
use serde::Serialize;

use super::equilibrium_path::Followed;
use super::equilibrium_text::{Column, free_columns, measure_columns, measured};

#[derive(Serialize)]
struct Object<'a> {
    mechanism: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    motion: Option<&'a str>,
    t: f64,
    free: Vec<Named<'a>>,
    measures: Vec<Named<'a>>,
    everywhere: bool,
    equilibria: Vec<Entry<'a>>,
    nearest: Option<usize>,
    left_out: usize,
    interrupted: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    curves: Option<Vec<[&'static str; 2]>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    starts: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    settled: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    path: Option<Path<'a>>,
}

#[derive(Serialize)]
struct Named<'a> {
    name: &'a str,
    unit: &'a str,
}

#[derive(Serialize)]
struct Entry<'a> {
    free: Vec<f64>,
    stability: &'static str,
    conservative: bool,
    motions: Vec<Motion>,
    potential_energy: f64,
    measures: Vec<Option<f64>>,
    family: bool,
    connected: Option<bool>,
    design_modes: bool,
    broken_limits: Vec<&'a str>,
}

#[derive(Serialize)]
struct Motion {
    frequency: f64,
    growth: f64,
}

#[derive(Serialize)]
struct Path<'a> {
    name: &'a str,
    unit: String,
    of: usize,
    rows: Vec<Row>,
    events: Vec<Event>,
    end: &'static str,
}

#[derive(Serialize)]
struct Row {
    value: f64,
    free: Vec<f64>,
    measures: Vec<Option<f64>>,
    stability: &'static str,
}

#[derive(Serialize)]
struct Event {
    kind: &'static str,
    value: f64,
    free: Vec<f64>,
    measures: Vec<Option<f64>>,
    before: &'static str,
    behind: &'static str,
    place: usize,
}

/// Writes the object and a line break.
///
/// # Errors
/// Errors of `output`.
pub fn write(
    equilibria: &Equilibria,
    followed: Option<&Followed>,
    system: &System,
    t: f64,
    output: &mut dyn Write,
) -> io::Result<()> {
    let mechanism = &system.mechanism;
    let (free, measures) = (free_columns(system), measure_columns(system));
    let (curves, starts) = match &equilibria.coverage {
        Coverage::Curves(ends) => (Some(ends.iter().map(|it| it.map(end_name)).collect()), None),
        Coverage::Starts(counts) => (None, Some(*counts)),
    };
    let entries = equilibria.all.iter();
    let object = Object {
        mechanism: &mechanism.name,
        motion: mechanism.motion.as_ref().map(|it| it.name.as_str()),
        t,
        free: named(&free),
        measures: named(&measures),
        everywhere: equilibria.is_everywhere,
        equilibria: entries
            .map(|it| entry(it, system, [&free, &measures]))
            .collect(),
        nearest: equilibria.nearest,
        left_out: equilibria.refused,
        interrupted: equilibria.is_interrupted,
        curves,
        starts: starts.map(|it| it[0]),
        settled: starts.map(|it| it[1]),
        path: followed.map(|it| path(it, system, [&free, &measures])),
    };
    serde_json::to_writer_pretty(&mut *output, &object)?;
    writeln!(output)
}

fn named(columns: &[Column]) -> Vec<Named<'_>> {
    let columns = columns.iter();
    let names = columns.map(|it| Named {
        name: &it.name,
        unit: &it.unit.name,
    });
    names.collect()
}

/// Returns the free coordinates in their units.
fn values(equilibrium: &Equilibrium, free: &[Column]) -> Vec<f64> {
    let values = free.iter().zip(&equilibrium.free);
    values.map(|(it, value)| it.unit.of_si(*value)).collect()
}

/// Returns the measures in their units; `None` for an undetermined one.
fn measure_values(
    equilibrium: &Equilibrium,
    measures: &[Column],
    system: &System,
) -> Vec<Option<f64>> {
    let reported = measured(equilibrium, system);
    let values = measures.iter().enumerate().map(|(place, column)| {
        let value = reported.map(|it| column.unit.of_si(it[place]));
        value.filter(|it| it.is_finite())
    });
    values.collect()
}

fn entry<'a>(
    equilibrium: &Equilibrium,
    system: &'a System,
    [free, measures]: [&[Column]; 2],
) -> Entry<'a> {
    let mechanism = &system.mechanism;
    let verdict = &equilibrium.verdict;
    let motions = verdict.motions.iter();
    let broken = equilibrium.broken.iter().map(|&limit| {
        let measurement = mechanism.limits[limit].measurement;
        mechanism.measurements[measurement].name.as_str()
    });
    Entry {
        free: values(equilibrium, free),
        stability: verdict.stability.name(),
        conservative: verdict.is_conservative,
        motions: motions
            .map(|it| Motion {
                frequency: it.frequency,
                growth: it.growth,
            })
            .collect(),
        potential_energy: equilibrium.potential,
        measures: measure_values(equilibrium, measures, system),
        family: equilibrium.is_of_family,
        connected: equilibrium.is_connected,
        design_modes: equilibrium.has_design_modes,
        broken_limits: broken.collect(),
    }
}

fn path<'a>(followed: &'a Followed, system: &System, [free, measures]: [&[Column]; 2]) -> Path<'a> {
    let unit = system.mechanism.units.of_messages().of(&followed.unit);
    let row = |it: &PathRow| Row {
        value: unit.of_si(it.value),
        free: values(&it.equilibrium, free),
        measures: measure_values(&it.equilibrium, measures, system),
        stability: it.equilibrium.verdict.stability.name(),
    };
    let events = followed.path.events.iter().map(|it| {
        let [before, behind] = it.stability.map(|it| it.name());
        let Row {
            value,
            free,
            measures,
            ..
        } = row(&it.row);
        Event {
            kind: match it.kind {
                PathEventKind::Fold => "fold",
                PathEventKind::ChangeOfStability => "change_of_stability",
            },
            value,
            free,
            measures,
            before,
            behind,
            place: it.place,
        }
    });
    Path {
        name: &followed.name,
        of: followed.of,
        rows: followed.path.rows.iter().map(row).collect(),
        events: events.collect(),
        end: match followed.path.end {
            PathEnd::Last => "last",
            PathEnd::First => "first",
            PathEnd::Closed => "closed",
            PathEnd::Lost => "lost",
            PathEnd::Long => "long",
            PathEnd::Interrupted => "interrupted",
        },
        unit: unit.name,
    }
}

fn end_name(end: CurveEnd) -> &'static str {
    match end {
        CurveEnd::Closed => "closed",
        CurveEnd::Window => "window",
        CurveEnd::Singular => "singular",
    }
}
