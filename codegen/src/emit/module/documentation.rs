//! Writes the documentation of generated modules, as lines without the markup of a language.

mod assemblies;
mod loads;
mod path;
mod responses;

pub(in crate::emit) use assemblies::{ASSEMBLIES, of_assembly, of_wanted_assembly};
pub(in crate::emit) use loads::{BLAMED_LOAD, LOADS};
pub(in crate::emit) use path::{
    IS_WITHIN, VERIFY_NONSINGULAR, VERIFY_NONSINGULAR_LANES, VERIFY_PATH, of_path,
};
pub(in crate::emit) use responses::{of_quantity, of_sensitivity, of_transmission};

use super::Module;
use super::wrapped::JOINED;
use crate::emit::derivation::SingularPose;
use crate::emit::{Notation, text};
use crate::joint::Quantity;
use crate::model::Dimension;
use crate::pool::Pool;
use crate::program::{Block, Level, NewtonBlock, Requirements, Statement};
use crate::system::{Cause, Described, Pressure, Row, System, Unknown};

/// Length at which a line of documentation is broken, in characters.
const WIDTH: usize = 100;

/// Length of a determinant up to which it is documented, in characters.
const MAX_DETERMINANT_LENGTH: usize = 160;

/// Documentation of the structure of coordinates.
pub(in crate::emit) const COORDINATES: [&str; 2] = [
    "Coordinates of all bodies: position of the origin in m, angle in rad. Also their rates (m/s, rad/s) and",
    "accelerations (m/s², rad/s²).",
];

/// Documentation of Φ.
pub(in crate::emit) const PHI: &str =
    "Φ(q, t): residuals of all joints and drivers, zero if the mechanism is assembled.";
/// Documentation of Φ_q.
pub(in crate::emit) const PHI_Q: &str = "Φ_q(q, t): Jacobian, one row per equation and one column per coordinate. Entries that are not assigned are zero.";
/// Documentation of Φ_t.
pub(in crate::emit) const PHI_T: &str =
    "Φ_t(q, t): partial derivatives of the residuals in t. The rates solve Φ_q q̇ = −Φ_t.";
/// Documentation of γ.
pub(in crate::emit) const GAMMA: &str =
    "γ(q, q̇, t) = −((Φ_q q̇)_q q̇ + 2 Φ_qt q̇ + Φ_tt). The accelerations solve Φ_q q̈ = γ.";

/// Documentation of the monitored residuals.
pub(in crate::emit) const MONITORED: &str = "Residuals of the redundant equations, in m or rad. They follow from the solved equations: if Φ is zero, they are zero except for rounding.";

/// Returns a paragraph, followed by the documentation in the description.
fn with_docs(what: String, docs: &[String]) -> Vec<String> {
    let mut lines = vec![what];
    if !docs.is_empty() {
        lines.push(String::new());
        lines.extend(docs.iter().cloned());
    }
    lines
}

/// Documentation of the mechanism.
pub(in crate::emit) fn of_mechanism(system: &System) -> Vec<String> {
    match system.mechanism.docs.as_slice() {
        [] => vec![format!("The mechanism `{}`.", system.mechanism.name)],
        docs => docs.to_vec(),
    }
}

/// Documentation of the motion; empty for a mechanism without motions.
pub(in crate::emit) fn of_motion(system: &System) -> Vec<String> {
    match &system.mechanism.motion {
        Some(motion) if !motion.docs.is_empty() => motion.docs.clone(),
        Some(motion) => vec![format!(
            "The motion `{}` of the mechanism `{}`.",
            motion.name, system.mechanism.name
        )],
        None => Vec::new(),
    }
}

/// Documentation of a coordinate; the first coordinate of a body has the documentation of the body.
pub(in crate::emit) fn of_coordinate(coordinate: &Unknown, system: &System) -> Vec<String> {
    let (body, axis) = match coordinate.describes {
        Described::Pose { body, axis } => (&system.mechanism.bodies[body], axis),
        Described::Contact { joint } => {
            let label = &system.mechanism.joints[joint].label;
            let unit = match units(coordinate.quantity)[0] {
                "" => String::new(),
                unit => format!(", in {unit}"),
            };
            return vec![format!("Contact point of `{label}` on its curve{unit}.")];
        }
        Described::Auxiliary => return Vec::new(),
    };
    let name = &body.name;
    if body.is_angle() {
        return with_docs(format!("Angle {name}, in rad."), &body.docs);
    }
    match axis {
        0 => with_docs(format!("x of body {name}, in m."), &body.docs),
        1 => vec![format!("y of body {name}, in m.")],
        _ => vec![format!("Angle of body {name}, in rad.")],
    }
}

