//! Computes exactly with rationals times square roots, and with floats otherwise.
//!
//! A result without an exact representation becomes the nearest computed float: no operation wraps or panics.

use super::radical::{exact_root, extract_squares};
use super::rational::{Decimal, Rational, greatest_common_divisor};
use linkwright_math::double;
use std::hash::{Hash, Hasher};

/// A real number: a rational times a square root, or a float if that does not fit.
#[derive(Clone, Copy, Debug)]
pub enum Number {
    /// `rational · √radicand`. The radicand is at least 1. Squares of primes up to 1000 are removed, and so is the rest if it
    /// is a perfect square. Zero has the radicand 1.
    Exact {
        /// Rational factor, which has the sign.
        rational: Rational,
        /// Radicand of the square root.
        radicand: u128,
    },
    /// Float for values without an exact representation, such as `1e-300`, and for infinities and NaN.
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

    /// Returns a whole number.
    pub const fn integer(value: i64) -> Number {
        Number::rational(Rational::integer(value))
    }

    /// Returns a rational number.
    pub const fn rational(rational: Rational) -> Number {
        Number::Exact {
            rational,
            radicand: 1,
        }
    }

    /// Returns `rational · √radicand`, with squares removed from the radicand.
    pub fn surd(rational: Rational, radicand: u128) -> Number {
        let (root, rest) = extract_squares(radicand);
        if rational.is_zero() || rest == 0 {
            return Number::ZERO;
        }
        let scaled = i128::try_from(root)
            .ok()
            .and_then(|root| rational.checked_mul(Rational::new(root, 1)?));
        match scaled {
            Some(rational) => Number::Exact {
                rational,
                radicand: rest,
            },
            None => Number::float(rational.to_f64() * (radicand as f64).sqrt()),
        }
    }

    /// Returns a float; a zero of either sign becomes the exact zero, and every NaN the same NaN.
    pub fn float(value: f64) -> Number {
        if value == 0.0 {
            Number::ZERO
        } else if value.is_nan() {
            Number::Float(f64::NAN)
        } else {
            Number::Float(value)
        }
    }

    /// Parses decimal text: exact if a `Rational` can represent the value, otherwise the nearest float, zero below and infinite
    /// above the range of floats. `None` if the text is not a decimal number.
    pub fn parse(text: &str) -> Option<Number> {
        let decimal = Decimal::read(text)?;
        match Rational::parse(text) {
            Some(rational) => Some(Number::rational(rational)),
            None => decimal.plain.parse().ok().map(Number::float),
        }
    }

    /// Returns the sum; `None` unless the radicands are equal, or one operand is a zero or a float.
    pub fn add(&self, other: Number) -> Option<Number> {
        match (*self, other) {
            (
                Number::Exact {
                    rational: a,
                    radicand: p,
                },
                Number::Exact {
                    rational: b,
                    radicand: q,
                },
            ) => {
                if a.is_zero() {
                    return Some(other);
                }
                if b.is_zero() {
                    return Some(*self);
                }
                if p != q {
                    return None;
                }
                Some(match a.checked_add(b) {
                    Some(rational) if rational.is_zero() => Number::ZERO,
                    Some(rational) => Number::Exact {
                        rational,
                        radicand: p,
                    },
                    None => Number::float(self.to_f64() + other.to_f64()),
                })
            }
            _ => Some(Number::float(self.to_f64() + other.to_f64())),
        }
    }

    /// Returns the product.
    pub fn mul(&self, other: Number) -> Number {
        let exact = match (*self, other) {
            (
                Number::Exact {
                    rational: a,
                    radicand: p,
                },
                Number::Exact {
                    rational: b,
                    radicand: q,
                },
            ) => multiply_surds((a, p), (b, q)),
            _ => None,
        };
        exact.unwrap_or_else(|| Number::float(self.to_f64() * other.to_f64()))
    }

    /// True if the number is exact and rational.
    pub fn is_rational(&self) -> bool {
        matches!(self, Number::Exact { radicand: 1, .. })
    }

    /// Returns the negated number.
    pub fn neg(&self) -> Number {
        match *self {
            Number::Exact { rational, radicand } => Number::Exact {
                rational: -rational,
                radicand,
            },
            Number::Float(value) => Number::float(-value),
        }
    }

    /// Returns the magnitude.
    pub fn absolute(&self) -> Number {
        if self.is_negative() {
            self.neg()
        } else {
            *self
        }
    }

    /// Returns the reciprocal; infinity for zero.
    pub fn recip(&self) -> Number {
        let exact = match *self {
            Number::Exact { rational, radicand } => i128::try_from(radicand)
                .ok()
                .and_then(|below| rational.reciprocal()?.checked_mul(Rational::new(1, below)?))
                .map(|rational| Number::Exact { rational, radicand }),
            Number::Float(_) => None,
        };
        exact.unwrap_or_else(|| Number::float(1.0 / self.to_f64()))
    }

    /// Returns the power: exact if it is a rational times a square root, otherwise a float. A negative number to a non-integer
    /// power gives NaN, and zero to a negative power infinity; `x^0` is 1.
    pub fn pow(&self, exponent: Rational) -> Number {
        self.exact_pow(exponent)
            .unwrap_or_else(|| Number::float(float_power(self.to_f64(), exponent)))
    }

