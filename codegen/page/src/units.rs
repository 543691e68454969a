//! Finds the units of coordinates, points and columns of a motion in reports, files and pictures.

use linkwright_codegen::stages::joint::Quantity;
use linkwright_codegen::stages::system::System;
use linkwright_codegen::stages::units::{OutputUnit, OutputUnits};
use linkwright_solver::View;
use linkwright_solver::number::fixed;

use crate::motion::Followed;

/// SI units of a length, its rate and its acceleration.
pub const LENGTHS: [&str; 3] = ["m", "m/s", "m/s²"];

/// SI units of an angle, its rate and its acceleration.
pub const ANGLES: [&str; 3] = ["rad", "rad/s", "rad/s²"];

/// SI units of a parameter of a curve, its rate and its acceleration.
pub const OTHERS: [&str; 3] = ["", "1/s", "1/s²"];

/// Units of a coordinate.
#[derive(Clone, Debug)]
pub struct Units {
    /// Units of the coordinate, its rate and its acceleration.
    pub levels: [OutputUnit; 3],
    /// Characteristic value of the coordinate, in the first of these units.
    pub size: f64,
}

impl Units {
    /// Returns the units of a coordinate.
    pub fn of(system: &System, coordinate: usize, units: &OutputUnits) -> Units {
        let quantity = system.coordinates[coordinate].quantity;
        let size = match quantity {
            Quantity::Angle => 1.0,
            Quantity::Length | Quantity::Power(_) => system.mechanism.characteristic_length,
        };
        let levels = si_levels(quantity).map(|it| units.of(it));
        Units {
            size: levels[0].of_si(size),
            levels,
        }
    }
}

/// Returns the unit of a coordinate without its rates.
pub fn of_coordinate(system: &System, coordinate: usize, units: &OutputUnits) -> OutputUnit {
    units.of(si_of(system.coordinates[coordinate].quantity))
}

/// Returns the SI unit of a coordinate of this quantity.
pub fn si_of(quantity: Quantity) -> &'static str {
    si_levels(quantity)[0]
}

/// Returns the SI units of a coordinate of this quantity, its rate and its acceleration.
pub fn si_levels(quantity: Quantity) -> [&'static str; 3] {
    match quantity {
        Quantity::Angle => ANGLES,
        Quantity::Length => LENGTHS,
        Quantity::Power(_) => OTHERS,
    }
}

/// Names of the units of coordinates and points in JSON.
#[derive(serde::Serialize)]
pub struct UnitNames {
    t: &'static str,
    q: Vec<String>,
    qd: Vec<String>,
    qdd: Vec<String>,
    position: String,
    velocity: String,
    acceleration: String,
}

/// Units of the columns of a motion.
pub struct ColumnUnits {
    /// Units of each coordinate, its rate and its acceleration.
    pub coordinates: Vec<[OutputUnit; 3]>,
    /// Units of positions, velocities and accelerations of points.
    pub points: [OutputUnit; 3],
    /// Units of transmissions and sensitivities.
    pub derivatives: Vec<OutputUnit>,
    /// Units of forces and measures.
    pub reported: Vec<OutputUnit>,
}

impl ColumnUnits {
    /// Returns the units of the files of a motion.
    pub fn of<V: View>(motion: &Followed<V>) -> ColumnUnits {
        let system = motion.system();
        let units = system.mechanism.units.of_tables();
        let coordinates = 0..system.coordinates.len();
        let derivatives = motion.derivative_names.iter();
        let reported = motion.reported_names.iter();
        ColumnUnits {
            coordinates: coordinates
                .map(|it| Units::of(system, it, &units).levels)
                .collect(),
            points: LENGTHS.map(|it| units.of(it)),
            derivatives: derivatives.map(|(_, si)| units.of(si)).collect(),
            reported: reported.map(|(_, si)| units.of(si)).collect(),
        }
    }

    /// Returns the names of the units of coordinates and points.
    pub fn names(&self) -> UnitNames {
        let level = |level: usize| {
            let coordinates = self.coordinates.iter();
            coordinates.map(|it| it[level].name.clone()).collect()
        };
        let [position, velocity, acceleration] = self.points.clone().map(|it| it.name);
        UnitNames {
            t: "s",
            q: level(0),
            qd: level(1),
            qdd: level(2),
            position,
            velocity,
            acceleration,
        }
    }
}

/// Units in the last place by which a converted number may be off: a factor, a product and a quotient are rounded.
const ROUNDED: usize = 4;

/// Returns a range in a unit that encloses a range in SI units.
pub fn enclosing(unit: &OutputUnit, [low, high]: [f64; 2]) -> [f64; 2] {
    if unit.is_si() {
        return [low, high];
    }
    let outwards = |value: f64, next: fn(f64) -> f64| {
        (0..ROUNDED).fold(unit.of_si(value), |value, _| next(value))
    };
    [outwards(low, f64::next_down), outwards(high, f64::next_up)]
}

/// Returns a value of SI in a unit, with its name; degrees have their sign.
pub fn text_of(value: f64, unit: &OutputUnit, decimals: usize) -> String {
    let value = fixed(unit.of_si(value), decimals);
    match unit.name.as_str() {
        "deg" => format!("{value}°"),
        name => format!("{value} {name}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn converted_ranges_enclose_the_exact_ones() {
        let units = OutputUnits::default().or("inch");
        let [low, high] = enclosing(&units.of("m"), [0.1, 0.1]);
        // 0.1 m = 1000/254 inch.
        assert!(low < 1000.0 / 254.0 && 1000.0 / 254.0 < high && high - low < 1e-14);
        assert_eq!(enclosing(&units.of("rad"), [0.1, 0.2]), [0.1, 0.2]);
    }
}
