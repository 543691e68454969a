//! Writes the results of `check` as one JSON object.
//!
//! | key | value |
//! |---|---|
//! | `mechanism`, `motion` | name of the mechanism, and of the motion if there are several |
//! | `kdof`, `ndof` | number of coordinates minus number of joint equations; additionally minus number of driver equations |
//! | `blocks` | `{block, unknowns, method, determinant, singular_where, solutions, closest}` each, in solve order |
//! | `closest` there | `{measure, t, times, at_end, rcond}`: smallest magnitude of the normalized determinant, its first time, its number of times, true if it lies at an end of the range, and the reciprocal condition of the dimensionless Φ_q there |
//! | `assembly_modes` | number of signs of the closed forms |
//! | `coordinates` | names in the order of `q` |
//! | `units` | units of each coordinate in `q`, and of a `point` |
//! | `assemblies` | `{signs, poses, drawn, q}` each: the assemblies at the start; `poses` has a number for each block without a closed form, 0 for its pose `a` of `--branch` |
//! | `assemblies_cut_short` | true if some combinations were left untried |
//! | `assemblies_proven` | true if a proof excludes further assemblies |
//! | `assemblies_decided` | part of the candidate volume in which existence is proven or excluded, at most 1 |
//! | `assemblies_undecided` | the rest: objects with the lower and the upper end of a range of each unknown |
//! | `proof` | with `--prove`: `{status, from, to, windows, shortest_window, determinants, coordinates, points, unproven}` |
//! | `status` there | `proven`, or `sampled` if the motion cannot be proven |
//! | `determinants` there | `{block, unknowns, at_least, located}` each: a lower bound of the magnitude of the normalized determinant in the whole range, and the smallest located value |
//! | `coordinates`, `points`, `measures` there | by name, bounds in the whole range, in `units`; `{x, y}` for points; of measures those of positions |
//! | `unproven` there | `{from, to, block, reason}`: the first window that cannot be proven |
//! | `measures` | `{measure, unit, smallest: {value, t}, largest: {value, t}}` each, between frames too, if there are any |
//! | `broken_limits` | `{measure, limit, intervals, beyond, t}` each: first and last time of each interval, and the largest excess with its time, if there are any |
//! | `motors` | `{driver, units, torque, speed, power}` each, if there are any: of the largest torque, speed and power, `{t, torque, speed, power}`, between frames too |
//! | `friction` | if joints have friction: `{efficiency, work, frictionless_work, efficiency_of_load, work_of_load, frictionless_work_of_load, lowest: {efficiency, t}, self_locking}`, work in J while drivers drive the load and while the load drives, and the first and the last time of each interval in which the load cannot drive the mechanism |
//! | `warnings`, `error` | sentences; `error` only if the motion ends early |

use std::collections::BTreeMap;
use std::io::{self, Write};

use linkwright_codegen::stages::units::OutputUnit;
use linkwright_solver::every_pose::Undecided;
use linkwright_solver::proof::{Enclosed, Proof};
use linkwright_solver::{Check, View};
use serde::Serialize;

use crate::losses::{self, Friction};
use crate::measured::{Broken, Extremes, broken, extremes};
use crate::motors::{Motor, objects};
use crate::units::{enclosing, of_coordinate, si_of};

#[derive(Serialize)]
struct Object<'a> {
    mechanism: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    motion: Option<&'a str>,
    kdof: i64,
    ndof: i64,
    blocks: Vec<Block<'a>>,
    assembly_modes: usize,
    coordinates: Vec<&'a str>,
    units: UnitNames,
    assemblies: Vec<Assembly>,
    assemblies_cut_short: bool,
    assemblies_proven: bool,
    assemblies_decided: f64,
    assemblies_undecided: Vec<BTreeMap<&'a str, [f64; 2]>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    proof: Option<ProofObject<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    measures: Vec<Extremes<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    broken_limits: Vec<Broken<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    motors: Vec<Motor<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    friction: Option<Friction>,
    warnings: &'a [String],
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<&'a str>,
}

/// Units of `q` and of points.
#[derive(Serialize)]
struct UnitNames {
    q: Vec<String>,
    point: String,
}

#[derive(Serialize)]
struct Block<'a> {
    block: usize,
    unknowns: &'a str,
    method: &'a str,
    determinant: Option<&'a str>,
    singular_where: Option<&'a str>,
    solutions: Option<usize>,
    closest: Option<Closest>,
}

#[derive(Serialize)]
struct Closest {
    measure: f64,
    t: f64,
    times: usize,
    at_end: bool,
    rcond: Option<f64>,
}

#[derive(Serialize)]
struct Assembly {
    signs: Vec<i8>,
    poses: Vec<usize>,
    drawn: bool,
    q: Vec<f64>,
}

#[derive(Serialize)]
struct ProofObject<'a> {
    status: &'static str,
    from: f64,
    to: f64,
    windows: usize,
    shortest_window: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    determinants: Option<Vec<Determinant<'a>>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    coordinates: Option<BTreeMap<&'a str, [f64; 2]>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    points: Option<BTreeMap<&'a str, Point>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    measures: Option<BTreeMap<&'a str, [f64; 2]>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    unproven: Option<Unproven<'a>>,
}

#[derive(Serialize)]
struct Determinant<'a> {
    block: usize,
    unknowns: &'a str,
    at_least: f64,
    located: f64,
}

