//! Writes the region of two drives as text and as one JSON object.
//!
//! | key of the object | value |
//! |---|---|
//! | `mechanism`, `motion` | name of the mechanism, and of the motion if there are several |
//! | `drives`, `units`, `start` | names of both drives, their units, and their values in the design configuration |
//! | `point_unit` | unit of `tips` |
//! | `borders` | `{closed, sections}` each; sections follow one another with the region on the left |
//! | `sections` there | `{end, words, values, tips}` each: `end` as of one drive, `unended` on the side of the window; pairs of values of both drives, and positions of the point |
//! | `folds` | the same for curves on which both drives move the point along one line |

use std::io::{self, Write};

use linkwright_codegen::stages::system::System;
use linkwright_codegen::stages::units::OutputUnit;
use linkwright_solver::number::{counted, time};
use linkwright_solver::travel::{Curve, EndKind, Region, Section};
use serde::Serialize;

/// Significant digits of a corner.
const DIGITS: usize = 5;

#[derive(Serialize)]
struct Object<'a> {
    mechanism: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    motion: Option<&'a str>,
    drives: [&'a str; 2],
    units: [&'a str; 2],
    start: [f64; 2],
    point_unit: &'a str,
    borders: Vec<CurveObject<'a>>,
    folds: Vec<CurveObject<'a>>,
}

#[derive(Serialize)]
struct CurveObject<'a> {
    closed: bool,
    sections: Vec<SectionObject<'a>>,
}

#[derive(Serialize)]
struct SectionObject<'a> {
    end: &'static str,
    words: &'a str,
    values: Vec<[f64; 2]>,
    tips: Vec<[f64; 2]>,
}

/// Returns what a section of a border is.
pub fn section_words(section: &Section) -> String {
    end_words(section.kind, &section.words)
}

/// Returns what ends a motion, with the words for its place.
pub fn end_words(kind: EndKind, words: &str) -> String {
    match kind {
        EndKind::Reach => format!("end of reach, {words}"),
        EndKind::DeadPoint => format!("dead point, {words}"),
        EndKind::ChangePoint => format!("change point, {words}"),
        EndKind::Limit => format!("limit of {words}"),
        EndKind::Refused => format!("a value is refused beyond, {words}"),
        EndKind::Lost => format!("not followed further, {words}"),
        EndKind::FullTurn | EndKind::Unended => format!("no end of {words} so far"),
    }
}

/// Returns the units of both drives.
pub fn units_of(region: &Region, system: &System) -> [OutputUnit; 2] {
    let units = system.mechanism.units.of_messages();
    [0, 1].map(|it| units.of(region.drives[it].si()))
}

/// Writes the sections of all borders with their corners, and the number of folds.
///
/// # Errors
/// Errors of `output`.
pub fn write(region: &Region, system: &System, t: f64, output: &mut dyn Write) -> io::Result<()> {
    let units = units_of(region, system);
    writeln!(output, "{}", system.mechanism.title())?;
    let [a, b] = region.drives.each_ref().map(|it| it.name.as_str());
    writeln!(
        output,
        "region of {a} and {b} about {}, with all else as at t = {} s",
        spot(&region.start, &units),
        time(t)
    )?;
    for (place, border) in region.borders.iter().enumerate() {
        let points = border.sections.iter().map(|it| it.values.len()).sum();
        let points = counted(points, "point");
        let closed = if border.is_closed {
            "closed"
        } else {
            "not closed"
        };
        let is_inner = place > 0 && border.is_closed;
        let name = if is_inner { "inner border" } else { "border" };
        writeln!(output, "{name}, {closed}, {points}, from corner to corner")?;
        for section in &border.sections {
            let from = section
                .values
                .first()
                .map_or(String::new(), |it| spot(it, &units));
            writeln!(output, "  from {from}  {}", section_words(section))?;
        }
    }
    if region.start_tip.is_some() {
        let folds = counted(region.folds.len(), "curve");
        writeln!(
            output,
            "{folds} inside on which both drives move the point along one line"
        )?;
    }
    Ok(())
}

/// Returns both values of a spot with their units.
fn spot(values: &[f64; 2], units: &[OutputUnit; 2]) -> String {
    let value = |it: usize| {
        format!(
            "{} {}",
            units[it].rounded(values[it], DIGITS),
            units[it].name
        )
    };
    format!("({}, {})", value(0), value(1))
}

/// Writes the object and a line break.
///
/// # Errors
/// Errors of `output`.
pub fn write_json(region: &Region, system: &System, output: &mut dyn Write) -> io::Result<()> {
    let mechanism = &system.mechanism;
    let units = units_of(region, system);
    let length = mechanism.units.of_messages().of("m");
    let object = Object {
        mechanism: &mechanism.name,
        motion: mechanism.motion.as_ref().map(|it| it.name.as_str()),
        drives: region.drives.each_ref().map(|it| it.name.as_str()),
        units: units.each_ref().map(|it| it.name.as_str()),
        start: converted(&region.start, &units),
        point_unit: &length.name,
        borders: objects(&region.borders, &units, &length),
        folds: objects(&region.folds, &units, &length),
    };
    serde_json::to_writer(&mut *output, &object)?;
    writeln!(output)
}

fn converted(values: &[f64; 2], units: &[OutputUnit; 2]) -> [f64; 2] {
    [0, 1].map(|it| units[it].of_si(values[it]))
}

fn objects<'a>(
    curves: &'a [Curve],
    units: &[OutputUnit; 2],
    length: &OutputUnit,
) -> Vec<CurveObject<'a>> {
    let section = |it: &'a Section| SectionObject {
        end: it.kind.name(),
        words: &it.words,
        values: it.values.iter().map(|it| converted(it, units)).collect(),
        tips: it
            .tips
            .iter()
            .map(|it| it.map(|own| length.of_si(own)))
            .collect(),
    };
    let curves = curves.iter().map(|it| CurveObject {
        closed: it.is_closed,
        sections: it.sections.iter().map(section).collect(),
    });
    curves.collect()
}
