//! Writes the travel of a drive as one JSON object.
//!
//! | key | value |
//! |---|---|
//! | `mechanism`, `motion` | name of the mechanism, and of the motion if there are several |
//! | `drive`, `unit` | name of the drive, and the unit of its values |
//! | `start` | value in the design configuration |
//! | `turns_round` | true if a full turn leads back to the same pose |
//! | `ends` | `{way, end, value, decimals, inside, words, block, measure, turns, proof}` each: `up` with growing values, then `down` |
//! | `end` there | `reach`, `dead_point`, `change_point`, `limit`, `refused`, `lost`, `full_turn` or `unended` |
//! | `decimals` there | number of verified decimals of `value`: the travel is over one digit further; `null` if none is verified |
//! | `inside` there | true if a pose exists at `value`, false if the travel ends less than one digit from it |
//! | `block`, `measure` there | number of the singular block, and name of the limited measure, if any |
//! | `proof` there | with `--prove`: `{status, from, to, windows, reason}`; `status` is `proven` or `sampled` |

use std::io::{self, Write};

use linkwright_codegen::stages::system::System;
use linkwright_codegen::stages::units::OutputUnit;
use linkwright_solver::proof::Proof;
use linkwright_solver::travel::{Travel, TravelEnd};
use serde::Serialize;

#[derive(Serialize)]
struct Object<'a> {
    mechanism: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    motion: Option<&'a str>,
    drive: &'a str,
    unit: &'a str,
    start: f64,
    turns_round: bool,
    ends: Vec<End<'a>>,
}

#[derive(Serialize)]
struct End<'a> {
    way: &'static str,
    end: &'static str,
    value: f64,
    decimals: Option<usize>,
    inside: Option<bool>,
    words: &'a str,
    block: Option<usize>,
    measure: Option<&'a str>,
    turns: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    proof: Option<ProofObject<'a>>,
}

#[derive(Serialize)]
struct ProofObject<'a> {
    status: &'static str,
    from: f64,
    to: f64,
    windows: usize,
    reason: Option<&'a str>,
}

/// Writes the object and a line break. `system` is that of the description.
///
/// # Errors
/// Errors of `output`.
pub fn write(travel: &Travel, system: &System, output: &mut dyn Write) -> io::Result<()> {
    let mechanism = &system.mechanism;
    let unit = mechanism.units.of_messages().of(travel.drive.si());
    let ends = travel.ends.iter().zip([("up", 1.0), ("down", -1.0)]);
    let object = Object {
        mechanism: &mechanism.name,
        motion: mechanism.motion.as_ref().map(|it| it.name.as_str()),
        drive: &travel.drive.name,
        unit: &unit.name,
        start: unit.of_si(travel.start),
        turns_round: travel.turns_round(),
        ends: ends.map(|(end, way)| object_of(end, way, &unit)).collect(),
    };
    serde_json::to_writer_pretty(&mut *output, &object)?;
    writeln!(output)
}

fn object_of<'a>(
    end: &'a TravelEnd,
    (way, sign): (&'static str, f64),
    unit: &OutputUnit,
) -> End<'a> {
    let decimals = end.decimals.as_ref();
    End {
        way,
        end: end.kind.name(),
        value: decimals.map_or(unit.of_si(end.value), |it| it.value),
        decimals: decimals.map(|it| it.count),
        inside: decimals.map(|it| it.is_inside()),
        words: &end.words,
        block: end.block.map(|block| block + 1),
        measure: end.measure.as_deref(),
        turns: end.turns,
        proof: end.proof.as_ref().map(|it| proof_object(it, sign, unit)),
    }
}

fn proof_object<'a>(proof: &'a Proof, sign: f64, unit: &OutputUnit) -> ProofObject<'a> {
    let unproven = proof.unproven.as_ref();
    let to = unproven.map_or(proof.range[1], |it| it.window[0]);
    ProofObject {
        status: if unproven.is_some() {
            "sampled"
        } else {
            "proven"
        },
        from: unit.of_si(sign * proof.range[0]),
        to: unit.of_si(sign * to),
        windows: proof.windows,
        reason: unproven.map(|it| it.reason.as_str()),
    }
}