#[derive(Serialize)]
struct Point {
    x: [f64; 2],
    y: [f64; 2],
}

#[derive(Serialize)]
struct Unproven<'a> {
    from: f64,
    to: f64,
    block: Option<usize>,
    reason: &'a str,
}

fn proof_object<'a>(check: &'a Check, proof: &'a Proof) -> ProofObject<'a> {
    let proven = proof.proven.as_ref();
    let units = check.interpreted.system().mechanism.units.of_tables();
    let unit_of = |own: &Enclosed| units.of(if own.is_angle { "rad" } else { "m" });
    let determinants = proven.map(|proven| {
        let all = proven.determinants.iter();
        let all = all.map(|it| Determinant {
            block: it.block + 1,
            unknowns: check.unknowns_of(it.block, it.part),
            at_least: it.least,
            located: it.located,
        });
        all.collect()
    });
    let points = proven.map(|proven| {
        let all = proven.points.iter();
        all.map(|[x, y]| {
            let length = units.of("m");
            let [x_bounds, y_bounds] = [x, y].map(|it| enclosing(&length, it.bounds));
            let point = Point {
                x: x_bounds,
                y: y_bounds,
            };
            (x.name.as_str(), point)
        })
        .collect()
    });
    ProofObject {
        status: match proven {
            Some(_) => "proven",
            None => "sampled",
        },
        from: proof.range[0],
        to: proof.range[1],
        windows: proof.windows,
        shortest_window: proof.shortest,
        determinants,
        coordinates: proven.map(|proven| {
            let all = proven.coordinates.iter();
            all.map(|it| (it.name.as_str(), enclosing(&unit_of(it), it.bounds)))
                .collect()
        }),
        points,
        measures: proven.filter(|it| !it.measures.is_empty()).map(|proven| {
            let measurements = &check.interpreted.system().mechanism.measurements;
            let all = proven.measures.iter().map(|(place, own)| {
                let unit = units.of(&measurements[*place].unit());
                (own.name.as_str(), enclosing(&unit, own.bounds))
            });
            all.collect()
        }),
        unproven: proof.unproven.as_ref().map(|it| Unproven {
            from: it.window[0],
            to: it.window[1],
            block: it.block.map(|block| block + 1),
            reason: &it.reason,
        }),
    }
}

/// Writes the object, with a proof if one is requested, and a line break.
///
/// # Errors
/// Errors of `output`.
pub fn write(check: &Check, proof: Option<&Proof>, output: &mut dyn Write) -> io::Result<()> {
    let search = &check.assemblies;
    let system = check.interpreted.system();
    let units = system.mechanism.units.of_tables();
    let coordinate_units: Vec<OutputUnit> = (0..system.coordinates.len())
        .map(|it| of_coordinate(system, it, &units))
        .collect();
    let assemblies = search.found.iter().map(|assembly| Assembly {
        signs: assembly
            .modes
            .closed
            .iter()
            .map(|branch| branch.sign::<f64>() as i8)
            .collect(),
        poses: assembly.poses.iter().map(|pose| pose.place).collect(),
        drawn: assembly.drawn,
        q: coordinate_units
            .iter()
            .zip(assembly.instant.q())
            .map(|(unit, value)| unit.of_si(*value))
            .collect(),
    });
    let blocks = check.parts.iter().map(|part| Block {
        block: part.pose.block + 1,
        unknowns: &part.pose.unknowns,
        method: &part.pose.method,
        determinant: part.pose.determinant.as_deref(),
        singular_where: part.pose.meaning.as_deref(),
        solutions: part.solutions,
        closest: part.approach.as_ref().map(|approach| Closest {
            measure: approach.measure,
            t: approach.instant.t(),
            times: approach.times,
            at_end: approach.at_end,
            rcond: part.reciprocal,
        }),
    });
    let motion = system.mechanism.motion.as_ref();
    let object = Object {
        mechanism: &system.mechanism.name,
        motion: motion.map(|motion| motion.name.as_str()),
        kdof: check.kinematic_freedom,
        ndof: check.net_freedom,
        blocks: blocks.collect(),
        assembly_modes: search.modes,
        coordinates: system
            .coordinates
            .iter()
            .map(|it| it.name.as_str())
            .collect(),
        units: UnitNames {
            q: coordinate_units.iter().map(|it| it.name.clone()).collect(),
            point: units.of("m").name,
        },
        assemblies: assemblies.collect(),
        assemblies_cut_short: search.cut_short,
        assemblies_proven: search.are_all(),
        assemblies_decided: search.decided,
        assemblies_undecided: search
            .undecided
            .iter()
            .map(|Undecided(ranges)| {
                let ranges = ranges.iter();
                ranges
                    .map(|(unknown, range)| {
                        let quantity = system.vector_form.unknowns[*unknown].quantity;
                        let unit = units.of(si_of(quantity));
                        (system.unknown_name(*unknown), enclosing(&unit, *range))
                    })
                    .collect()
            })
            .collect(),
        proof: proof.map(|proof| proof_object(check, proof)),
        measures: extremes(check),
        broken_limits: broken(check),
        motors: objects(&check.measured.motors, |_| None, &units),
        friction: losses::object(check.losses.as_ref()),
        warnings: &check.warnings,
        error: check.error.as_deref(),
    };
    serde_json::to_writer_pretty(&mut *output, &object)?;
    writeln!(output)
}
