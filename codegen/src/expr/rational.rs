//! Exact fractions: *two integers, or decimal text* → *the reduced fraction*.
//!
//! Always reduced, the denominator positive, both within ±(2^127 - 1), so that a change of sign cannot overflow. Arithmetic
//! that leaves this range answers `None`; what then happens is not decided here.

/// An exact fraction of two 128-bit integers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Rational {
    numerator: i128,
    denominator: i128,
}

impl Rational {
    /// The number 0.
    pub const ZERO: Rational = Rational::integer(0);
    /// The number 1.
    pub const ONE: Rational = Rational::integer(1);
    /// The number 1/2.
    pub const HALF: Rational = Rational {
        numerator: 1,
        denominator: 2,
    };

    /// A whole number.
    pub const fn integer(value: i64) -> Rational {
        Rational {
            numerator: value as i128,
            denominator: 1,
        }
    }
    /// `numerator / denominator`, reduced. `None` for a zero denominator or where the result does not fit.
    pub fn new(numerator: i128, denominator: i128) -> Option<Rational> {
        let _ = (numerator, denominator);
        unimplemented!()
    }
    /// The numerator; it carries the sign.
    pub fn numerator(self) -> i128 {
        self.numerator
    }
    /// The denominator, always positive.
    pub fn denominator(self) -> i128 {
        self.denominator
    }
    /// The exact value of decimal text such as `12`, `0.05`, `1e-20` or `1_000.5`, with an optional sign. `None` for other
    /// text and for values that do not fit.
    pub fn parse(text: &str) -> Option<Rational> {
        let _ = text;
        unimplemented!()
    }
    /// The sum, or `None` where it does not fit.
    pub fn checked_add(self, other: Rational) -> Option<Rational> {
        let _ = other;
        unimplemented!()
    }
    /// The difference, or `None` where it does not fit.
    pub fn checked_sub(self, other: Rational) -> Option<Rational> {
        let _ = other;
        unimplemented!()
    }
    /// The product, or `None` where it does not fit.
    pub fn checked_mul(self, other: Rational) -> Option<Rational> {
        let _ = other;
        unimplemented!()
    }
    /// The quotient, or `None` where it does not fit or the divisor is zero.
    pub fn checked_div(self, other: Rational) -> Option<Rational> {
        let _ = other;
        unimplemented!()
    }
    /// An integer power, or `None` where it does not fit or zero is raised to a negative power.
    pub fn checked_pow(self, exponent: i128) -> Option<Rational> {
        let _ = exponent;
        unimplemented!()
    }
    /// The nearest `f64`, ties to even.
    pub fn to_f64(self) -> f64 {
        unimplemented!()
    }
    /// Whether this is 0.
    pub fn is_zero(self) -> bool {
        self.numerator == 0
    }
    /// Whether this is below 0.
    pub fn is_negative(self) -> bool {
        self.numerator < 0
    }
    /// Whether the denominator is 1.
    pub fn is_integer(self) -> bool {
        self.denominator == 1
    }
}