/// Units of a coordinate, its rate and its acceleration; empty for 1.
pub(super) fn units(quantity: Quantity) -> [&'static str; 3] {
    match quantity {
        Quantity::Length => ["m", "m/s", "m/s²"],
        Quantity::Angle => ["rad", "rad/s", "rad/s²"],
        Quantity::Power(_) => ["", "1/s", "1/s²"],
    }
}

/// Documentation of a parameter or an input; `default` is the condition for its value.
pub(in crate::emit) fn of_number(
    name: &str,
    dimension: Dimension,
    value: f64,
    default: &str,
    range: Option<[f64; 2]>,
    docs: &[String],
) -> Vec<String> {
    let unit = dimension.unit();
    let range = range.map_or(String::new(), |[low, high]| {
        format!(" From {low:?} to {high:?} {unit}.")
    });
    with_docs(
        format!("`{name}`, in {unit}: {value:?} {default}.{range}"),
        docs,
    )
}

/// Documentation of the ranges of parameters or inputs, as `noun` names one.
pub(in crate::emit) fn of_ranges(noun: &str) -> String {
    format!("Range of each {noun}, in the order of the description. A value outside is a failure.")
}

/// Documentation of the motion of a point, if frames hold all coordinates.
pub(in crate::emit) fn of_point(index: usize, system: &System) -> Vec<String> {
    let point = &system.mechanism.points[index];
    let body = &system.mechanism.bodies[point.mark.frame.body.0].name;
    let carrier = match body == "ground" {
        true => "the ground".to_string(),
        false => format!("body {body}"),
    };
    let name = &system.outputs[index].name;
    with_docs(
        format!("Motion of the point {name} of {carrier}, in m, m/s and m/s²."),
        &point.docs,
    )
}

/// Documentation of a pressure angle; the language adds the last line.
pub(in crate::emit) fn of_pressure(pressure: &Pressure, system: &System) -> Vec<String> {
    let joint = &system.mechanism.joints[pressure.joint];
    vec![
        format!("Pressure angle of `{}`, in rad.", joint.label),
        String::new(),
        "It is the angle between the common normal and the velocity of the follower's point at the"
            .to_string(),
    ]
}

/// Documentation of the assembly mode of a closed form.
pub(in crate::emit) fn of_branch(meaning: &str) -> String {
    let mut characters = meaning.chars();
    let first = characters.next().map(char::to_uppercase);
    first.map_or(String::new(), |first| {
        first.chain(characters).chain(['.']).collect()
    })
}

/// Documentation of the table of values that must be positive.
pub(in crate::emit) fn of_requirements(requirements: &Requirements) -> &'static str {
    match requirements.limit_parameters() {
        true => "Values that must be positive for all parameters: the joint, and the value.",
        false => "Values that must be positive for all driver positions: the joint, and the value.",
    }
}

