//! *What `transmission` and `sensitivity` statements ask for, and frames → named columns of numbers.*
//!
//! A transmission is the derivative of a point or coordinate by the value of a driver, a sensitivity that of a coordinate and its
//! rate by a parameter, both at a fixed time. Units are those of SI. The module does not know how columns are written.

use linkwright::Frame;
use linkwright_codegen::model::Requested;
use linkwright_codegen::system::{Cause, System};
use nalgebra::Dyn;

use crate::interpreter::Interpreter;

/// The derivatives over all frames.
#[derive(Clone, Debug, Default)]
pub struct Derivatives {
    /// `K_x per length(N, M)`, `phi2 per L2`, `phi2_d per L2`; nothing where none is asked for.
    pub names: Vec<String>,
    /// One value a name at each frame; `None` where Φ_q is singular.
    pub values: Vec<Option<Vec<f64>>>,
}

impl Derivatives {
    /// The derivatives at these frames.
    pub fn over(system: &System, interpreter: &Interpreter, frames: &[Frame<f64, Dyn>]) -> Self {
        let names = names(system);
        let values = match names.is_empty() {
            true => Vec::new(),
            false => frames
                .iter()
                .map(|it| at(system, interpreter, it))
                .collect(),
        };
        Derivatives { names, values }
    }
}

/// Coordinates, their rates, and what moves them.
fn names(system: &System) -> Vec<String> {
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
        for row in rows(system, *requested) {
            let columns = drivers
                .iter()
                .map(|it| format!("{row} per {}", cause(it.cause)));
            names.extend(columns);
        }
    }
    for direction in parameters {
        for suffix in ["", "_d"] {
            let coordinates = system.coordinates.iter();
            names.extend(
                coordinates.map(|it| format!("{}{suffix} per {}", it.name, cause(direction.cause))),
            );
        }
    }
    names
}

/// The components of what a transmission asks for.
fn rows(system: &System, requested: Requested) -> Vec<String> {
    match requested {
        Requested::Point(place) => {
            let name = &system.outputs[place].name;
            ["x", "y"].map(|axis| format!("{name}_{axis}")).to_vec()
        }
        Requested::Coordinate { body, axis } => {
            vec![system.coordinates[3 * (body - 1) + axis].name.clone()]
        }
    }
}

/// The values in the order of the names.
fn at(system: &System, interpreter: &Interpreter, frame: &Frame<f64, Dyn>) -> Option<Vec<f64>> {
    let responses = interpreter.responses(&frame.q, frame.t).ok()?;
    let mut values = Vec::new();
    for matrix in interpreter.transmissions(&frame.q, frame.t, &responses) {
        values.extend(matrix.transpose().iter());
    }
    let drivers = system
        .directions
        .iter()
        .filter(|it| !it.is_parameter())
        .count();
    if drivers < system.directions.len() {
        let rates = interpreter.sensitivity_rates(frame, &responses).ok()?;
        for (response, rate) in responses
            .column_iter()
            .skip(drivers)
            .zip(rates.column_iter())
        {
            values.extend(response.iter());
            values.extend(rate.iter());
        }
    }
    Some(values)
}
