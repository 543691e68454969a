//! Computes with units and dimensions: permitted sums, and factors of suffixes.
//!
//! A number without a suffix that stands alone is in the SI unit of the expected quantity. Beside a quantity with a unit, such
//! a number is a plain factor: `2*5mm` is a length. `t` and its products fit every dimension, since the unit of their factor is
//! rarely written: `1.5*t` means 1.5 1/s times t.

use crate::expr::{ExprId, Graph};
use crate::joint::Quantity;
use crate::units::{Named, of_description};

/// Dimension of a value, as far as units determine it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    /// Product of plain numbers: fits any quantity, and has the unit of its factor in a product.
    Number,
    /// Product with `t`, of unknown unit: fits any quantity.
    OfTime,
    /// Value in a unit of angles, or of a function that returns an angle.
    Angle,
    /// Rate of an angle (1), or its acceleration (2).
    AngleRate(u8),
    /// Powers of meter, second and kilogram; all zero for ratios, which may be angles.
    Marked {
        /// Power of the meter.
        length: i32,
        /// Power of the second.
        time: i32,
        /// Power of the kilogram.
        mass: i32,
    },
}

impl Dimension {
    /// Dimension of a length.
    pub const LENGTH: Dimension = Dimension::marked(1, 0, 0);
    pub(super) const RATIO: Dimension = Dimension::marked(0, 0, 0);
    /// Dimension of the rotation of a shaft over a length.
    pub(super) const ANGLE_PER_LENGTH: Dimension = Dimension::marked(-1, 0, 0);
    const TIME: Dimension = Dimension::marked(0, 1, 0);

    const FREQUENCY: Dimension = Dimension::marked(0, -1, 0);
    const SPEED: Dimension = Dimension::marked(1, -1, 0);
    const AREA: Dimension = Dimension::marked(2, 0, 0);
    /// Dimension of an acceleration.
    pub const ACCELERATION: Dimension = Dimension::marked(1, -2, 0);
    /// Dimension of a mass.
    pub const MASS: Dimension = Dimension::marked(0, 0, 1);
    /// Dimension of a moment of inertia.
    pub const INERTIA: Dimension = Dimension::marked(2, 0, 1);
    /// Dimension of a force.
    pub const FORCE: Dimension = Dimension::marked(1, -2, 1);
    /// Dimension of a power.
    pub(super) const POWER: Dimension = Dimension::marked(2, -3, 1);
    /// Dimension of a torque, and of a torsional stiffness, since an angle has no unit.
    pub const TORQUE: Dimension = Dimension::marked(2, -2, 1);
    /// Dimension of a force over a length.
    pub const STIFFNESS: Dimension = Dimension::marked(0, -2, 1);
    /// Dimension of a force over a speed.
    pub const DAMPING: Dimension = Dimension::marked(0, -1, 1);
    /// Dimension of a torque over an angular velocity.
    pub const ANGULAR_DAMPING: Dimension = Dimension::marked(2, -1, 1);

    /// Creates a dimension from powers of meter, second and kilogram.
    const fn marked(length: i32, time: i32, mass: i32) -> Dimension {
        Dimension::Marked { length, time, mass }
    }

    /// Returns the dimension of a quantity of a joint.
    pub fn of(quantity: Quantity) -> Dimension {
        match quantity {
            Quantity::Length => Dimension::LENGTH,
            Quantity::Angle => Dimension::Angle,
            Quantity::Power(length) => Dimension::marked(length, 0, 0),
        }
    }

    /// Returns the dimension of the rate of a quantity.
    pub fn of_rate(quantity: Quantity) -> Dimension {
        match quantity {
            Quantity::Length => Dimension::SPEED,
            Quantity::Angle => Dimension::FREQUENCY,
            Quantity::Power(length) => Dimension::marked(length, -1, 0),
        }
    }

    /// Returns the quantity that scales tolerances of a residual of this dimension.
    pub fn quantity(self) -> Quantity {
        match self {
            Dimension::Angle => Quantity::Angle,
            Dimension::LENGTH => Quantity::Length,
            Dimension::Marked { length, .. } => Quantity::Power(length),
            Dimension::Number | Dimension::OfTime | Dimension::AngleRate(_) => Quantity::Power(0),
        }
    }

    /// Returns the powers of meter, second and kilogram; `None` if units do not determine them.
    fn powers(self) -> Option<[i32; 3]> {
        match self {
            Dimension::Number | Dimension::OfTime => None,
            Dimension::Angle => Some([0; 3]),
            Dimension::AngleRate(order) => Some([0, -i32::from(order), 0]),
            Dimension::Marked { length, time, mass } => Some([length, time, mass]),
        }
    }

    /// Returns the dimension with these powers.
    fn of_powers([length, time, mass]: [i32; 3]) -> Dimension {
        Dimension::Marked { length, time, mass }
    }

    /// True if units determine the dimension.
    pub fn is_marked(self) -> bool {
        self.powers().is_some()
    }

