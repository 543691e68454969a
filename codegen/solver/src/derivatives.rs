//! *What `transmission` and `sensitivity` statements ask for* → *named columns of numbers*.
//!
//! A transmission is the derivative of a point or coordinate by the value of a driver, a sensitivity that of a coordinate and its
//! rate by a parameter, both at a fixed time. Units are those of SI. The module does not know how columns are written.

use linkwright_codegen::stages::model::Requested;
use linkwright_codegen::stages::program::{Found, Program};
use linkwright_codegen::stages::system::{Cause, System};

use crate::instant::Layout;

/// `K_x per length(N, M)`, `phi2 per L2`, `phi2_d per L2`: first all transmissions, quantity by quantity and driver by driver, then
/// for each parameter all coordinates and all of their rates. Nothing where none is asked for.
pub fn names(system: &System) -> Vec<String> {
    let mechanism = &system.mechanism;
    let (drivers, parameters): (Vec<_>, Vec<_>) = system
        .directions
        .iter()
        .partition(|direction| !direction.is_parameter());
    let cause = |cause: Cause| match cause {
        Cause::Driver { joint, .. } => {
            let label = mechanism.joints[joint].label.as_str();
            label.strip_prefix("drive ").unwrap_or(label)
        }
        Cause::Parameter(parameter) => mechanism.parameters[parameter].name.as_str(),
    };
    let mut names = Vec::new();
    for requested in &mechanism.transmissions {
        for row in components(system, *requested) {
            names.extend(
                drivers
                    .iter()
                    .map(|it| format!("{row} per {}", cause(it.cause))),
            );
        }
    }
    for direction in parameters {
        for suffix in ["", "_d"] {
            let by = cause(direction.cause);
            let coordinates = system.coordinates.iter();
            names.extend(coordinates.map(|it| format!("{}{suffix} per {by}", it.name)));
        }
    }
    names
}

/// The components of what a transmission asks for.
fn components(system: &System, requested: Requested) -> Vec<String> {
    match requested {
        Requested::Point(place) => {
            let name = &system.outputs[place].name;
            ["x", "y"].map(|axis| format!("{name}_{axis}")).to_vec()
        }
        Requested::Coordinate(place) => {
            vec![system.coordinates[place].name.clone()]
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
