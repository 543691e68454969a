//! *What `transmission` and `sensitivity` statements ask for* → *named columns of numbers*.
//!
//! A transmission is the derivative of a point or coordinate by the value of a driver, a sensitivity that of a coordinate and its
//! rate by a parameter, both at a fixed time. Units are those of SI. The module does not know how columns are written.

use linkwright_codegen::stages::joint::Quantity;
use linkwright_codegen::stages::model::{Dimension, Requested};
use linkwright_codegen::stages::program::{Found, Program};
use linkwright_codegen::stages::system::{Cause, System};

use crate::instant::Layout;

/// Returns the names of derivatives, each with its unit of SI: `K_x per length(N, M)`, `phi2 per L2`, `phi2_d per L2`.
///
/// First come all transmissions, quantity by quantity and driver by driver, then for each parameter all coordinates and all of their
/// rates. Empty if nothing is requested.
pub fn names(system: &System) -> Vec<(String, String)> {
    let mechanism = &system.mechanism;
    let (drivers, parameters): (Vec<_>, Vec<_>) = system
        .directions
        .iter()
        .partition(|direction| !direction.is_parameter());
    let mut names = Vec::new();
    for requested in &mechanism.transmissions {
        for (row, unit) in components(system, *requested) {
            names.extend(drivers.iter().map(|it| {
                let (cause, of_cause) = cause(system, it.cause);
                (format!("{row} per {cause}"), quotient(&unit, &of_cause))
            }));
        }
    }
    for direction in parameters {
        let (by, of_cause) = cause(system, direction.cause);
        for (suffix, rate) in [("", ""), ("_d", "/s")] {
            let coordinates = system.coordinates.iter();
            names.extend(coordinates.map(|it| {
                let unit = format!("{}{rate}", si(it.quantity));
                (
                    format!("{}{suffix} per {by}", it.name),
                    quotient(&unit, &of_cause),
                )
            }));
        }
    }
    names
}

/// Name and unit of what a derivative is taken by.
fn cause(system: &System, cause: Cause) -> (&str, String) {
    let mechanism = &system.mechanism;
    match cause {
        Cause::Driver { joint, .. } => {
            let label = mechanism.joints[joint].label.as_str();
            let mut driven = system.driven().into_iter();
            let quantity = driven.find(|it| it.1 == joint).map(|it| it.2);
            (
                label.strip_prefix("drive ").unwrap_or(label),
                quantity.map_or(String::new(), si),
            )
        }
        Cause::Parameter(place) => {
            let own = &mechanism.parameters[place];
            let unit = match own.dimension {
                Dimension::Angle | Dimension::Marked { .. } => own.dimension.unit(),
                // Its unit is not known.
                Dimension::Number | Dimension::OfTime => String::new(),
            };
            (own.name.as_str(), unit)
        }
    }
}

/// Unit of SI of a quantity; empty for plain numbers.
fn si(quantity: Quantity) -> String {
    match quantity {
        Quantity::Angle => "rad".to_string(),
        Quantity::Length => "m".to_string(),
        Quantity::Power(0) => String::new(),
        Quantity::Power(power) => format!("m^{power}"),
    }
}

/// Unit of a quotient, `m/rad`; empty for a plain number.
fn quotient(over: &str, under: &str) -> String {
    if over == under {
        return String::new();
    }
    // The rate of a length by a length is in 1/s.
    if let Some(rest) = over.strip_prefix(under).filter(|it| it.starts_with('/')) {
        return format!("1{rest}");
    }
    // Each factor of the divisor is divided by: m/(N*m) is m/N/m.
    let divisor: String = under
        .chars()
        .map(|it| match it {
            '*' => '/',
            '/' => '*',
            other => other,
        })
        .collect();
    match (over, under) {
        (over, "") => over.to_string(),
        ("", _) => format!("1/{divisor}"),
        _ => format!("{over}/{divisor}"),
    }
}

/// Components of what a transmission requests, each with its unit.
fn components(system: &System, requested: Requested) -> Vec<(String, String)> {
    match requested {
        Requested::Point(place) => {
            let name = &system.outputs[place].name;
            let axes = ["x", "y"].map(|axis| (format!("{name}_{axis}"), "m".to_string()));
            axes.to_vec()
        }
        Requested::Coordinate(place) => {
            let own = &system.coordinates[place];
            vec![(own.name.clone(), si(own.quantity))]
        }
    }
}

/// Where an instant holds a derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Derivative {
    /// At a place among its values.
    Kept(usize),
    /// Nowhere: it is always the same.
    Constant(f64),
}

/// What the program of a mechanism computes, in the order of [`names`].
pub(crate) fn of_program(program: &Program, layout: &Layout) -> Vec<Derivative> {
    let kept = |symbol| match layout.slot(symbol) {
        Some(slot) => Derivative::Kept(slot),
        None => Derivative::Constant(f64::NAN),
    };
    let found = |found: &Found| match *found {
        Found::Field(symbol) => kept(symbol),
        Found::Constant(value) => Derivative::Constant(value),
    };
    let mut all = Vec::new();
    for transmission in &program.transmissions {
        for row in 0..transmission.rows.len() {
            all.extend(transmission.columns.iter().map(|column| kept(column[row])));
        }
    }
    for sensitivity in &program.sensitivities {
        for level in 0..2 {
            let coordinates = sensitivity.coordinates.iter().flatten();
            all.extend(coordinates.map(|both| found(&both[level])));
        }
    }
    all
}
