//! Reads the parameters that are chosen, with their bounds.

use linkwright_calibrate::Bounds;
use linkwright_codegen::diagnostic::nearest;
use linkwright_codegen::stages::system::System;

use super::super::Problem;
use super::super::bounds::bounds;

/// Returns each parameter of `--param` with its bounds. A name without bounds takes those of the next name that has some.
///
/// # Errors
/// A name is unknown or repeated, bounds cannot be read, or a parameter has none.
pub fn chosen(system: &System, options: &[String]) -> Result<Vec<(String, Bounds)>, Problem> {
    let mechanism = &system.mechanism;
    let mut chosen: Vec<(String, Bounds)> = Vec::new();
    for (place, option) in options.iter().enumerate() {
        let (name, _) = split(option);
        let mut parameters = mechanism.parameters.iter();
        let Some(parameter) = parameters.find(|it| it.name == name) else {
            return Err(unknown(system, name));
        };
        if chosen.iter().any(|it| it.0 == name) {
            return Err(Problem(format!(
                "error: `--param` names `{name}` twice\n  = help: name each parameter once"
            )));
        }
        let written = options[place..]
            .iter()
            .find_map(|it| split(it).1.map(|range| (it, range)));
        let bounds = match written {
            Some((with, range)) => bounds(system, parameter, &format!("--param {with}"), range)?,
            None => bounds(system, parameter, &format!("--param {option}"), "..")?,
        };
        if !(bounds.low.is_finite() && bounds.high.is_finite()) {
            return Err(Problem(format!(
                "error: `{name}` has no bounds within which it could be chosen\n  = help: write both, for example `--param {name}={}`",
                example(parameter.dimension.unit().as_str())
            )));
        }
        chosen.push((name.to_string(), bounds));
    }
    match chosen.is_empty() {
        true => Err(none(system)),
        false => Ok(chosen),
    }
}

/// Splits an option into the name and the text of its range.
fn split(option: &str) -> (&str, Option<&str>) {
    match option.split_once('=') {
        Some((name, range)) => (name.trim(), Some(range)),
        None => (option.trim(), None),
    }
}

/// Returns a range in a unit.
fn example(unit: &str) -> &'static str {
    match unit {
        "m" => "20mm..200mm",
        "rad" => "0deg..360deg",
        _ => "1..10",
    }
}

fn unknown(system: &System, name: &str) -> Problem {
    let mechanism = &system.mechanism;
    let known = || mechanism.parameters.iter().map(|it| it.name.as_str());
    let help = match nearest(name, known()) {
        Some(meant) => format!("did you mean `{meant}`?"),
        None if mechanism.parameters.is_empty() => {
            "declare a parameter to choose, for example `param L2 = 40mm;`".to_string()
        }
        None => format!(
            "its parameters are: {}",
            known().collect::<Vec<_>>().join(", ")
        ),
    };
    Problem(format!(
        "error: `{}` has no parameter `{name}`\n  = help: {help}",
        mechanism.title()
    ))
}

fn none(system: &System) -> Problem {
    let mut parameters = system.mechanism.parameters.iter();
    let help = match parameters.next() {
        Some(it) => format!(
            "name parameters with their bounds, for example `--param {}={}`",
            it.name,
            example(it.dimension.unit().as_str())
        ),
        None => "declare a parameter to choose, for example `param L2 = 40mm;`".to_string(),
    };
    Problem(format!(
        "error: no parameter of `{}` is to be chosen\n  = help: {help}",
        system.mechanism.title()
    ))
}
