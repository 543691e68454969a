//! Units and dimensions: which quantities may be added, and what a suffix multiplies by.
//!
//! A number without a suffix is in SI units of whatever is expected where it stands alone, and a factor without a unit beside a
//! quantity that has one: `2*5mm` is a length. `t` and its products fit everything, since the unit of what it is multiplied by is
//! rarely written: `1.5*t` is meant as 1.5 1/s times t.

use crate::expr::{ExprId, Graph};
use crate::joint::Quantity;

/// What a value measures, as far as units say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    /// Made of numbers without units: fits any quantity, and leaves its unit to what it is multiplied by.
    Number,
    /// A product with `t`, whose unit is not known: fits any quantity.
    OfTime,
    /// Given in a unit of angles, or by a function that gives an angle.
    Angle,
    /// Powers of meter and second; both zero for ratios, which may be angles.
    Marked {
        /// Power of the meter.
        length: i32,
        /// Power of the second.
        time: i32,
    },
}

impl Dimension {
    /// A length.
    pub const LENGTH: Dimension = Dimension::Marked { length: 1, time: 0 };

    /// The dimension of a quantity that a joint asks for.
    pub fn of(quantity: Quantity) -> Dimension {
        match quantity {
            Quantity::Length => Dimension::LENGTH,
            Quantity::Angle => Dimension::Angle,
            Quantity::Power(length) => Dimension::Marked { length, time: 0 },
        }
    }

    /// What a residual of this dimension is judged as.
    pub fn quantity(self) -> Quantity {
        match self {
            Dimension::Angle => Quantity::Angle,
            Dimension::LENGTH => Quantity::Length,
            Dimension::Marked { length, .. } => Quantity::Power(length),
            Dimension::Number | Dimension::OfTime => Quantity::Power(0),
        }
    }

    /// The powers of meter and second, where units say what they are.
    fn powers(self) -> Option<(i32, i32)> {
        match self {
            Dimension::Number | Dimension::OfTime => None,
            Dimension::Angle => Some((0, 0)),
            Dimension::Marked { length, time } => Some((length, time)),
        }
    }

    /// Whether units say what it is.
    pub fn is_marked(self) -> bool {
        self.powers().is_some()
    }

    /// Whether a value of this dimension can stand where `other` is expected.
    pub fn fits(self, other: Dimension) -> bool {
        match (self.powers(), other.powers()) {
            (Some(one), Some(other)) => one == other,
            _ => true,
        }
    }

    /// The dimension of a sum whose terms fit one another: what the term that says most about it says.
    pub fn joined(self, other: Dimension) -> Dimension {
        let says = |dimension: Dimension| match dimension {
            Dimension::Number => 0,
            Dimension::OfTime => 1,
            Dimension::Marked { .. } => 2,
            Dimension::Angle => 3,
        };
        if says(other) > says(self) {
            other
        } else {
            self
        }
    }