    /// Returns the power; `None` if it is not exact.
    pub fn exact_pow(&self, exponent: Rational) -> Option<Number> {
        let Number::Exact { rational, radicand } = *self else {
            return None;
        };
        if exponent.is_zero() {
            return Some(Number::ONE);
        }
        if rational.is_zero() {
            return (!exponent.is_negative()).then_some(Number::ZERO);
        }
        if exponent.is_integer() {
            return integer_power(rational, radicand, exponent.numerator());
        }
        if rational.is_negative() {
            return None;
        }
        // x = r√d = √(r²d), hence x^(p/n) is the p-th power of √((r²d)^(1/n)), which is exact if that n-th root is rational.
        // For a rational x and an even n, half of the root is already under the square root.
        let order = exponent.denominator();
        let (under, order) = if radicand == 1 && order % 2 == 0 {
            (rational, order / 2)
        } else {
            let radicand = Rational::new(i128::try_from(radicand).ok()?, 1)?;
            let square = rational.checked_mul(rational)?;
            (square.checked_mul(radicand)?, order)
        };
        let above = exact_root(under.numerator().unsigned_abs(), order)?;
        let below = exact_root(under.denominator().unsigned_abs(), order)?;
        let (above_root, above_rest) = extract_squares(above);
        let (below_root, below_rest) = extract_squares(below);
        // √(a/b) = √(ab)/b; the reduced radicands are coprime, so their product is free of squares.
        let scale = Rational::new(
            i128::try_from(above_root).ok()?,
            i128::try_from(below_root.checked_mul(below_rest)?).ok()?,
        )?;
        integer_power(
            scale,
            above_rest.checked_mul(below_rest)?,
            exponent.numerator(),
        )
    }

    /// Returns the value as a float: correctly rounded for a rational, within two units in the last place for a square root.
    pub fn to_f64(&self) -> f64 {
        match *self {
            Number::Exact {
                rational,
                radicand: 1,
            } => rational.to_f64(),
            Number::Exact { rational, radicand } => rational.to_f64() * (radicand as f64).sqrt(),
            Number::Float(value) => value,
        }
    }

    /// True if the number is 0.
    pub fn is_zero(&self) -> bool {
        match *self {
            Number::Exact { rational, .. } => rational.is_zero(),
            Number::Float(value) => value == 0.0,
        }
    }

    /// True if the number is 1.
    pub fn is_one(&self) -> bool {
        match *self {
            Number::Exact { rational, radicand } => radicand == 1 && rational == Rational::ONE,
            Number::Float(value) => value == 1.0,
        }
    }

    /// True if the number is less than 0.
    pub fn is_negative(&self) -> bool {
        match *self {
            Number::Exact { rational, .. } => rational.is_negative(),
            Number::Float(value) => value < 0.0,
        }
    }

    /// True if the number is neither infinite nor NaN.
    pub fn is_finite(&self) -> bool {
        match *self {
            Number::Exact { .. } => true,
            Number::Float(value) => value.is_finite(),
        }
    }
}

/// Returns the power of a float: by repeated squaring for an integer exponent, otherwise by the library; NaN for a negative
/// base.
pub(super) fn float_power(base: f64, exponent: Rational) -> f64 {
    if !exponent.is_integer() {
        return double::powf(base, exponent.to_f64());
    }
    let mut remaining = exponent.numerator().unsigned_abs();
    let (mut square, mut power) = (base, 1.0);
    while remaining > 0 {
        if remaining % 2 == 1 {
            power *= square;
        }
        square *= square;
        remaining /= 2;
    }
    if exponent.is_negative() {
        1.0 / power
    } else {
        power
    }
}

fn multiply_surds(left: (Rational, u128), right: (Rational, u128)) -> Option<Number> {
    let rational = left.0.checked_mul(right.0)?;
    if rational.is_zero() {
        return Some(Number::ZERO);
    }
    if left.1 == 1 || right.1 == 1 {
        return Some(Number::Exact {
            rational,
            radicand: left.1.max(right.1),
        });
    }
    // √p·√q = g·√((p/g)(q/g)) with the greatest common divisor g. Neither factor contains a removable square, and a square of
    // both would divide g.
    let shared = greatest_common_divisor(left.1, right.1);
    let rational = rational.checked_mul(Rational::new(i128::try_from(shared).ok()?, 1)?)?;
    let radicand = (left.1 / shared).checked_mul(right.1 / shared)?;
    Some(Number::Exact { rational, radicand })
}

fn integer_power(rational: Rational, radicand: u128, exponent: i128) -> Option<Number> {
    let power = rational.checked_pow(exponent)?;
    if radicand == 1 {
        return Some(Number::rational(power));
    }
    let under = Rational::new(i128::try_from(radicand).ok()?, 1)?;
    let scale = power.checked_mul(under.checked_pow(exponent.div_euclid(2))?)?;
    Some(Number::Exact {
        rational: scale,
        radicand: if exponent % 2 == 0 { 1 } else { radicand },
    })
}