/// Documentation of the structure of all modes.
pub(in crate::emit) fn of_branches(module: &Module<'_>) -> &'static str {
    match module.program.blocks.iter().any(|it| it.newton.is_some()) {
        false => "Assembly mode of each loop that is solved in closed form.",
        true => "Assembly mode of each loop.",
    }
}

/// Returns the unknowns of a block: `` `phi2`, `l1` ``.
pub(in crate::emit) fn found_by(newton: &NewtonBlock, system: &System) -> String {
    let names = newton.unknowns.iter();
    let names = names.map(|&unknown| format!("`{}`", system.unknown_name(unknown)));
    names.collect::<Vec<_>>().join(", ")
}

/// Documentation of a block: title and singular poses.
pub(in crate::emit) fn of_block(block: &Block, module: &Module<'_>) -> Vec<String> {
    let mut lines = vec![block.title.clone()];
    lines.extend(determinants(block, module));
    lines
}

/// Returns the singular poses of a block.
fn parts_of<'a>(block: &Block, module: &'a Module<'_>) -> impl Iterator<Item = &'a SingularPose> {
    let place = block.place;
    module
        .poses
        .iter()
        .filter(move |pose| place == Some(pose.block))
}

/// Sentences about the determinants of a block: `det = √3·sin φ₂: zero where …`.
fn determinants(block: &Block, module: &Module<'_>) -> Vec<String> {
    let mut lines = Vec::new();
    for pose in parts_of(block, module) {
        let short = |formula: &&String| formula.chars().count() <= MAX_DETERMINANT_LENGTH;
        let text = match (pose.determinant.as_ref().filter(short), &pose.meaning) {
            (Some(formula), Some(meaning)) => {
                format!("det = {formula} up to the sign: zero where {meaning}.")
            }
            (Some(formula), None) => format!("det = {formula} up to the sign: never zero."),
            (None, Some(meaning)) => {
                format!("det has no short form; zero where {meaning}.")
            }
            (None, None) => "det is constant: never zero.".to_string(),
        };
        lines.push(String::new());
        lines.extend(broken(&text));
    }
    lines
}

/// Returns lines of at most [`WIDTH`] characters, broken between words.
fn broken(text: &str) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        let Some(line) = lines.last_mut() else { break };
        if line.is_empty() {
            line.push_str(word);
        } else if line.chars().count() + 1 + word.chars().count() <= WIDTH {
            line.push(' ');
            line.push_str(word);
        } else {
            lines.push(word.to_string());
        }
    }
    lines
}

/// Returns the comment that a statement stands for; `None` if the statement computes.
pub(in crate::emit) fn of_statement(statement: &Statement, module: &Module<'_>) -> Option<String> {
    let system = module.system;
    let level = match statement {
        Statement::Section(level) => *level,
        Statement::Heading(words) | Statement::Note(words) => return Some(module.comment(words)),
        _ => return None,
    };
    Some(match level {
        Level::Position => "Position.".to_string(),
        Level::Velocity => "Velocity.".to_string(),
        Level::Acceleration => "Acceleration.".to_string(),
        Level::Response(direction) => match system.directions[direction].cause {
            Cause::Driver { joint, .. } => {
                format!("Response to {}.", system.mechanism.joints[joint].label)
            }
            Cause::Parameter(place) => {
                format!(
                    "Sensitivity to {}.",
                    system.mechanism.parameters[place].name
                )
            }
        },
        Level::ResponseRate(_) => "Rate of this sensitivity.".to_string(),
        Level::Forces => "Forces.".to_string(),
    })
}

/// Returns a line for each row, with its joint and its readable residual.
pub(in crate::emit) fn of_rows(pool: &Pool, system: &System, rows: &[Row]) -> Vec<String> {
    let line = |(index, row): (usize, &Row)| {
        let formula = text::readable(pool, system, &row.bodies, Notation::Ascii, row.residual);
        let formula = formula.map_or(String::new(), |formula| format!(": `{formula}`"));
        let label = &system.mechanism.joints[row.joint].label;
        format!("- {index}, {label}{formula}")
    };
    rows.iter().enumerate().map(line).collect()
}

/// Returns the joint of a row if the row is the first printed one of the joint; otherwise `None`.
pub(in crate::emit) fn before_row(
    system: &System,
    index: usize,
    is_printed: impl Fn(&Row) -> bool,
) -> Option<&str> {
    let joint = system.rows[index].joint;
    let mut before = system.rows[..index].iter().rev();
    let is_first = before
        .find(|row| is_printed(row))
        .is_none_or(|row| row.joint != joint);
    is_first.then(|| system.mechanism.joints[joint].label.as_str())
}

/// Documentation of the Jacobian, with its columns and rows.
pub(in crate::emit) fn of_jacobian(system: &System) -> Vec<String> {
    let columns = numbered(
        system
            .coordinates
            .iter()
            .map(|coordinate| coordinate.name.as_str()),
    );
    let rows = numbered(system.rows.iter().map(|row| row.name.as_str()));
    vec![
        PHI_Q.to_string(),
        String::new(),
        format!("Columns: {columns}."),
        String::new(),
        format!("Rows: {rows}."),
    ]
}

/// Returns a numbered list of names: `0 x1, 1 y1, …`.
fn numbered<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let names = names.enumerate();
    let names: Vec<String> = names
        .map(|(index, name)| format!("{index}{JOINED}`{name}`"))
        .collect();
    names.join(", ")
}