    /// The dimension of a product, or of a quotient with `sign` −1.
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
        let ((l, t), (m, u)) = (
            self.powers().unwrap_or((0, 0)),
            other.powers().unwrap_or((0, 0)),
        );
        let length = l.saturating_add(m.saturating_mul(sign));
        let time = t.saturating_add(u.saturating_mul(sign));
        // An angle times or by a ratio is one, and so is a ratio times an angle.
        let angles = (self == Dimension::Angle, other == Dimension::Angle);
        if (length, time) == (0, 0)
            && matches!((angles, sign), ((true, false), _) | ((false, true), 1))
        {
            return Dimension::Angle;
        }
        Dimension::Marked { length, time }
    }

    /// The dimension of a power with the exponent `numerator`/`denominator`; `None` where a unit would get a broken power.
    pub fn power(self, numerator: i128, denominator: i128) -> Option<Dimension> {
        let Some((length, time)) = self.powers() else {
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
        })
    }

    /// The SI unit that a value of this dimension is given in, for documentation.
    pub fn unit(self) -> String {
        match self {
            Dimension::Number | Dimension::OfTime => "SI units".to_string(),
            Dimension::Angle => "rad".to_string(),
            Dimension::Marked { length: 0, time: 0 } => "1 or rad".to_string(),
            Dimension::Marked { length, time } => {
                let part = |unit: &str, exponent: i32| match exponent {
                    0 => None,
                    1 => Some(unit.to_string()),
                    _ => Some(format!("{unit}^{exponent}")),
                };
                let parts: Vec<String> = [part("m", length), part("s", time)]
                    .into_iter()
                    .flatten()
                    .collect();
                parts.join("*")
            }
        }
    }

    /// How messages name it.
    pub fn name(self) -> String {
        match self {
            Dimension::Number => "a plain number".to_string(),
            Dimension::OfTime => "a product with `t`".to_string(),
            Dimension::Angle => "an angle".to_string(),
            Dimension::Marked { length: 0, time: 0 } => "a plain number or an angle".to_string(),
            Dimension::Marked { length: 1, time: 0 } => "a length".to_string(),
            Dimension::Marked { length: 0, time: 1 } => "a time".to_string(),
            Dimension::Marked {
                length: 0,
                time: -1,
            } => "a frequency".to_string(),
            Dimension::Marked {
                length: 1,
                time: -1,
            } => "a speed".to_string(),
            Dimension::Marked { length: 2, time: 0 } => "an area".to_string(),
            Dimension::Marked { .. } => format!("a quantity in {}", self.unit()),
        }
    }
}

/// The suffixes of the language, for help lines.
pub const UNITS: &[&str] = &[
    "m", "cm", "mm", "um", "km", "inch", "ft", "rad", "mrad", "deg", "turn", "s", "ms", "min",
    "Hz", "rpm",
];

/// A unit: how many SI units it is, exactly, and its dimension.
pub fn unit(suffix: &str, graph: &mut Graph) -> Option<(ExprId, Dimension)> {
    let meters = |numerator, denominator, graph: &mut Graph| {
        (graph.rational(numerator, denominator), Dimension::LENGTH)
    };
    let seconds = Dimension::Marked { length: 0, time: 1 };
    let per_second = Dimension::Marked {
        length: 0,
        time: -1,
    };
    Some(match suffix {
        "m" => meters(1, 1, graph),
        "cm" => meters(1, 100, graph),
        "mm" => meters(1, 1000, graph),
        "um" => meters(1, 1_000_000, graph),
        "km" => meters(1000, 1, graph),
        "inch" => meters(254, 10_000, graph),
        "ft" => meters(3048, 10_000, graph),
        "rad" => (graph.one(), Dimension::Angle),
        "mrad" => (graph.rational(1, 1000), Dimension::Angle),
        "deg" => (fraction_of_pi(1, 180, graph), Dimension::Angle),
        "turn" => (fraction_of_pi(2, 1, graph), Dimension::Angle),
        "s" => (graph.one(), seconds),
        "ms" => (graph.rational(1, 1000), seconds),
        "min" => (graph.integer(60), seconds),
        // A hertz is 1/s as in the SI, so a cycle needs its 2π; a revolution per minute is an angular velocity, 2π/60 rad/s.
        "Hz" => (graph.one(), per_second),
        "rpm" => (fraction_of_pi(1, 30, graph), per_second),
        _ => return None,
    })
}

fn fraction_of_pi(numerator: i64, denominator: i64, graph: &mut Graph) -> ExprId {
    let (fraction, pi) = (graph.rational(numerator, denominator), graph.pi());
    graph.multiply(fraction, pi)
}

#[cfg(test)]
mod tests {
    use super::Dimension::{self, Angle, Marked, Number, OfTime};

    const LENGTH: Dimension = Dimension::LENGTH;
    const RATIO: Dimension = Marked { length: 0, time: 0 };

    #[test]
    fn plain_numbers_leave_the_unit_to_the_other_factor() {
        assert_eq!(Number.times(LENGTH, 1), LENGTH);
        assert_eq!(LENGTH.times(Number, -1), LENGTH);
        assert_eq!(Angle.times(Number, 1), Angle);
        assert_eq!(Number.times(Number, -1), Number);
        let per_length = Marked {
            length: -1,
            time: 0,
        };
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
