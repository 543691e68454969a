//! What a module offers → the sentences of its documentation, as lines of prose that no language has marked up yet.

mod assemblies;
mod loads;
mod responses;

pub(in crate::emit) use assemblies::{ASSEMBLIES, of_assembly, of_wanted_assembly};
pub(in crate::emit) use loads::{BLAMED_LOAD, LOADS};
pub(in crate::emit) use responses::{of_quantity, of_sensitivity, of_transmission};

use super::Module;
use crate::emit::derivation::SingularPose;
use crate::emit::{Notation, text};
use crate::joint::Quantity;
use crate::model::Dimension;
use crate::pool::Pool;
use crate::program::{Block, Level, NewtonBlock, Output, Requirements, Statement};
use crate::system::{Cause, Described, Pressure, Row, System, Unknown};

/// The longest line of documentation that is not broken, in characters.
const WIDTH: usize = 100;

/// The longest determinant that is documented.
const LONGEST: usize = 160;

/// Of a structure of coordinates.
pub(in crate::emit) const COORDINATES: [&str; 2] = [
    "The coordinates of all bodies: position of the origin in m, angle in rad. Also their rates (m/s, rad/s) and",
    "accelerations (m/s², rad/s²).",
];

/// Of Φ, Φ_q, Φ_t and γ.
pub(in crate::emit) const PHI: &str =
    "Φ(q, t): the residuals of all joints and drivers, zero where the mechanism is assembled.";
pub(in crate::emit) const PHI_Q: &str = "Φ_q(q, t): the Jacobian, one row per equation and one column per coordinate. What is not assigned is zero.";
pub(in crate::emit) const PHI_T: &str =
    "Φ_t(q, t): the partial derivatives of the residuals in t. The rates solve Φ_q q̇ = −Φ_t.";
pub(in crate::emit) const GAMMA: &str =
    "γ(q, q̇, t) = −((Φ_q q̇)_q q̇ + 2 Φ_qt q̇ + Φ_tt). The accelerations solve Φ_q q̈ = γ.";

/// Of the residuals that are monitored.
pub(in crate::emit) const MONITORED: &str = "The residuals of the redundant equations, in m or rad: they follow from those that are solved, so they are zero but for rounding wherever Φ is.";

/// Of what shows that frames lie on their path.
pub(in crate::emit) const KEEPS_TO_PATH: [&str; 2] = [
    "Whether a frame lies on the path of the last one: how far values are from where they are now (`radius`), and from a",
    "straight line (`deviation`), while the mechanism moves; or else the block of which that cannot be shown.",
];

/// Of what shows the same of closed forms by themselves.
pub(in crate::emit) const STAYS_REGULAR: [&str; 2] = [
    "Whether no two links come in line: how far their pins move at most (`moved`), and how far they turn (`turned`, `radius`); or",
    "else the block of which that cannot be shown.",
];

/// A paragraph, and what a description says besides.
fn with_docs(what: String, docs: &[String]) -> Vec<String> {
    let mut lines = vec![what];
    if !docs.is_empty() {
        lines.push(String::new());
        lines.extend(docs.iter().cloned());
    }
    lines
}

/// What the mechanism is.
pub(in crate::emit) fn of_mechanism(system: &System) -> Vec<String> {
    match system.mechanism.docs.as_slice() {
        [] => vec![format!("The mechanism `{}`.", system.mechanism.name)],
        docs => docs.to_vec(),
    }
}

/// What the motion is, where there are several.
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

/// What a coordinate is; the first of a body also carries what the description says of the body.
pub(in crate::emit) fn of_coordinate(coordinate: &Unknown, system: &System) -> Vec<String> {
    let (body, axis) = match coordinate.describes {
        Described::Pose { body, axis } => (&system.mechanism.bodies[body], axis),
        Described::Contact { joint } => {
            let label = &system.mechanism.joints[joint].label;
            let unit = match units(coordinate.quantity)[0] {
                "" => String::new(),
                unit => format!(", in {unit}"),
            };
            return vec![format!("Where `{label}` touches its curve{unit}.")];
        }
        Described::Auxiliary => return Vec::new(),
    };
    let name = &body.name;
    if body.is_angle() {
        return with_docs(format!("The angle {name}, in rad."), &body.docs);
    }
    match axis {
        0 => with_docs(format!("x of body {name}, in m."), &body.docs),
        1 => vec![format!("y of body {name}, in m.")],
        _ => vec![format!("Angle of body {name}, in rad.")],
    }
}

/// The units of a coordinate, its rate and its acceleration; nothing for 1.
fn units(quantity: Quantity) -> [&'static str; 3] {
    match quantity {
        Quantity::Length => ["m", "m/s", "m/s²"],
        Quantity::Angle => ["rad", "rad/s", "rad/s²"],
        Quantity::Power(_) => ["", "1/s", "1/s²"],
    }
}

/// What a parameter or an input is; `default` says when it has its value.
pub(in crate::emit) fn of_number(
    name: &str,
    dimension: Dimension,
    value: f64,
    default: &str,
    docs: &[String],
) -> Vec<String> {
    let unit = dimension.unit();
    with_docs(format!("`{name}`, in {unit}: {value:?} {default}."), docs)
}

/// What the motion of a point is, where frames hold all coordinates.
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

