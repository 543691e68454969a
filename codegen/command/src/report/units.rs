//! A coordinate → the units in which a person reads it, its rate and its acceleration, and how large it is.

use linkwright_codegen::stages::joint::Quantity;
use linkwright_codegen::stages::system::System;

use crate::arguments::TurnUnit;

/// Units, and what a value in m, rad and s is multiplied by.
#[derive(Clone, Copy, Debug)]
pub struct Units {
    /// Of the coordinate, its rate and its acceleration.
    pub levels: [&'static str; 3],
    /// The value in these units of 1 in SI units.
    pub factor: f64,
    /// A characteristic value of the coordinate in these units.
    pub size: f64,
}

impl Units {
    /// Those of a coordinate.
    pub fn of(system: &System, coordinate: usize, angles: TurnUnit) -> Units {
        let length = system.mechanism.characteristic_length;
        let (levels, factor, size) = match (system.coordinates[coordinate].quantity, angles) {
            (Quantity::Angle, TurnUnit::Rad) => (["rad", "rad/s", "rad/s²"], 1.0, 1.0),
            (Quantity::Angle, TurnUnit::Deg) => {
                let factor = 1.0_f64.to_degrees();
                (["deg", "deg/s", "deg/s²"], factor, factor)
            }
            (Quantity::Length, _) => (["m", "m/s", "m/s²"], 1.0, length),
            (Quantity::Power(_), _) => (["", "1/s", "1/s²"], 1.0, length),
        };
        Units {
            levels,
            factor,
            size,
        }
    }

    /// The SI unit of a coordinate.
    pub fn si(system: &System, coordinate: usize) -> &'static str {
        Units::of(system, coordinate, TurnUnit::Rad).levels[0]
    }
}
