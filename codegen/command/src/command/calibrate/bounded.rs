//! Reads the bounds of parameters from options: `a=1mm..2mm`, `a=0..`, `a=..`.

use linkwright_calibrate::{Bounds, Calibrator};
use linkwright_codegen::stages::columns::Unit;
use linkwright_codegen::stages::model::{Dimension, range_text};
use linkwright_codegen::stages::system::System;

use super::Problem;
use linkwright_solver::data::{number_and_unit, on_end};

/// Returns the calibrator with the bounds of the options.
pub fn bounded(
    calibrator: Calibrator,
    system: &System,
    options: &[String],
) -> Result<Calibrator, Problem> {
    let mut calibrator = calibrator;
    for option in options {
        let refused = |why: &str| {
            Problem(format!(
                "error: `--bound {option}` {why}\n  = help: write `L=1mm..2mm`, `L=0..` or `L=..` for no bounds"
            ))
        };
        let (name, range) = option
            .split_once('=')
            .ok_or_else(|| refused("does not name a parameter"))?;
        let (low, high) = range
            .split_once("..")
            .ok_or_else(|| refused("is not a range"))?;
        let name = name.trim();
        let fitted = calibrator.names().iter().position(|it| it == name);
        let place = fitted.ok_or_else(|| refused("is not one of `--param`"))?;
        let mut parameters = system.mechanism.parameters.iter();
        let parameter = parameters.find(|it| it.name == name);
        let dimension = parameter.map_or(Dimension::Number, |it| it.dimension);
        let range = parameter.and_then(|it| it.range);
        let widest = range.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
        let end = |text: &str, none: f64| match text.trim() {
            "" => Some(none),
            text => value(text, dimension).map(|it| on_end(it, widest)),
        };
        let low = end(low, widest[0]);
        let high = end(high, widest[1]);
        let (Some(low), Some(high)) = (low, high) else {
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
                "error: `--bound {option}` exceeds the range of `{name}`, which is {}\n  = help: choose bounds in the range, or extend the range in the description",
                range_text(widest, dimension, units)
            )));
        }
        calibrator = calibrator.within(place, Bounds { low, high });
    }
    Ok(calibrator)
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
