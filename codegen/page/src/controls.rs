//! Describes the parameters, inputs and starts of free coordinates of a mechanism as controls of a page.

use linkwright::Blocks as _;
use linkwright_codegen::stages::emit::Notation;
use linkwright_codegen::stages::emit::text::formula;
use linkwright_codegen::stages::expr::ExprId;
use linkwright_codegen::stages::model::Dimension;
use linkwright_codegen::stages::units::{OutputUnit, Unit};
use linkwright_solver::{Interpreted, Movable as _, Moved, Schedule, View as _};
use serde::Serialize;

use crate::forced::is_moved_by_forces;
use crate::question::Range;

/// Number of instants for which an end of a guessed range must close.
const TRIED: usize = 16;

/// Number of halvings in the search for an end.
const HALVINGS: usize = 7;

/// Part of the value, or of the characteristic length, that a guessed range extends beyond it.
const EXTENT: f64 = 0.9;

/// Extent of a guessed range around zero of a value without a scale.
const EXTENT_OF_ZERO: f64 = 1.0;

/// Extent of a guessed range of an angle (rad).
const EXTENT_OF_ANGLE: f64 = std::f64::consts::PI;

/// Part of the way to an end at which the mechanism still closes; at the end itself it is singular.
const CLOSING_PART: f64 = 0.98;

/// Number of significant digits of a guessed end.
const DIGITS: i32 = 3;

/// Parameter, input or start of a free coordinate with its range, in the unit that is shown.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Control {
    /// Name in the description.
    pub name: String,
    /// `parameter`, `input` or `free coordinate`, whose value is its start.
    pub kind: &'static str,
    /// Value; `None` for an input that is a function of time.
    pub value: Option<f64>,
    /// Unit, empty for plain numbers.
    pub unit: String,
    /// Lower end of the range.
    pub low: Option<f64>,
    /// Upper end of the range.
    pub high: Option<f64>,
    /// True if the description has no range, so that its ends are guesses.
    pub guessed: bool,
    /// Documentation.
    pub docs: String,
    /// Formula of an input that is a function of time.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub law: Option<String>,
}

/// Parameter, input or start of a free coordinate.
struct Quantity<'a> {
    name: &'a str,
    kind: &'static str,
    docs: &'a [String],
    dimension: Dimension,
    /// Value in SI units; `None` for a function of time.
    value: Option<f64>,
    law: Option<ExprId>,
    /// Range of the description, in SI units.
    range: Option<[f64; 2]>,
    /// Rate of a free coordinate at the start, in SI units; 0 for others.
    rate: f64,
}

/// Returns the parameters and inputs in the order of the description.
fn quantities(view: &Interpreted) -> Vec<Quantity<'_>> {
    let (pool, mechanism) = (view.pool(), &view.system().mechanism);
    let parameters = mechanism.parameters.iter().map(|it| Quantity {
        name: &it.name,
        kind: "parameter",
        docs: &it.docs,
        dimension: it.dimension,
        value: pool.graph.nominal(it.symbol),
        law: None,
        range: it.range,
        rate: 0.0,
    });
    let free = &mechanism.forces.free;
    let starts = view.input_laws().at(0.0);
    let inputs = mechanism.inputs.iter().enumerate().map(move |(index, it)| {
        let is_free = free.iter().any(|it| it.input == index);
        let start = starts.0[index];
        let value = match is_free {
            true => Some(start.value),
            false => pool.graph.constant_value(it.signal[0]),
        };
        Quantity {
            name: &it.name,
            kind: if is_free { "free coordinate" } else { "input" },
            docs: &it.docs,
            dimension: it.dimension,
            value,
            law: value.is_none().then_some(it.signal[0]),
            range: it.range,
            rate: if is_free { start.rate } else { 0.0 },
        }
    });
    parameters.chain(inputs).collect()
}

/// Returns the assignment of a value on a page to a parameter or an input: a number is in the unit of its control, and starts a free
/// coordinate with the rate that it has. `None` if the mechanism has none of this name, as after a change of the text.
///
/// # Errors
/// The text would be read as something else.
pub fn assignment(view: &Interpreted, name: &str, text: &str) -> Result<Option<String>, String> {
    let quantities = quantities(view);
    let Some(quantity) = quantities.iter().find(|it| it.name == name) else {
        return Ok(None);
    };
    let text = text.trim();
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => {
            let suffix = suffix(&unit_of(view, quantity.dimension));
            let course = match quantity.rate {
                0.0 => String::new(),
                rate => format!(" + ({rate:e})*t"),
            };
            Ok(Some(format!("{name} = {text}{suffix}{course}")))
        }
        Ok(_) => Err(format!("`{name}` needs a finite value")),
        Err(_) if text.contains(['\n', '\r']) => Err(format!("`{name}` needs one formula")),
        Err(_) => Ok(Some(format!("{name} = {text}"))),
    }
}

/// Returns all controls, with guessed ranges over which the mechanism still closes during the motion.
pub fn controls(view: &Interpreted, range: Range) -> Vec<Control> {
    let range = match is_moved_by_forces(view) {
        // What forces do decides how long the motion is: only its start must close.
        true => Range {
            to: range.from,
            ..range
        },
        false => range,
    };
    let reach = reach(view, range);
    all(view, |quantity, value| {
        let unit = unit_of(view, quantity.dimension);
        let ends = guessed(view, quantity, value, range, reach);
        let [low, high] = ends.map(|it| unit.of_si(it));
        Some(rounded(low, unit.of_si(value), high))
    })
}

