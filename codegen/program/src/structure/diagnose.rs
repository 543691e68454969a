//! Reports subsystems that are not square, by their bodies and joints.

use std::collections::HashSet;

use super::CoarseDecomposition;
use super::rank::{Dependence, Survey};
use super::repetition::{advice, with_freedom};
use crate::diagnostic::{Code, Diagnostic, Diagnostics, Span};
use crate::model::{Joint, Role};
use crate::pool::Pool;
use crate::system::{Described, System};

/// Largest number of positions or names that a message lists.
pub(super) const MAX_LISTED: usize = 6;

pub(super) fn report(
    pool: &Pool,
    system: &System,
    parts: &CoarseDecomposition,
    diagnostics: &mut Diagnostics,
) {
    // Ranks are numerical; `None` if the equations cannot be satisfied near the design configuration.
    let survey = Survey::of(pool, system);
    if !parts.free_columns.is_empty() {
        let mut diagnostic = too_few(system, parts);
        if let Some(survey) = &survey {
            diagnostic = with_freedom(diagnostic, system, survey);
        }
        diagnostics.push(diagnostic);
    }
    if !parts.free_rows.is_empty() {
        diagnostics.push(too_many(system, parts, survey.as_ref()));
    }
}

/// Writes a number with its noun: `1 equation`, `2 equations`.
pub(super) fn count(number: usize, one: &str, several: &str) -> String {
    format!("{number} {}", if number == 1 { one } else { several })
}

/// Joins names in backticks, at most [`MAX_LISTED`] of them.
fn listed<'a>(names: impl ExactSizeIterator<Item = &'a str>) -> String {
    let more = names.len().saturating_sub(MAX_LISTED);
    let listed: Vec<String> = names
        .take(MAX_LISTED)
        .map(|name| format!("`{name}`"))
        .collect();
    let listed = listed.join(", ");
    if more == 0 {
        listed
    } else {
        format!("{listed} and {more} more")
    }
}

pub(super) fn balance(system: &System) -> String {
    let constraints = system
        .rows
        .iter()
        .filter(|row| system.mechanism.joints[row.joint].role == Role::Constraint);
    let constraints = constraints.count();
    let drivers = system.rows.len() - constraints;
    format!(
        "{} for {}: {} of joints and {} of drivers",
        count(system.rows.len(), "equation", "equations"),
        count(system.coordinates.len(), "coordinate", "coordinates"),
        constraints,
        drivers,
    )
}

fn too_few(system: &System, parts: &CoarseDecomposition) -> Diagnostic {
    let mut bodies: Vec<usize> = parts
        .under_columns
        .iter()
        .filter_map(|&column| system.coordinates[column].describes.body())
        .collect();
    bodies.dedup();
    let bodies: Vec<_> = bodies
        .iter()
        .map(|&body| &system.mechanism.bodies[body])
        .collect();
    if bodies.is_empty() {
        return undetermined_contact(system, parts);
    }
    let left = parts.free_columns.len();
    let names = listed(bodies.iter().map(|body| body.name.as_str()));
    let noun = if bodies.len() == 1 { "body" } else { "bodies" };
    let mut diagnostic = Diagnostic::error(
        Code::TooFewEquations,
        bodies[0].span,
        format!(
            "{} too few: {} left, on {noun} {names}",
            count(left, "equation", "equations"),
            count(left, "degree of freedom is", "degrees of freedom are"),
        ),
    )
    .label("can still move");
    for body in bodies.iter().skip(1).take(MAX_LISTED - 1) {
        diagnostic = diagnostic.also(body.span, "can still move");
    }
    diagnostic
        .help(remedy(system, parts))
        .note(format!(
            "undetermined coordinates: {}",
            free_coordinates(system, parts)
        ))
        .note(balance(system))
}

/// Reports the contact point of a joint that is undetermined while all bodies are determined.
fn undetermined_contact(system: &System, parts: &CoarseDecomposition) -> Diagnostic {
    let joints = parts.under_columns.iter().filter_map(|&column| {
        match system.coordinates[column].describes {
            Described::Contact { joint } => Some(&system.mechanism.joints[joint]),
            Described::Pose { .. } | Described::Auxiliary => None,
        }
    });
    let joints: Vec<&Joint> = joints.collect();
    let labels = listed(joints.iter().map(|joint| joint.label.as_str()));
    let span = joints.first().map_or(Span::default(), |joint| joint.span);
    Diagnostic::error(
        Code::TooFewEquations,
        span,
        format!("the contact point of {labels} is undetermined"),
    )
    .label("can slide along the curve")
    .help("give the curve another shape, or remove the joint")
    .note(balance(system))
}