    /// True if a value of this dimension is accepted where `other` is expected.
    pub fn fits(self, other: Dimension) -> bool {
        match (self.powers(), other.powers()) {
            (Some(one), Some(other)) => one == other,
            _ => true,
        }
    }

    /// Returns the dimension of a sum whose terms fit: that of the most specific term.
    pub fn joined(self, other: Dimension) -> Dimension {
        let says = |dimension: Dimension| match dimension {
            Dimension::Number => 0,
            Dimension::OfTime => 1,
            Dimension::Marked { .. } => 2,
            Dimension::Angle | Dimension::AngleRate(_) => 3,
        };
        if says(other) > says(self) {
            other
        } else {
            self
        }
    }

    /// Returns the dimension of a product, or of a quotient for `sign` −1.
    pub fn times(self, other: Dimension, sign: i32) -> Dimension {
        if self == Dimension::OfTime || other == Dimension::OfTime {
            return Dimension::OfTime;
        }
        if other == Dimension::Number {
            return self;
        }
        if (self, sign) == (Dimension::Number, 1) {
            return other;
        }
        let [own, others] = [self, other].map(|it| it.powers().unwrap_or([0; 3]));
        let powers =
            [0, 1, 2].map(|unit| own[unit].saturating_add(others[unit].saturating_mul(sign)));
        // The product or quotient of an angle and a ratio is an angle.
        let angles = (self == Dimension::Angle, other == Dimension::Angle);
        if powers == [0; 3] && matches!((angles, sign), ((true, false), _) | ((false, true), 1)) {
            return Dimension::Angle;
        }
        Dimension::of_powers(powers)
    }

    /// Returns the dimension of the rate of a value.
    pub fn rate(self) -> Dimension {
        match self {
            Dimension::Number | Dimension::OfTime => Dimension::OfTime,
            Dimension::Angle => Dimension::AngleRate(1),
            Dimension::AngleRate(order) => Dimension::AngleRate(order + 1),
            marked => marked.times(Dimension::TIME, -1),
        }
    }

    /// Returns the powers of m, s, kg and rad in tables of frames; plain numbers have none.
    pub fn column_powers(self) -> [i32; 4] {
        let [length, time, mass] = self.powers().unwrap_or_default();
        let is_angle = matches!(self, Dimension::Angle | Dimension::AngleRate(_));
        [length, time, mass, i32::from(is_angle)]
    }

    /// Returns the dimension of a power with the exponent `numerator`/`denominator`; `None` if the power of a unit is not an
    /// integer.
    pub fn power(self, numerator: i128, denominator: i128) -> Option<Dimension> {
        let Some([length, time, mass]) = self.powers() else {
            return Some(self);
        };
        if numerator == denominator {
            return Some(self);
        }
        let raised = |exponent: i32| {
            let scaled = i128::from(exponent).checked_mul(numerator)?;
            let whole = scaled % denominator == 0;
            if whole {
                i32::try_from(scaled / denominator).ok()
            } else {
                None
            }
        };
        Some(Dimension::Marked {
            length: raised(length)?,
            time: raised(time)?,
            mass: raised(mass)?,
        })
    }

    /// Returns the SI unit; empty for ratios, and if it is unknown.
    pub fn unit_if_known(self) -> String {
        match self {
            Dimension::Number | Dimension::OfTime | Dimension::RATIO => String::new(),
            known => known.unit(),
        }
    }

    /// Returns the SI unit in tables of frames, as a quotient: `m/s`, `N`, `rad/s²`; empty for plain numbers.
    pub fn column_unit(self) -> String {
        let powers = self.column_powers();
        match powers {
            [1, -2, 1, 0] => return "N".to_string(),
            [2, -2, 1, 0] => return "N*m".to_string(),
            [2, -3, 1, 0] => return "W".to_string(),
            [0, -2, 1, 0] => return "N/m".to_string(),
            _ => {}
        }
        let [length, time, mass, angle] = powers;
        let named = [("kg", mass), ("m", length), ("rad", angle), ("s", time)];
        let factors = |sign: i32| {
            let parts = named.iter().filter(|(_, power)| power * sign > 0);
            let parts = parts.map(|(unit, power)| match power * sign {
                1 => unit.to_string(),
                2 => format!("{unit}²"),
                3 => format!("{unit}³"),
                power => format!("{unit}^{power}"),
            });
            parts.collect::<Vec<_>>()
        };
        match (factors(1).join("*"), factors(-1).join("/")) {
            (above, below) if below.is_empty() => above,
            (above, below) if above.is_empty() => format!("1/{below}"),
            (above, below) => format!("{above}/{below}"),
        }
    }

