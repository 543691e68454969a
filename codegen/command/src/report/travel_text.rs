//! Writes the travel of a drive as text.

use std::io::{self, Write};

use linkwright_codegen::stages::system::System;
use linkwright_codegen::stages::units::OutputUnit;
use linkwright_solver::number::time;
use linkwright_solver::proof::Proof;
use linkwright_solver::travel::{EndKind, Travel, TravelEnd};

use super::region_text::end_words;

/// Significant digits of a value that is not verified.
const DIGITS: usize = 9;

/// Writes the start and both ends of a drive whose other drivers stand at `t` (s).
///
/// # Errors
/// Errors of `output`.
pub fn write(travel: &Travel, system: &System, t: f64, output: &mut dyn Write) -> io::Result<()> {
    let mechanism = &system.mechanism;
    let unit = mechanism.units.of_messages().of(travel.drive.si());
    writeln!(output, "{}", mechanism.title())?;
    writeln!(
        output,
        "travel of {} from {}, with all else as at t = {} s",
        travel.drive.name,
        unit.labeled(unit.rounded(travel.start, DIGITS)),
        time(t)
    )?;
    if let (true, Some(turns)) = (travel.turns_round(), travel.ends[0].turns) {
        let turns = match turns {
            1 => "a full turn leads".to_string(),
            turns => format!("{turns} full turns lead"),
        };
        writeln!(
            output,
            "  turns without end: {turns} back to the same pose, both ways"
        )?;
    } else {
        let values = travel.ends.each_ref().map(|end| value(end, &unit));
        let width = values
            .iter()
            .map(|it| it.chars().count())
            .max()
            .unwrap_or(0);
        for (end, (way, value)) in travel
            .ends
            .iter()
            .zip(["up to", "down to"].iter().zip(values))
        {
            let words = words(end);
            writeln!(output, "  {way:7} {value:>width$}  {words}")?;
        }
        verified(travel, output)?;
    }
    for (end, way) in travel.ends.iter().zip(["up", "down"]) {
        if let Some(proof) = &end.proof {
            proven(end, proof, way, &unit, output)?;
        }
    }
    Ok(())
}

/// Writes what the decimals of ends mean.
fn verified(travel: &Travel, output: &mut dyn Write) -> io::Result<()> {
    let decimals = travel.ends.iter().filter_map(|it| it.decimals);
    let mut sides: Vec<bool> = decimals.map(|it| it.is_inside()).collect();
    sides.sort_unstable();
    sides.dedup();
    for is_inside in sides.into_iter().rev() {
        let words = match is_inside {
            true => {
                "a pose exists at the value of each end, and the travel is over one digit further"
            }
            false => "the travel ends less than one digit from this value",
        };
        writeln!(output, "verified: {words}")?;
    }
    Ok(())
}

fn value(end: &TravelEnd, unit: &OutputUnit) -> String {
    let number = match &end.decimals {
        Some(decimals) => decimals.text(),
        None => unit.rounded(end.value, DIGITS).to_string(),
    };
    let is_sure = end.decimals.is_some() || !end.kind.is_end();
    let about = if is_sure { "" } else { "about " };
    unit.labeled(format!("{about}{number}"))
}

/// Returns what ends the travel.
fn words(end: &TravelEnd) -> String {
    let words = &end.words;
    match end.kind {
        EndKind::ChangePoint => format!("{}; branches meet there", end_words(end.kind, words)),
        EndKind::FullTurn => "full turn, which leads back to the same pose".to_string(),
        EndKind::Unended => format!("no end, {words}"),
        kind => end_words(kind, words),
    }
}

/// Writes the range of the drive over which one smooth path is proven.
fn proven(
    end: &TravelEnd,
    proof: &Proof,
    way: &str,
    unit: &OutputUnit,
    output: &mut dyn Write,
) -> io::Result<()> {
    if proof.proven.is_some() {
        let far = match end.decimals.map(|it| it.is_inside()) {
            Some(true) => "to this value",
            Some(false) => "to one digit before this value",
            None => "around the full turn",
        };
        return writeln!(
            output,
            "proven {way}: one smooth path leads from the design configuration {far}"
        );
    }
    let Some(unproven) = &proof.unproven else {
        return Ok(());
    };
    let sign = if way == "up" { 1.0 } else { -1.0 };
    let reached = unit.labeled(unit.rounded(sign * unproven.window[0], DIGITS));
    match proof.windows {
        0 => writeln!(output, "not proven {way}: {}", unproven.reason),
        _ => writeln!(
            output,
            "not proven {way}: one smooth path is proven as far as about {reached} only"
        ),
    }
}
