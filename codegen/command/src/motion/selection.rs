//! *Names as a user writes them* → *which points and coordinates are shown*.

use linkwright_codegen::diagnostic::nearest;
use linkwright_codegen::stages::joint::geometry::Mark;
use linkwright_codegen::stages::system::System;

/// The indices of the named outputs, in the order of the names; all outputs if none is named. `3.P` is the point P of body 3.
///
/// # Errors
/// A sentence that names the first unknown point and the known ones.
pub fn points(system: &System, names: &[String]) -> Result<Vec<usize>, String> {
    let known: Vec<&str> = system.outputs.iter().map(|it| it.name.as_str()).collect();
    if names.is_empty() {
        return Ok((0..known.len()).collect());
    }
    let mut selected = Vec::with_capacity(names.len());
    for name in names {
        let called = called(system, name);
        let own = known.iter().position(|known| *known == called);
        match own.or_else(|| of_body(system, &called)) {
            Some(point) if selected.contains(&point) => {}
            Some(point) => selected.push(point),
            None => return Err(unknown(system, "point", name, &known)),
        }
    }
    Ok(selected)
}

/// The indices of the named coordinates, in the order of the names.
///
/// # Errors
/// A sentence that names the first unknown coordinate and the known ones.
pub fn coordinates(system: &System, names: &[String]) -> Result<Vec<usize>, String> {
    let known: Vec<&str> = system
        .coordinates
        .iter()
        .map(|it| it.name.as_str())
        .collect();
    let mut selected = Vec::with_capacity(names.len());
    for name in names {
        let called = called(system, name);
        match known.iter().position(|known| *known == called) {
            Some(coordinate) if selected.contains(&coordinate) => {}
            Some(coordinate) => selected.push(coordinate),
            None => return Err(unknown(system, "coordinate", name, &known)),
        }
    }
    Ok(selected)
}

/// What is called otherwise than it is written, `rod[3]`, `phi_rod[3]`, by what it is called.
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

/// Returns how the description would name a point, by its first moving body.
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

/// The output of a point that is named by a body that carries it, perhaps after another one that it is pinned to.
fn of_body(system: &System, name: &str) -> Option<usize> {
    let mechanism = &system.mechanism;
    let (body, point) = name.split_once('.')?;
    let body = mechanism.bodies.iter().find(|it| it.name == body)?;
    let own = body.marks.iter().find(|it| it.name == point)?.mark;
    let mut seen: Vec<Mark> = vec![own];
    let mut next = 0;
    while let Some(&mark) = seen.get(next) {
        next += 1;
        if let Some(output) = mechanism.points.iter().position(|it| it.mark == mark) {
            return Some(output);
        }
        let pinned = mechanism.joints.iter().filter(|it| it.kind.joins_points());
        let pairs = pinned.map(|it| &it.operands.marks);
        for marks in pairs.filter(|marks| marks.contains(&mark)) {
            let other = marks.iter().find(|it| !seen.contains(it)).copied();
            seen.extend(other);
        }
    }
    None
}
