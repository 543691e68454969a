//! Coefficients: *exact arithmetic while it fits* → *a rational times a square root, or a float*.

use super::rational::Rational;
use std::hash::{Hash, Hasher};

/// A real number: exact as a rational times a square root, or a float where that does not fit.
#[derive(Clone, Copy, Debug)]
pub enum Number {
    /// `rational · √radicand`. The radicand is at least 1 and free of squares as far as they are found.
    Exact {
        /// The rational factor; it carries the sign.
        rational: Rational,
        /// The number under the root.
        radicand: u128,
    },
    /// The fallback for what exact arithmetic cannot hold, such as `1e-300`; also infinities and NaN.
    Float(f64),
}

impl PartialEq for Number {
    fn eq(&self, other: &Number) -> bool {
        match (self, other) {
            (
                Number::Exact {
                    rational: a,
                    radicand: p,
                },
                Number::Exact {
                    rational: b,
                    radicand: q,
                },
            ) => a == b && p == q,
            (Number::Float(a), Number::Float(b)) => a.to_bits() == b.to_bits(),
            _ => false,
        }
    }
}

impl Eq for Number {}

impl Hash for Number {
    fn hash<H: Hasher>(&self, state: &mut H) {
        match self {
            Number::Exact { rational, radicand } => {
                rational.hash(state);
                radicand.hash(state);
            }
            Number::Float(value) => value.to_bits().hash(state),
        }
    }
}

impl Number {
    /// The number 0.
    pub const ZERO: Number = Number::integer(0);
    /// The number 1.
    pub const ONE: Number = Number::integer(1);

    /// A whole number.
    pub const fn integer(value: i64) -> Number {
        Number::Exact {
            rational: Rational::integer(value),
            radicand: 1,
        }
    }
    /// A rational number.
    pub const fn rational(rational: Rational) -> Number {
        Number::Exact {
            rational,
            radicand: 1,
        }
    }
    /// A float; a zero of either sign becomes the exact zero and every NaN the same NaN.
    pub fn float(value: f64) -> Number {
        Number::Float(value)
    }
    /// The value of decimal text: exact where a [`Rational`] holds it, otherwise the nearest float. `None` for text that is
    /// not a decimal number.
    pub fn parse(text: &str) -> Option<Number> {
        let _ = text;
        unimplemented!()
    }
    /// The sum, where it is a single number: for equal radicands, and wherever a zero or a float takes part.
    pub fn add(&self, other: Number) -> Option<Number> {
        let _ = other;
        unimplemented!()
    }
    /// The product.
    pub fn mul(&self, other: Number) -> Number {
        let _ = other;
        unimplemented!()
    }
    /// The negated number.
    pub fn neg(&self) -> Number {
        unimplemented!()
    }
    /// The reciprocal; that of zero is the float infinity.
    pub fn recip(&self) -> Number {
        unimplemented!()
    }
    /// The power, exact where the result is a rational times a square root, otherwise a float. A negative number to a power
    /// that is not an integer gives NaN, zero to a negative power infinity.
    pub fn pow(&self, exponent: Rational) -> Number {
        let _ = exponent;
        unimplemented!()
    }
    /// The value as a float.
    pub fn to_f64(&self) -> f64 {
        unimplemented!()
    }
    /// Whether this is 0.
    pub fn is_zero(&self) -> bool {
        unimplemented!()
    }
    /// Whether this is 1.
    pub fn is_one(&self) -> bool {
        unimplemented!()
    }
    /// Whether this is below 0.
    pub fn is_negative(&self) -> bool {
        unimplemented!()
    }
    /// Whether this is neither infinite nor NaN.
    pub fn is_finite(&self) -> bool {
        unimplemented!()
    }
}
