//! Represents exact fractions of two integers.
//!
//! A fraction is reduced, with a positive denominator. Both parts are within ±(2^127 - 1), so that a change of sign cannot
//! overflow. Arithmetic outside this range returns `None`.

use std::cmp::Ordering;
use std::ops::Neg;

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

    /// Returns a whole number.
    pub const fn integer(value: i64) -> Rational {
        Rational {
            numerator: value as i128,
            denominator: 1,
        }
    }

    /// Returns `numerator / denominator`, reduced; `None` for a zero denominator or if the result does not fit.
    pub fn new(numerator: i128, denominator: i128) -> Option<Rational> {
        let (above, below) = (numerator.unsigned_abs(), denominator.unsigned_abs());
        if below == 0 {
            return None;
        }
        let divisor = greatest_common_divisor(above, below);
        Rational::from_parts(
            (numerator < 0) != (denominator < 0),
            above / divisor,
            below / divisor,
        )
    }

    /// Returns the fraction of two coprime magnitudes.
    fn from_parts(negative: bool, above: u128, below: u128) -> Option<Rational> {
        let magnitude = i128::try_from(above).ok()?;
        Some(Rational {
            numerator: if negative { -magnitude } else { magnitude },
            denominator: i128::try_from(below).ok()?,
        })
    }

    /// Returns the numerator, which has the sign.
    pub const fn numerator(self) -> i128 {
        self.numerator
    }

    /// Returns the denominator; always positive.
    pub const fn denominator(self) -> i128 {
        self.denominator
    }

    /// Parses decimal text such as `12`, `0.05`, `1e-20` or `1_000.5`, with an optional sign, exactly. `None` for other text
    /// and for values that do not fit.
    pub fn parse(text: &str) -> Option<Rational> {
        let decimal = Decimal::read(text)?;
        let digits = decimal.digits.trim_start_matches('0');
        let significant = digits.trim_end_matches('0');
        if significant.is_empty() {
            return Some(Rational::ZERO);
        }
        let trimmed = i64::try_from(digits.len() - significant.len()).ok()?;
        let exponent = decimal.exponent?.checked_add(trimmed)?;
        let magnitude = Rational::new(significant.parse().ok()?, 1)?;
        let power = Rational::integer(10).checked_pow(i128::from(exponent))?;
        let value = magnitude.checked_mul(power)?;
        Some(if decimal.negative { -value } else { value })
    }

    /// Returns the sum; `None` if it does not fit.
    pub fn checked_add(self, other: Rational) -> Option<Rational> {
        if self.denominator == 1 && other.denominator == 1 {
            return Rational::from_integer(self.numerator.checked_add(other.numerator)?);
        }
        let (a, b) = (
            self.denominator.unsigned_abs(),
            other.denominator.unsigned_abs(),
        );
        let shared = greatest_common_divisor(a, b);
        let (widen_self, widen_other) = (
            i128::try_from(b / shared).ok()?,
            i128::try_from(a / shared).ok()?,
        );
        Rational::new(
            self.numerator
                .checked_mul(widen_self)?
                .checked_add(other.numerator.checked_mul(widen_other)?)?,
            self.denominator.checked_mul(widen_self)?,
        )
    }

    /// Returns the difference; `None` if it does not fit.
    pub fn checked_sub(self, other: Rational) -> Option<Rational> {
        self.checked_add(-other)
    }

    /// Returns the product; `None` if it does not fit.
    pub fn checked_mul(self, other: Rational) -> Option<Rational> {
        if self.denominator == 1 && other.denominator == 1 {
            return Rational::from_integer(self.numerator.checked_mul(other.numerator)?);
        }
        // Cross-reduced first, so that only a result that does not fit overflows.
        let (a, b) = (
            self.numerator.unsigned_abs(),
            self.denominator.unsigned_abs(),
        );
        let (c, d) = (
            other.numerator.unsigned_abs(),
            other.denominator.unsigned_abs(),
        );
        let (first, second) = (greatest_common_divisor(a, d), greatest_common_divisor(c, b));
        Rational::from_parts(
            (self.numerator < 0) != (other.numerator < 0),
            (a / first).checked_mul(c / second)?,
            (b / second).checked_mul(d / first)?,
        )
    }

    /// Returns the quotient; `None` if it does not fit or the divisor is zero.
    pub fn checked_div(self, other: Rational) -> Option<Rational> {
        self.checked_mul(other.reciprocal()?)
    }

    /// Returns an integer power; `None` if it does not fit, or for zero to a negative power.
    pub fn checked_pow(self, exponent: i128) -> Option<Rational> {
        let mut square = if exponent < 0 {
            self.reciprocal()?
        } else {
            self
        };
        let mut remaining = exponent.unsigned_abs();
        if square.is_zero() || square == Rational::ONE || square == -Rational::ONE {
            // Only these bases have large powers that fit; the parity determines them.
            return Some(match (remaining, remaining % 2) {
                (0, _) => Rational::ONE,
                (_, 1) => square,
                _ => square.absolute(),
            });
        }
        let mut power = Rational::ONE;
        while remaining > 0 {
            if remaining % 2 == 1 {
                power = power.checked_mul(square)?;
            }
            remaining /= 2;
            if remaining > 0 {
                square = square.checked_mul(square)?;
            }
        }
        Some(power)
    }

    /// Returns the reciprocal; `None` for zero.
    pub fn reciprocal(self) -> Option<Rational> {
        match self.numerator.cmp(&0) {
            Ordering::Equal => None,
            Ordering::Greater => Some(Rational {
                numerator: self.denominator,
                denominator: self.numerator,
            }),
            Ordering::Less => Some(Rational {
                numerator: -self.denominator,
                denominator: -self.numerator,
            }),
        }
    }

    /// Returns the magnitude.
    pub fn absolute(self) -> Rational {
        if self.is_negative() { -self } else { self }
    }

    /// Returns the nearest `f64`, ties to even.
    pub fn to_f64(self) -> f64 {
        const EXACT_LIMIT: u128 = 1 << f64::MANTISSA_DIGITS;
        let (above, below) = (
            self.numerator.unsigned_abs(),
            self.denominator.unsigned_abs(),
        );
        if above <= EXACT_LIMIT && below <= EXACT_LIMIT {
            // Both conversions are exact, and the division rounds once.
            return self.numerator as f64 / self.denominator as f64;
        }
        // Long division until the quotient has 64 bits, the last of which is sticky for the remainder. The cast then rounds
        // once. The scale is a power of two between 2^-191 and 1, so the product is exact.
        let (mut quotient, mut remainder) = (above / below, above % below);
        let mut shift = 0u64;
        while quotient < 1 << 63 {
            remainder <<= 1;
            quotient <<= 1;
            if remainder >= below {
                remainder -= below;
                quotient |= 1;
            }
            shift += 1;
        }
        if remainder != 0 {
            quotient |= 1;
        }
        let scale = f64::from_bits((1023 - shift) << (f64::MANTISSA_DIGITS - 1));
        let magnitude = quotient as f64 * scale;
        if self.numerator < 0 {
            -magnitude
        } else {
            magnitude
        }
    }

    /// True if the fraction is 0.
    pub const fn is_zero(self) -> bool {
        self.numerator == 0
    }

    /// True if the fraction is less than 0.
    pub const fn is_negative(self) -> bool {
        self.numerator < 0
    }

    /// True if the denominator is 1.
    pub const fn is_integer(self) -> bool {
        self.denominator == 1
    }

    /// Returns a whole number; `None` if it does not fit.
    fn from_integer(value: i128) -> Option<Rational> {
        (value != i128::MIN).then_some(Rational {
            numerator: value,
            denominator: 1,
        })
    }
}

