//! Reads bounds of parameters: `1mm..2mm`, `0..`, `..`.

use linkwright_calibrate::Bounds;
use linkwright_codegen::stages::columns::Unit;
use linkwright_codegen::stages::model::{Dimension, Parameter, range_text};
use linkwright_codegen::stages::system::System;
use linkwright_solver::data::{number_and_unit, on_end};

use super::Problem;

/// Returns the bounds of a parameter of `system` from the text of a range; an end without a number is that of the parameter's range.
/// `option` names the option with its value in errors.
///
/// # Errors
/// The text is not a range, the range is empty, or it exceeds that of the parameter.
pub fn bounds(
    system: &System,
    parameter: &Parameter,
    option: &str,
    text: &str,
) -> Result<Bounds, Problem> {
    let name = &parameter.name;
    let refused = |why: &str| {
        Problem(format!(
            "error: `{option}` {why}\n  = help: write `{name}=1mm..2mm`, `{name}=0..` or `{name}=..` for no bounds"
        ))
    };
    let (low, high) = text
        .split_once("..")
        .ok_or_else(|| refused("is not a range"))?;
    let dimension = parameter.dimension;
    let widest = parameter
        .range
        .unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
    let end = |text: &str, none: f64| match text.trim() {
        "" => Some(none),
        text => value(text, dimension).map(|it| on_end(it, widest)),
    };
    let (Some(low), Some(high)) = (end(low, widest[0]), end(high, widest[1])) else {
        return Err(refused(
            "has an end that is not a number with a unit of the parameter",
        ));
    };
    if low >= high {
        return Err(refused("is empty"));
    }
    if low < widest[0] || widest[1] < high {
        let units = system.mechanism.units.of_messages();
        return Err(Problem(format!(
            "error: `{option}` exceeds the range of `{name}`, which is {}\n  = help: choose bounds in the range, or extend the range in the description",
            range_text(widest, dimension, units)
        )));
    }
    Ok(Bounds { low, high })
}

/// Reads a number with or without a unit; the result is in SI units.
fn value(text: &str, dimension: Dimension) -> Option<f64> {
    let (number, unit) = number_and_unit(text)?;
    let value = match unit {
        "" => number,
        unit => {
            let unit = Unit::parse(unit)?;
            let powers = match dimension {
                Dimension::Angle | Dimension::AngleRate(_) => dimension.column_powers(),
                Dimension::Marked { length, time, mass } => [length, time, mass, unit.powers[3]],
                Dimension::Number | Dimension::OfTime => unit.powers,
            };
            unit.measuring(powers)?.si(number)
        }
    };
    value.is_finite().then_some(value)
}