/// Returns all controls, without ranges where the description has none.
pub fn described(view: &Interpreted) -> Vec<Control> {
    all(view, |_, _| None)
}

fn all(view: &Interpreted, ends: impl Fn(&Quantity<'_>, f64) -> Option<[f64; 2]>) -> Vec<Control> {
    let quantities = quantities(view);
    let controls = quantities.iter().map(|quantity| {
        let unit = unit_of(view, quantity.dimension);
        let declared = quantity
            .range
            .map(|both| both.map(|it| unit.rounded(it, 12)));
        let guess = || quantity.value.and_then(|value| ends(quantity, value));
        let ends = declared.or_else(guess);
        let docs = quantity.docs.iter().map(|it| it.trim());
        Control {
            name: quantity.name.to_string(),
            kind: quantity.kind,
            value: quantity.value.map(|it| unit.rounded(it, 12)),
            unit: unit.name.clone(),
            low: ends.map(|it| it[0]),
            high: ends.map(|it| it[1]),
            guessed: declared.is_none(),
            docs: docs.collect::<Vec<_>>().join(" "),
            law: quantity.law.map(|law| {
                let (pool, system) = (view.pool(), view.system());
                formula(pool, system, &[], Notation::Ascii, law)
            }),
        }
    });
    controls.collect()
}

/// Returns the unit in which a value is shown and typed.
pub fn unit_of(view: &Interpreted, dimension: Dimension) -> OutputUnit {
    let units = view.system().mechanism.units.of_messages();
    units.of(&dimension.unit_if_known())
}

/// Returns the unit behind a number in a description; empty for SI units without a name.
fn suffix(unit: &OutputUnit) -> String {
    match Unit::parse(&unit.name) {
        Some(_) => unit.name.replace('²', "^2").replace('³', "^3"),
        None => String::new(),
    }
}

/// Returns ends between which the motion reaches the instants that it reaches now, in SI units.
fn guessed(
    view: &Interpreted,
    quantity: &Quantity<'_>,
    value: f64,
    range: Range,
    reach: usize,
) -> [f64; 2] {
    let extent = match quantity.dimension {
        Dimension::Angle => EXTENT_OF_ANGLE,
        _ if value != 0.0 => EXTENT * value.abs(),
        Dimension::LENGTH => EXTENT * view.system().mechanism.characteristic_length,
        _ => EXTENT_OF_ZERO,
    };
    [-extent, extent].map(|extent| {
        let closes = |part: f64| {
            let value = value + part * extent;
            let mut changed = view.clone();
            let assignment = format!("{} = {value:e}", quantity.name);
            let is_set = changed.set(quantity.name, &assignment).is_ok();
            is_set && self::reach(&changed, range) >= reach
        };
        if closes(1.0) {
            return value + extent;
        }
        let [mut good, mut bad] = [0.0, 1.0];
        for _ in 0..HALVINGS {
            let middle = 0.5 * (good + bad);
            match closes(middle) {
                true => good = middle,
                false => bad = middle,
            }
        }
        value + CLOSING_PART * good * extent
    })
}

/// Returns the number of instants of a coarse schedule that the motion reaches from the design configuration.
fn reach(view: &Interpreted, range: Range) -> usize {
    let parameters = view.nominal_parameters();
    let (pose, modes) = (view.drawn_pose(&parameters), view.drawn_branches());
    let Ok(mut moved) = Moved::assemble(view.clone(), &pose, modes, range.from) else {
        return 0;
    };
    let step = (range.to - range.from) / TRIED as f64;
    let Ok(schedule) = Schedule::range(range.from, range.to, step) else {
        return 1;
    };
    let laws = view.input_laws();
    let visits = schedule.forward.visits();
    1 + visits
        .take_while(|visit| moved.move_to(visit.t, &laws.at(visit.t)).is_ok())
        .count()
}

/// Rounds both ends toward the value, so that they read well.
fn rounded(low: f64, value: f64, high: f64) -> [f64; 2] {
    if low.partial_cmp(&high) != Some(std::cmp::Ordering::Less) {
        return [low, high];
    }
    let place = 10.0_f64.powi((high - low).log10().floor() as i32 + 1 - DIGITS);
    // A division by a power of ten is rounded once, a product with its inverse twice.
    let steps = |end: f64| end / place;
    let [least, most] = [steps(low).ceil(), steps(high).floor()];
    let exact = |steps: f64| match place >= 1.0 {
        true => steps * place,
        false => steps / (1.0 / place).round(),
    };
    [exact(least).min(value), exact(most).max(value)]
}

#[cfg(test)]
mod tests {
    use super::rounded;

    #[test]
    fn ends_are_rounded_toward_the_value() {
        assert_eq!(rounded(63.237, 120.0, 227.77), [64.0, 227.0]);
        assert_eq!(rounded(-0.7811, 0.0, 0.7811), [-0.78, 0.78]);
        assert_eq!(rounded(1.0, 1.0, 1.0), [1.0, 1.0]);
    }
}
