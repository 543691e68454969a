//! Units and dimensions: which quantities may be added, and what a suffix multiplies by.
//!
//! A number without a suffix is in SI units of whatever is expected; it fits everything and so does all that is computed from
//! it. Only quantities with units can therefore disagree.

use crate::expr::{ExprId, Graph};
use crate::joint::Quantity;

/// What a value measures, as far as units say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    /// Made of bare numbers: fits any quantity.
    Unmarked,
    /// Powers of metre and second; both zero for angles and ratios.
    Marked {
        /// Power of the metre.
        length: i32,
        /// Power of the second.
        time: i32,
    },
}

impl Dimension {
    /// An angle or a ratio.
    pub const ANGLE: Dimension = Dimension::Marked { length: 0, time: 0 };
    /// A length.
    pub const LENGTH: Dimension = Dimension::Marked { length: 1, time: 0 };

    /// The dimension of a quantity that a joint asks for.
    pub fn of(quantity: Quantity) -> Dimension {
        match quantity {
            Quantity::Length => Dimension::LENGTH,
            Quantity::Angle => Dimension::ANGLE,
        }
    }

    /// Whether a value of this dimension can stand where `other` is expected.
    pub fn fits(self, other: Dimension) -> bool {
        self == Dimension::Unmarked || other == Dimension::Unmarked || self == other
    }

    /// The dimension of a sum whose terms fit one another.
    pub fn joined(self, other: Dimension) -> Dimension {
        if self == Dimension::Unmarked {
            other
        } else {
            self
        }
    }

    /// The dimension of a product, or of a quotient with `sign` −1.
    pub fn times(self, other: Dimension, sign: i32) -> Dimension {
        match (self, other) {
            (
                Dimension::Marked { length: l, time: t },
                Dimension::Marked { length: m, time: u },
            ) => Dimension::Marked {
                length: l.saturating_add(m.saturating_mul(sign)),
                time: t.saturating_add(u.saturating_mul(sign)),
            },
            _ => Dimension::Unmarked,
        }
    }

    /// The dimension of a power with the exponent `numerator`/`denominator`; `None` where a unit would get a broken power.
    pub fn power(self, numerator: i128, denominator: i128) -> Option<Dimension> {
        let Dimension::Marked { length, time } = self else {
            return Some(Dimension::Unmarked);
        };
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

    /// How messages name it.
    pub fn name(self) -> String {
        match self {
            Dimension::Unmarked => "a bare number".to_string(),
            Dimension::Marked { length: 0, time: 0 } => "an angle".to_string(),
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
            Dimension::Marked { length, time } => {
                let part = |unit: &str, exponent: i32| match exponent {
                    0 => String::new(),
                    1 => unit.to_string(),
                    _ => format!("{unit}^{exponent}"),
                };
                let parts = [part("m", length), part("s", time)];
                let shown: Vec<_> = parts
                    .iter()
                    .filter(|part| !part.is_empty())
                    .map(String::as_str)
                    .collect();
                format!("a quantity in {}", shown.join("*"))
            }
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
    let metres = |numerator, denominator, graph: &mut Graph| {
        (graph.rational(numerator, denominator), Dimension::LENGTH)
    };
    let seconds = Dimension::Marked { length: 0, time: 1 };
    let per_second = Dimension::Marked {
        length: 0,
        time: -1,
    };
    Some(match suffix {
        "m" => metres(1, 1, graph),
        "cm" => metres(1, 100, graph),
        "mm" => metres(1, 1000, graph),
        "um" => metres(1, 1_000_000, graph),
        "km" => metres(1000, 1, graph),
        "inch" => metres(254, 10_000, graph),
        "ft" => metres(3048, 10_000, graph),
        "rad" => (graph.one(), Dimension::ANGLE),
        "mrad" => (graph.rational(1, 1000), Dimension::ANGLE),
        "deg" => (fraction_of_pi(1, 180, graph), Dimension::ANGLE),
        "turn" => (fraction_of_pi(2, 1, graph), Dimension::ANGLE),
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
