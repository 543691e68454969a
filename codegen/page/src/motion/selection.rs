//! Finds the points and coordinates that a user names.

use linkwright_codegen::diagnostic::nearest;
use linkwright_codegen::stages::joint::geometry::Mark;
use linkwright_codegen::stages::system::{Described, System};

/// Axes of a pose in names of coordinates.
const AXES: [&str; 3] = ["x", "y", "phi"];

/// Endings of the names of rates and accelerations in tables of frames.
const RATES: [&str; 2] = ["_dd", "_d"];

/// Fields of coordinates, rates and accelerations in a frame of generated code.
const FIELDS: [&str; 3] = ["q.", "qd.", "qdd."];

/// Components of a point, as tables of frames and descriptions write them.
const COMPONENTS: [&str; 8] = ["_x", "_y", "_vx", "_vy", "_ax", "_ay", ".x", ".y"];

/// Function of generated code that returns a point.
const FUNCTION: &str = "point_";

/// Returns the indices of the named outputs, in the order of the names; all outputs if none is named. `3.P` is the point P of body 3.
///
/// # Errors
/// A sentence with the first unknown point and the known ones.
pub fn points(system: &System, names: &[String]) -> Result<Vec<usize>, String> {
    if names.is_empty() {
        return Ok((0..system.outputs.len()).collect());
    }
    let mut selected = Vec::with_capacity(names.len());
    for name in names {
        let output = point(system, name);
        let output = output.ok_or_else(|| unknown(system, "point", name, &point_names(system)));
        add(&mut selected, output?);
    }
    Ok(selected)
}

/// Returns the indices of the named coordinates and of the named outputs, in the order of the names.
///
/// # Errors
/// A sentence with the first unknown name and the known ones.
pub fn shown(system: &System, names: &[String]) -> Result<[Vec<usize>; 2], String> {
    let [mut coordinates, mut points] = [Vec::new(), Vec::new()];
    for name in names {
        let exact = system.coordinates.iter().position(|it| it.name == *name);
        let is_point = exact.is_none() && point_names(system).contains(&name.as_str());
        let selected_coordinate = exact.or_else(|| coordinate(system, name).filter(|_| !is_point));
        match (selected_coordinate, point(system, name)) {
            (Some(coordinate), _) => add(&mut coordinates, coordinate),
            (None, Some(point)) => add(&mut points, point),
            (None, None) => return Err(unknown_of_both(system, name)),
        }
    }
    Ok([coordinates, points])
}

fn add(selected: &mut Vec<usize>, place: usize) {
    if !selected.contains(&place) {
        selected.push(place);
    }
}

fn point_names(system: &System) -> Vec<&str> {
    system.outputs.iter().map(|it| it.name.as_str()).collect()
}

/// Coordinate of a name, which may be that in a table of frames or in generated code, `phi(2)`, or that of an angle.
fn coordinate(system: &System, name: &str) -> Option<usize> {
    let field = FIELDS.iter().find_map(|it| name.strip_prefix(it));
    let name = field.unwrap_or(name);
    let rate = RATES.iter().find_map(|it| name.strip_suffix(it));
    [Some(name), rate]
        .into_iter()
        .flatten()
        .find_map(|name| coordinate_itself(system, name))
}

fn coordinate_itself(system: &System, name: &str) -> Option<usize> {
    let known = |name: &str| system.coordinates.iter().position(|it| it.name == name);
    known(name)
        .or_else(|| known(&called(system, name)))
        .or_else(|| {
            let of = AXES.iter().enumerate().find_map(|(axis, own)| {
                let rest = name.strip_prefix(own)?;
                let inside = rest.strip_prefix('(').and_then(|it| it.strip_suffix(')'));
                let body = inside
                    .or_else(|| rest.strip_prefix('_'))
                    .unwrap_or(rest)
                    .trim();
                of_pose(system, body, axis)
            });
            // An angle without a body has only this coordinate.
            of.or_else(|| of_pose(system, name, 2).filter(|_| is_angle(system, name)))
        })
}

/// Coordinate of an axis of a body.
fn of_pose(system: &System, body: &str, axis: usize) -> Option<usize> {
    let body = body_of(system, body)?;
    let described = Described::Pose { body, axis };
    let mut coordinates = system.coordinates.iter();
    coordinates.position(|it| it.describes == described)
}

fn body_of(system: &System, name: &str) -> Option<usize> {
    let called = called(system, name);
    let mut bodies = system.mechanism.bodies.iter();
    bodies.position(|it| it.name == called)
}