/// Returns the addition that makes the system determined.
fn remedy(system: &System, parts: &CoarseDecomposition) -> String {
    let held: HashSet<usize> = system
        .rows
        .iter()
        .flat_map(|row| row.bodies.iter().copied())
        .collect();
    let loose = (1..system.mechanism.bodies.len())
        .filter(|body| !held.contains(body))
        .map(|body| system.mechanism.bodies[body].name.as_str());
    let loose: Vec<&str> = loose.collect();
    if !loose.is_empty() {
        let names = listed(loose.iter().copied());
        return if loose.len() == 1 {
            format!("body {names} has no joint: join it to another body or to the `ground`")
        } else {
            format!("bodies {names} have no joint: join them to other bodies or to the `ground`")
        };
    }
    // A driver only helps if an angle is among the free coordinates.
    let angle =
        parts
            .under_columns
            .iter()
            .find_map(|&column| match system.coordinates[column].describes {
                Described::Pose { body, axis: 2 } => Some(body),
                _ => None,
            });
    let has_mass = !system.mechanism.forces.masses.is_empty();
    match angle.map(|angle| &system.mechanism.bodies[angle].name) {
        Some(angle) if has_mass => format!(
            "drive a coordinate, for example `drive phi({angle}) = t;`, free it for forces by `free turn: phi({angle}) = 0;`, or add the missing joint"
        ),
        Some(angle) => format!(
            "drive a coordinate, for example `drive phi({angle}) = t;`, or add the missing joint"
        ),
        None => "add the missing joint, or a `drive` statement".to_string(),
    }
}

/// Returns the coordinates of the under-determined part, in backticks.
fn free_coordinates(system: &System, parts: &CoarseDecomposition) -> String {
    let names = parts
        .under_columns
        .iter()
        .map(|&column| system.coordinates[column].name.as_str());
    listed(names)
}

fn too_many(system: &System, parts: &CoarseDecomposition, survey: Option<&Survey>) -> Diagnostic {
    let mut joints: Vec<usize> = parts
        .over_rows
        .iter()
        .map(|&row| system.rows[row].joint)
        .collect();
    joints.dedup();
    let mut bodies: Vec<usize> = parts
        .over_rows
        .iter()
        .flat_map(|&row| system.rows[row].bodies.iter().copied())
        .filter(|&body| body > 0)
        .collect();
    bodies.sort_unstable();
    bodies.dedup();
    let surplus = parts.free_rows.len();
    let names = listed(
        bodies
            .iter()
            .map(|&body| system.mechanism.bodies[body].name.as_str()),
    );
    let noun = if bodies.len() == 1 { "body" } else { "bodies" };
    let joint = |at: usize| -> &Joint { &system.mechanism.joints[at] };
    // If the equations agree nevertheless, the repeated ones are known.
    let mut repeating: Vec<(usize, Vec<&Dependence>)> = Vec::new();
    for found in survey.iter().flat_map(|survey| &survey.dependences) {
        let at = system.row(found.row).joint;
        match repeating.iter_mut().find(|(known, _)| *known == at) {
            Some((_, own)) => own.push(found),
            None => repeating.push((at, vec![found])),
        }
    }
    let repeats = |at: usize| repeating.iter().any(|(known, _)| *known == at);
    let has_none_left = system.rows[parts.free_rows[0]].joint;
    let first = joints.iter().copied().find(|&at| repeats(at));
    let first = first.unwrap_or(has_none_left);
    let mut diagnostic = Diagnostic::error(
        Code::TooManyEquations,
        joint(first).span,
        format!(
            "{} too many on {noun} {names}",
            count(surplus, "equation", "equations")
        ),
    )
    .label(match repeats(first) {
        true => format!("`{}` repeats constraints of the others", joint(first).label),
        false => format!(
            "`{}` has no coordinate left to determine",
            joint(first).label
        ),
    });
    for &other in joints
        .iter()
        .filter(|&&other| other != first)
        .take(MAX_LISTED)
    {
        diagnostic = diagnostic.also(
            joint(other).span,
            match repeats(other) {
                true => "also repeats constraints of the others",
                false => "acts on the same coordinates",
            },
        );
    }
    for (at, own) in &repeating {
        let label = &joint(*at).label;
        if *at != first {
            diagnostic = diagnostic.note(format!("`{label}` repeats constraints of the others"));
        }
        for help in advice(system, joint(*at), own) {
            diagnostic = diagnostic.help(help);
        }
    }
    if let Some(survey) = survey.filter(|survey| !survey.dependences.is_empty()) {
        // Free motions are reported with missing equations.
        if parts.free_columns.is_empty() {
            diagnostic = with_freedom(diagnostic, system, survey);
        }
        return diagnostic.note(balance(system));
    }
    diagnostic
        .help(format!(
            "remove {} among these joints and drivers",
            count(surplus, "equation", "equations")
        ))
        .note(balance(system))
}