impl Neg for Rational {
    type Output = Rational;

    fn neg(self) -> Rational {
        Rational {
            numerator: -self.numerator,
            denominator: self.denominator,
        }
    }
}

impl Ord for Rational {
    /// Compares whole parts, then the reciprocals of the remainders: Euclid's algorithm, which cannot overflow.
    fn cmp(&self, other: &Rational) -> Ordering {
        let (mut a, mut b) = (self.numerator, self.denominator);
        let (mut c, mut d) = (other.numerator, other.denominator);
        let mut reversed = false;
        loop {
            let (left, right) = (a.div_euclid(b), c.div_euclid(d));
            let (rest_left, rest_right) = (a.rem_euclid(b), c.rem_euclid(d));
            let order = match left.cmp(&right) {
                Ordering::Equal if rest_left == 0 || rest_right == 0 => rest_left.cmp(&rest_right),
                Ordering::Equal => {
                    (a, b, c, d) = (b, rest_left, d, rest_right);
                    reversed = !reversed;
                    continue;
                }
                decided => decided,
            };
            return if reversed { order.reverse() } else { order };
        }
    }
}

impl PartialOrd for Rational {
    fn partial_cmp(&self, other: &Rational) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Returns the greatest common divisor, 0 for 0 and 0. The 64-bit loop is several times faster than the 128-bit one.
pub(super) fn greatest_common_divisor(a: u128, b: u128) -> u128 {
    let (mut a, mut b) = (a, b);
    while b != 0 {
        if let (Ok(mut short_a), Ok(mut short_b)) = (u64::try_from(a), u64::try_from(b)) {
            while short_b != 0 {
                (short_a, short_b) = (short_b, short_a % short_b);
            }
            return u128::from(short_a);
        }
        (a, b) = (b, a % b);
    }
    a
}

/// Parts of decimal text: `± digits · 10 ^ exponent`.
pub(super) struct Decimal {
    negative: bool,
    digits: String,
    /// Written exponent; `None` if it does not fit 64 bits.
    exponent: Option<i64>,
    /// Text without underscores.
    pub(super) plain: String,
}

impl Decimal {
    /// Returns the parts; `None` if the text is not a decimal number.
    pub(super) fn read(text: &str) -> Option<Decimal> {
        let plain: String = text.chars().filter(|&c| c != '_').collect();
        let unsigned = text.strip_prefix(['-', '+']).unwrap_or(text);
        if !unsigned.starts_with(|c: char| c.is_ascii_digit() || c == '.') {
            return None;
        }
        let negative = plain.starts_with('-');
        let body = plain.strip_prefix(['-', '+']).unwrap_or(&plain);
        let (mantissa, exponent) = match body.split_once(['e', 'E']) {
            Some((mantissa, exponent)) => (mantissa, Some(exponent)),
            None => (body, None),
        };
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let all_digits = |part: &str| part.bytes().all(|byte| byte.is_ascii_digit());
        if whole.len() + fraction.len() == 0 || !all_digits(whole) || !all_digits(fraction) {
            return None;
        }
        if let Some(written) = exponent {
            let magnitude = written.strip_prefix(['-', '+']).unwrap_or(written);
            if magnitude.is_empty() || !all_digits(magnitude) {
                return None;
            }
        }
        let written: Option<i64> = exponent.map_or(Some(0), |written| written.parse().ok());
        let places = i64::try_from(fraction.len()).ok()?;
        Some(Decimal {
            negative,
            digits: format!("{whole}{fraction}"),
            exponent: written.and_then(|written| written.checked_sub(places)),
            plain,
        })
    }
}
