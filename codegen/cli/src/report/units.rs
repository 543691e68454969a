//! A coordinate → the units in which a person reads it, its rate and its acceleration.

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
    /// Whether it is an angle.
    pub is_turn: bool,
}

impl Units {
    /// Those of a coordinate.
    pub fn of(system: &System, coordinate: usize, angles: TurnUnit) -> Units {
        match (system.coordinates[coordinate].quantity, angles) {
            (Quantity::Angle, TurnUnit::Rad) => Units {
                levels: ["rad", "rad/s", "rad/s²"],
                factor: 1.0,
                is_turn: true,
            },
            (Quantity::Angle, TurnUnit::Deg) => Units {
                levels: ["deg", "deg/s", "deg/s²"],
                factor: 1.0_f64.to_degrees(),
                is_turn: true,
            },
            (Quantity::Length, _) => Units {
                levels: ["m", "m/s", "m/s²"],
                factor: 1.0,
                is_turn: false,
            },
            (Quantity::Power(_), _) => Units {
                levels: ["", "1/s", "1/s²"],
                factor: 1.0,
                is_turn: false,
            },
        }
    }
}