/// What the pressure angle of a joint is.
pub(in crate::emit) fn of_pressure(pressure: &Pressure, system: &System) -> Vec<String> {
    let joint = &system.mechanism.joints[pressure.joint];
    vec![
        format!("The pressure angle of `{}`, in rad.", joint.label),
        String::new(),
        "It is the angle between the common normal and the velocity of the follower's point at the"
            .to_string(),
    ]
}

/// One function of an output: the end of its name, and what it is.
pub(in crate::emit) fn of_output(output: &Output) -> Vec<(&'static str, String)> {
    match output {
        Output::Point { name, fields } if fields.len() == 3 => {
            vec![(
                "",
                format!("Motion of the point {name}, in m, m/s and m/s²."),
            )]
        }
        Output::Point { name, fields } => {
            let levels = [("position", "m"), ("velocity", "m/s")];
            let suffixes = ["_position", "_velocity"].into_iter();
            let levels = suffixes.zip(levels).take(fields.len());
            levels
                .map(|(suffix, (level, unit))| {
                    (
                        suffix,
                        format!("The {level} of the point {name}, in {unit}."),
                    )
                })
                .collect()
        }
        Output::Coordinate {
            name,
            quantity,
            fields,
        } => {
            let levels = [
                ("", "coordinate"),
                ("_rate", "rate of the coordinate"),
                ("_acceleration", "acceleration of the coordinate"),
            ];
            let levels = levels.into_iter().zip(units(*quantity)).take(fields.len());
            levels
                .map(|((suffix, what), unit)| (suffix, format!("The {what} {name}, in {unit}.")))
                .collect()
        }
    }
}

/// What tells the assembly modes of a block apart that is solved in closed form.
pub(in crate::emit) fn of_branch(meaning: &str) -> String {
    let mut characters = meaning.chars();
    let first = characters.next().map(char::to_uppercase);
    first.map_or(String::new(), |first| {
        first.chain(characters).chain(['.']).collect()
    })
}

/// The table of what must be positive.
pub(in crate::emit) fn of_requirements(requirements: &Requirements) -> &'static str {
    match requirements.limit_parameters() {
        true => "What must be positive whatever the parameters are: the joint, and what it is.",
        false => "What must be positive whatever drives it: the joint, and what it is.",
    }
}

/// What the modes of all loops are.
pub(in crate::emit) fn of_branches(module: &Module<'_>) -> &'static str {
    match module.program.blocks.iter().any(|it| it.newton.is_some()) {
        false => "The assembly mode of every loop that is solved in closed form.",
        true => "The assembly mode of every loop.",
    }
}

/// The unknowns that a block finds: `` `phi2`, `l1` ``.
pub(in crate::emit) fn found_by(newton: &NewtonBlock, system: &System) -> String {
    let names = newton.unknowns.iter();
    let names = names.map(|&unknown| format!("`{}`", system.unknown_name(unknown)));
    names.collect::<Vec<_>>().join(", ")
}

/// What a block does.
pub(in crate::emit) fn of_block(block: &Block, module: &Module<'_>) -> Vec<String> {
    let mut lines = vec![block.title.clone()];
    lines.extend(determinants(block, module));
    lines
}

/// The parts of a block.
fn parts_of<'a>(block: &Block, module: &'a Module<'_>) -> impl Iterator<Item = &'a SingularPose> {
    let place = block.place;
    module
        .poses
        .iter()
        .filter(move |pose| place == Some(pose.block))
}

/// What is said of the determinants of a block: `det = √3·sin φ₂: zero where …`.
fn determinants(block: &Block, module: &Module<'_>) -> Vec<String> {
    let mut lines = Vec::new();
    for pose in parts_of(block, module) {
        let short = |formula: &&String| formula.chars().count() <= LONGEST;
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

/// A text as lines of [`WIDTH`], broken between words.
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

/// What stands before the statements of a function; nothing of those that compute.
pub(in crate::emit) fn of_statement(statement: &Statement, module: &Module<'_>) -> Option<String> {
    let system = module.system;
    let level = match statement {
        Statement::Section(level) => *level,
        Statement::Heading(words) | Statement::Note(words) => return Some(module.said(words)),
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

/// Each row with its joint and its residual as a person writes it.
pub(in crate::emit) fn of_rows(pool: &Pool, system: &System, rows: &[Row]) -> Vec<String> {
    let line = |(index, row): (usize, &Row)| {
        let formula = text::readable(pool, system, &row.bodies, Notation::Ascii, row.residual);
        let formula = formula.map_or(String::new(), |formula| format!(": `{formula}`"));
        let label = &system.mechanism.joints[row.joint].label;
        format!("- {index}, {label}{formula}")
    };
    rows.iter().enumerate().map(line).collect()
}

/// What a row belongs to, before the first one of its joint that is `shown`.
pub(in crate::emit) fn before_row(
    system: &System,
    index: usize,
    shown: impl Fn(&Row) -> bool,
) -> Option<&str> {
    let joint = system.rows[index].joint;
    let mut before = system.rows[..index].iter().rev();
    let is_first = before
        .find(|row| shown(row))
        .is_none_or(|row| row.joint != joint);
    is_first.then(|| system.mechanism.joints[joint].label.as_str())
}

/// The columns and the rows of the Jacobian.
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

/// `0 x1, 1 y1, …`
fn numbered<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let names = names.enumerate();
    let names: Vec<String> = names
        .map(|(index, name)| format!("{index} `{name}`"))
        .collect();
    names.join(", ")
}
