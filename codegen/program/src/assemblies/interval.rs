//! Computes with intervals.
//!
//! IEEE 754 rounds every operation to the nearest number, so the next number outwards is a bound. Results that are not defined on
//! the whole interval are marked; the bounds then hold on the domain of definition (Moore, Kearfott and Cloud, Introduction to
//! Interval Analysis, 2009).

/// Relative error of a computed exponential or logarithm, or of a constant that is not a ratio of small integers.
pub const ROUNDED: f64 = 4.0 * f64::EPSILON;

/// Closed interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Lower bound.
    pub low: f64,
    /// Upper bound.
    pub high: f64,
    /// True if the value is defined on the whole interval.
    pub defined: bool,
}

impl Interval {
    /// Returns the interval of one number.
    pub fn point(value: f64) -> Interval {
        Interval::new(value, value)
    }

    /// Returns the interval between two numbers.
    pub fn new(low: f64, high: f64) -> Interval {
        Interval {
            low,
            high,
            defined: true,
        }
    }

    /// Returns the interval of all numbers, for a value that is not defined everywhere.
    pub fn undefined() -> Interval {
        Interval {
            low: f64::NEG_INFINITY,
            high: f64::INFINITY,
            defined: false,
        }
    }

    /// Interval without numbers: a value that is defined nowhere.
    pub const EMPTY: Interval = Interval {
        low: f64::INFINITY,
        high: f64::NEG_INFINITY,
        defined: false,
    };

    /// Returns the interval of a number that is known to a few roundings.
    pub fn about(value: f64) -> Interval {
        let off = ROUNDED * value.abs();
        Interval::outward(value - off, value + off, true)
    }

    /// True if the interval has no number.
    pub fn is_empty(&self) -> bool {
        self.low > self.high
    }

    /// Moves bounds that were rounded to nearest outwards.
    pub(super) fn outward(low: f64, high: f64, defined: bool) -> Interval {
        match low.is_nan() || high.is_nan() {
            true => Interval::undefined(),
            false => Interval {
                low: low.next_down(),
                high: high.next_up(),
                defined,
            },
        }
    }

    /// True if a number lies in the interval.
    pub fn holds(&self, value: f64) -> bool {
        self.low <= value && value <= self.high
    }

    /// Returns a number near the middle.
    pub fn middle(&self) -> f64 {
        self.low + 0.5 * (self.high - self.low)
    }

    /// True if the interval lies in the interior of another one.
    pub fn is_inside(self, other: Interval) -> bool {
        other.low < self.low && self.high < other.high
    }

    /// Returns the intersection.
    #[must_use]
    pub fn intersection(self, other: Interval) -> Interval {
        let (low, high) = (self.low.max(other.low), self.high.min(other.high));
        let defined = self.defined && other.defined;
        match low <= high {
            true => Interval { low, high, defined },
            false => Interval::EMPTY,
        }
    }

    /// Returns the smallest interval that contains both.
    #[must_use]
    pub fn hull(self, other: Interval) -> Interval {
        Interval {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            defined: self.defined && other.defined,
        }
    }

    /// Returns the magnitudes of all numbers in the interval.
    pub fn magnitude(self) -> Interval {
        match (self.low >= 0.0, self.high <= 0.0) {
            (true, _) => self,
            (_, true) => self.negated(),
            _ => Interval {
                low: 0.0,
                high: self.high.max(-self.low),
                ..self
            },
        }
    }

    /// Returns the interval with opposite sign.
    #[must_use]
    pub fn negated(self) -> Interval {
        Interval {
            low: -self.high,
            high: -self.low,
            defined: self.defined,
        }
    }

    /// Returns the difference.
    #[must_use]
    pub fn minus(self, other: Interval) -> Interval {
        self.plus(other.negated())
    }

    /// Returns the sum.
    #[must_use]
    pub fn plus(self, other: Interval) -> Interval {
        if self.is_empty() || other.is_empty() {
            return Interval::EMPTY;
        }
        let defined = self.defined && other.defined;
        Interval::outward(self.low + other.low, self.high + other.high, defined)
    }

    /// Returns the product.
    #[must_use]
    pub fn times(self, other: Interval) -> Interval {
        if self.is_empty() || other.is_empty() {
            return Interval::EMPTY;
        }
        let products = [
            self.low * other.low,
            self.low * other.high,
            self.high * other.low,
            self.high * other.high,
        ];
        let defined = self.defined && other.defined;
        if products.iter().any(|it| it.is_nan()) {
            return Interval::undefined();
        }
        let low = products.into_iter().fold(f64::INFINITY, f64::min);
        let high = products.into_iter().fold(f64::NEG_INFINITY, f64::max);
        Interval::outward(low, high, defined)
    }

    /// Returns the reciprocal.
    #[must_use]
    pub fn reciprocal(self) -> Interval {
        match self.holds(0.0) {
            _ if self.is_empty() => Interval::EMPTY,
            true => Interval::undefined(),
            false => Interval::outward(1.0 / self.high, 1.0 / self.low, self.defined),
        }
    }

    /// Returns the square root, of the nonnegative part.
    #[must_use]
    pub fn root(self) -> Interval {
        if self.is_empty() || self.high < 0.0 {
            return Interval::EMPTY;
        }
        let (low, high) = (self.low.max(0.0), self.high);
        Interval {
            low: low.sqrt().next_down().max(0.0),
            high: high.sqrt().next_up(),
            defined: self.defined && self.low > 0.0,
        }
    }

    /// Returns an integer power.
    #[must_use]
    pub fn power(self, exponent: u32) -> Interval {
        if self.is_empty() {
            return self;
        }
        if exponent.is_multiple_of(2) && self.holds(0.0) {
            let largest = self.low.abs().max(self.high.abs());
            let mut high = Interval::point(1.0);
            for _ in 0..exponent {
                high = high.times(Interval::point(largest));
            }
            return Interval {
                low: 0.0,
                high: high.high,
                defined: self.defined,
            };
        }
        // A power is monotonic on one side of zero.
        let end = |value: f64| {
            (0..exponent).fold(Interval::point(1.0), |product, _| {
                product.times(Interval::point(value))
            })
        };
        let (low, high) = (end(self.low), end(self.high));
        Interval {
            low: low.low.min(high.low),
            high: low.high.max(high.high),
            defined: self.defined,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn partly_undefined_results_are_marked() {
        assert!(!Interval::new(-1.0, 1.0).reciprocal().defined);
        assert!(!Interval::new(-1.0, 1.0).root().defined);
        assert!(Interval::new(0.5, 1.0).root().defined);
        let square = Interval::new(-2.0, 1.0).power(2);
        assert!(square.low == 0.0 && square.holds(4.0) && !square.holds(4.1));
        assert!(Interval::new(-2.0, -1.0).power(3).holds(-8.0));
    }

    /// Checks that rounding moves outwards: 0.1 is not a machine number, nor is three times its value 0.3.
    #[test]
    fn rounding_leads_outwards() {
        let tenth = Interval::point(0.1);
        let sum = tenth.plus(tenth).plus(tenth);
        assert!(sum.holds(0.3) && sum.low < sum.high);
        assert!(tenth.times(tenth).holds(0.01));
    }
}