fn is_angle(system: &System, name: &str) -> bool {
    body_of(system, name).is_some_and(|body| system.mechanism.bodies[body].is_angle())
}

/// Output of a name, which may be that of one of its components or of a function of generated code.
fn point(system: &System, name: &str) -> Option<usize> {
    let component = COMPONENTS.iter().find_map(|it| name.strip_suffix(it));
    // x(1.P)
    let inside = AXES[..2].iter().find_map(|axis| {
        let rest = name.strip_prefix(axis)?;
        rest.strip_prefix('(')?.strip_suffix(')')
    });
    let names = [Some(name), component, inside.map(str::trim)];
    let itself = names.into_iter().flatten();
    itself
        .clone()
        .find_map(|name| point_itself(system, name))
        .or_else(|| {
            let name = name.strip_prefix(FUNCTION)?;
            let mut names = system.outputs.iter();
            names.position(|it| it.name.to_lowercase() == name)
        })
}

fn point_itself(system: &System, name: &str) -> Option<usize> {
    let called = called(system, name);
    let output = system.outputs.iter().position(|it| it.name == called);
    output.or_else(|| of_body(system, &called))
}

/// Name of an element of an array in the system, written `rod[3]` or `phi_rod[3]`.
fn called(system: &System, written: &str) -> String {
    let axes = ["x_", "y_", "phi_"].into_iter();
    let axes = axes.filter(|it| written.starts_with(it)).chain([""]);
    let mut called = axes.flat_map(|axis| {
        let spellings = system.mechanism.spellings.iter();
        let same = spellings.filter(move |(_, it)| **it == written[axis.len()..]);
        same.map(move |(called, _)| format!("{axis}{called}"))
    });
    called.next().unwrap_or_else(|| written.to_string())
}

/// Returns an example of a point's name in the description: a point of the first moving body.
pub fn named_point(system: &System) -> String {
    let mut bodies = system.mechanism.moving_bodies().iter();
    let body = bodies.find(|body| !body.is_angle());
    let body = body.map_or("BODY", |body| body.name.as_str());
    format!(
        "name points in the braces of a body: `body {body} at (0, 0) {{ A: (0, 0), B: (0.1, 0) }}`"
    )
}

fn unknown(system: &System, what: &str, name: &str, known: &[&str]) -> String {
    let guess = match nearest(name, known.iter().copied()) {
        Some(guess) => format!("; did you mean `{guess}`?"),
        None => String::new(),
    };
    let title = &system.mechanism.name;
    if known.is_empty() {
        return format!(
            "no {what} `{name}` in `{title}`: it has none\n  = help: {}",
            named_point(system)
        );
    }
    format!(
        "no {what} `{name}` in `{title}`{guess}\n  its {what}s are: {}",
        known.join(", ")
    )
}

fn unknown_of_both(system: &System, name: &str) -> String {
    let coordinates: Vec<&str> = system
        .coordinates
        .iter()
        .map(|it| it.name.as_str())
        .collect();
    let points = point_names(system);
    let all = coordinates.iter().chain(&points).copied();
    let guess = nearest(name, all).map_or(String::new(), |it| format!("; did you mean `{it}`?"));
    let mut text = format!(
        "no coordinate or point `{name}` in `{}`{guess}\n  its coordinates are: {}",
        system.mechanism.name,
        coordinates.join(", ")
    );
    if !points.is_empty() {
        text += &format!("\n  its points are: {}", points.join(", "));
    }
    text
}

/// Output of a point that is named by a body that carries the point. The point may belong to another body that is pinned to it.
fn of_body(system: &System, name: &str) -> Option<usize> {
    let mechanism = &system.mechanism;
    let (body, point) = name.split_once('.')?;
    let body = mechanism.bodies.iter().find(|it| it.name == body)?;
    let own_mark = body.marks.iter().find(|it| it.name == point)?.mark;
    let mut seen: Vec<Mark> = vec![own_mark];
    let mut next = 0;
    while let Some(&mark) = seen.get(next) {
        next += 1;
        if let Some(output) = mechanism.points.iter().position(|it| it.mark == mark) {
            return Some(output);
        }
        let pinned = mechanism.joints.iter().filter(|it| it.kind.joins_points);
        let pairs = pinned.map(|it| &it.operands.marks);
        for marks in pairs.filter(|marks| marks.contains(&mark)) {
            let other = marks.iter().find(|it| !seen.contains(it)).copied();
            seen.extend(other);
        }
    }
    None
}