    /// Returns the SI unit of a value of this dimension, for documentation.
    pub fn unit(self) -> String {
        match self {
            Dimension::Number | Dimension::OfTime => "SI units".to_string(),
            Dimension::Angle => "rad".to_string(),
            Dimension::AngleRate(1) => "rad/s".to_string(),
            Dimension::AngleRate(order) => format!("rad/s^{order}"),
            Dimension::RATIO => "1 or rad".to_string(),
            Dimension::FORCE => "N".to_string(),
            Dimension::TORQUE => "N*m".to_string(),
            Dimension::STIFFNESS => "N/m".to_string(),
            Dimension::DAMPING => "N*s/m".to_string(),
            Dimension::ANGULAR_DAMPING => "N*m*s".to_string(),
            Dimension::Marked { length, time, mass } => {
                let part = |unit: &str, exponent: i32| match exponent {
                    0 => None,
                    1 => Some(unit.to_string()),
                    _ => Some(format!("{unit}^{exponent}")),
                };
                let parts: Vec<String> = [part("kg", mass), part("m", length), part("s", time)]
                    .into_iter()
                    .flatten()
                    .collect();
                parts.join("*")
            }
        }
    }

    /// Returns the name in messages.
    pub fn name(self) -> String {
        match self {
            Dimension::Number => "a plain number".to_string(),
            Dimension::OfTime => "a product with `t`".to_string(),
            Dimension::Angle => "an angle".to_string(),
            Dimension::AngleRate(1) => "an angular velocity".to_string(),
            Dimension::AngleRate(_) => "an angular acceleration".to_string(),
            Dimension::RATIO => "a plain number or an angle".to_string(),
            Dimension::ANGLE_PER_LENGTH => "an angle over a length".to_string(),
            Dimension::LENGTH => "a length".to_string(),
            Dimension::TIME => "a time".to_string(),
            Dimension::FREQUENCY => "a frequency".to_string(),
            Dimension::SPEED => "a speed".to_string(),
            Dimension::AREA => "an area".to_string(),
            Dimension::ACCELERATION => "an acceleration".to_string(),
            Dimension::MASS => "a mass".to_string(),
            Dimension::INERTIA => "a moment of inertia".to_string(),
            Dimension::FORCE => "a force".to_string(),
            Dimension::TORQUE => "a torque".to_string(),
            Dimension::STIFFNESS => "a stiffness".to_string(),
            Dimension::DAMPING => "a damping".to_string(),
            Dimension::Marked { .. } => format!("a quantity in {}", self.unit()),
        }
    }
}

/// Returns the exact factor to SI units and the dimension of a unit of descriptions; `None` if it is unknown.
pub fn unit(name: &str, graph: &mut Graph) -> Option<(ExprId, Dimension)> {
    of_description(name).map(|it| exact(it, graph))
}

/// Returns the exact factor to SI units and the dimension of a unit of the table.
pub(super) fn exact(unit: &Named, graph: &mut Graph) -> (ExprId, Dimension) {
    let [numerator, denominator] = unit.factor;
    let mut factor = graph.rational(numerator, denominator);
    if unit.times_pi {
        let pi = graph.pi();
        factor = graph.multiply(factor, pi);
    }
    let [length, time, mass, angle] = unit.powers;
    let dimension = match [length, time, mass] {
        [0, 0, 0] if angle == 1 => Dimension::Angle,
        powers => Dimension::of_powers(powers),
    };
    (factor, dimension)
}

#[cfg(test)]
mod tests {
    use super::Dimension::{self, Angle, Number, OfTime};

    const LENGTH: Dimension = Dimension::LENGTH;
    const RATIO: Dimension = Dimension::RATIO;

    #[test]
    fn plain_numbers_leave_the_unit_to_the_other_factor() {
        assert_eq!(Number.times(LENGTH, 1), LENGTH);
        assert_eq!(LENGTH.times(Number, -1), LENGTH);
        assert_eq!(Angle.times(Number, 1), Angle);
        assert_eq!(Number.times(Number, -1), Number);
        let per_length = Dimension::marked(-1, 0, 0);
        assert_eq!(Number.times(LENGTH, -1), per_length);
        assert!(!Number.times(LENGTH, 1).fits(Angle));
    }

    #[test]
    fn products_with_time_fit_everything() {
        for other in [Number, OfTime, Angle, LENGTH] {
            assert_eq!(other.times(OfTime, 1), OfTime);
            assert_eq!(OfTime.times(other, -1), OfTime);
            assert!(OfTime.fits(other) && other.fits(OfTime));
        }
    }

    #[test]
    fn ratios_may_be_angles_and_angles_are_known_as_such() {
        assert_eq!(LENGTH.times(LENGTH, -1), RATIO);
        assert!(RATIO.fits(Angle) && !RATIO.fits(LENGTH));
        assert_eq!(RATIO.times(Angle, 1), Angle);
        assert_eq!(Angle.times(RATIO, -1), Angle);
        assert_eq!(RATIO.times(Angle, -1), RATIO);
        assert_eq!(Angle.times(Angle, 1), RATIO);
        assert_eq!(Angle.times(Angle, -1), RATIO);
        assert_eq!(Angle.times(LENGTH, 1), LENGTH);
        assert_eq!(RATIO.joined(Angle), Angle);
        assert_eq!(Number.joined(OfTime), OfTime);
    }
}
