//! *Numbers that are known to lie between two bounds* → *bounds of what is computed with them*.
//!
//! Every operation of IEEE 754 is rounded to the nearest number, so the next number outwards bounds it. Sines and cosines of the
//! elementary functions that are used here are within [`SINE`] of the exact ones, which is added. Whatever is not defined on the whole
//! of an interval is marked: then the bounds hold where it is defined (Moore, Kearfott and Cloud, Introduction to Interval Analysis,
//! 2009). The module does not know expressions.

use std::f64::consts::{FRAC_PI_2, TAU};

use linkwright_math::double;

/// By how much a computed sine or cosine may be off.
pub const SINE: f64 = 4.0 * f64::EPSILON;

/// By how much a computed angle of a vector may be off, in rad: it is at most half a turn.
pub const ANGLE: f64 = 8.0 * f64::EPSILON;

/// By which part of itself a computed exponential or logarithm, or a constant that is no ratio of small numbers, may be off.
pub const ROUNDED: f64 = 4.0 * f64::EPSILON;

/// By how much of an angle its place among the quarter turns may be off: more than rounding of angles of some turns leaves.
const PLACE: f64 = 1e-9;

/// All numbers from one to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The least.
    pub low: f64,
    /// The greatest.
    pub high: f64,
    /// Whether what was computed is defined everywhere.
    pub defined: bool,
}

impl Interval {
    /// One number.
    pub fn point(value: f64) -> Interval {
        Interval::new(value, value)
    }

    /// All numbers between two.
    pub fn new(low: f64, high: f64) -> Interval {
        Interval {
            low,
            high,
            defined: true,
        }
    }

    /// Every number, of something that is not defined everywhere.
    pub fn undefined() -> Interval {
        Interval {
            low: f64::NEG_INFINITY,
            high: f64::INFINITY,
            defined: false,
        }
    }

    /// No number: what is computed is defined nowhere.
    pub const EMPTY: Interval = Interval {
        low: f64::INFINITY,
        high: f64::NEG_INFINITY,
        defined: false,
    };

    /// A number that is known to a few roundings.
    pub fn about(value: f64) -> Interval {
        let off = ROUNDED * value.abs();
        Interval::outward(value - off, value + off, true)
    }

    /// Whether it holds no number.
    pub fn is_empty(&self) -> bool {
        self.low > self.high
    }

    /// Bounds that were rounded to the nearest number, moved outwards.
    fn outward(low: f64, high: f64, defined: bool) -> Interval {
        match low.is_nan() || high.is_nan() {
            true => Interval::undefined(),
            false => Interval {
                low: low.next_down(),
                high: high.next_up(),
                defined,
            },
        }
    }

    /// Whether a number lies in it.
    pub fn holds(&self, value: f64) -> bool {
        self.low <= value && value <= self.high
    }

    /// Something in the middle of it.
    pub fn middle(&self) -> f64 {
        self.low + 0.5 * (self.high - self.low)
    }

    /// Whether all of it lies within another, off its ends.
    pub fn is_inside(self, other: Interval) -> bool {
        other.low < self.low && self.high < other.high
    }

    /// What both hold.
    #[must_use]
    pub fn intersection(self, other: Interval) -> Interval {
        let (low, high) = (self.low.max(other.low), self.high.min(other.high));
        let defined = self.defined && other.defined;
        match low <= high {
            true => Interval { low, high, defined },
            false => Interval::EMPTY,
        }
    }

    /// The smallest interval that holds both.
    #[must_use]
    pub fn hull(self, other: Interval) -> Interval {
        Interval {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            defined: self.defined && other.defined,
        }
    }

    /// The same with the opposite sign.
    #[must_use]
    pub fn negated(self) -> Interval {
        Interval {
            low: -self.high,
            high: -self.low,
            defined: self.defined,
        }
    }

    /// The difference.
    #[must_use]
    pub fn minus(self, other: Interval) -> Interval {
        self.plus(other.negated())
    }

    /// The sum.
    #[must_use]
    pub fn plus(self, other: Interval) -> Interval {
        if self.is_empty() || other.is_empty() {
            return Interval::EMPTY;
        }
        let defined = self.defined && other.defined;
        Interval::outward(self.low + other.low, self.high + other.high, defined)
    }

    /// The product.
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

    /// 1 by it.
    #[must_use]
    pub fn reciprocal(self) -> Interval {
        match self.holds(0.0) {
            _ if self.is_empty() => Interval::EMPTY,
            true => Interval::undefined(),
            false => Interval::outward(1.0 / self.high, 1.0 / self.low, self.defined),
        }
    }

    /// The square root, of what is not negative.
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

    /// A whole power.
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
        // A power does not change its direction on one side of zero.
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

    /// The sine of an angle.
    #[must_use]
    pub fn sine(self) -> Interval {
        self.wave(0.0, |angle| double::sin_cos(angle).0)
    }

    /// The cosine of an angle.
    #[must_use]
    pub fn cosine(self) -> Interval {
        self.wave(FRAC_PI_2, |angle| double::sin_cos(angle).1)
    }

    /// The angle of a vector, in (-π, π]; every number where the vector may point along -x, where it jumps.
    #[must_use]
    pub fn angle(y: Interval, x: Interval) -> Interval {
        if y.is_empty() || x.is_empty() {
            return Interval::EMPTY;
        }
        if x.low <= 0.0 && y.holds(0.0) {
            return Interval::undefined();
        }
        let corners = [
            (y.low, x.low),
            (y.low, x.high),
            (y.high, x.low),
            (y.high, x.high),
        ];
        let angles = corners.map(|(y, x)| double::atan2(y, x));
        let low = angles.into_iter().fold(f64::INFINITY, f64::min) - ANGLE;
        let high = angles.into_iter().fold(f64::NEG_INFINITY, f64::max) + ANGLE;
        Interval::outward(low, high, y.defined && x.defined)
    }

    /// The exponential function.
    #[must_use]
    pub fn exponential(self) -> Interval {
        self.rising(double::exp)
    }

    /// The natural logarithm.
    #[must_use]
    pub fn logarithm(self) -> Interval {
        match self.low > 0.0 {
            _ if self.is_empty() => self,
            true => self.rising(double::ln),
            false => Interval::undefined(),
        }
    }

    /// A function that rises everywhere, of which values are computed to some roundings.
    fn rising(self, value: impl Fn(f64) -> f64) -> Interval {
        if self.is_empty() {
            return self;
        }
        let [low, high] = [self.low, self.high].map(|end| Interval::about(value(end)));
        Interval::outward(low.low, high.high, self.defined)
    }

    /// A sine that is `ahead`, which is 1 at a quarter turn less that.
    fn wave(self, ahead: f64, value: impl Fn(f64) -> f64) -> Interval {
        if self.is_empty() {
            return self;
        }
        let width = self.high - self.low;
        // Written so that NaN and infinite bounds give every value.
        let is_narrow = width < TAU;
        if !is_narrow {
            return Interval {
                low: -1.0,
                high: 1.0,
                defined: self.defined,
            };
        }
        let ends = [value(self.low), value(self.high)];
        let holds = |peak: f64| {
            let [first, last] = [self.low, self.high].map(|end| (end + ahead - peak) / TAU);
            let place = PLACE * (1.0 + first.abs().max(last.abs()));
            (last + place).floor() >= (first - place).ceil()
        };
        let low = match holds(-FRAC_PI_2) {
            true => -1.0,
            false => (ends[0].min(ends[1]) - SINE).max(-1.0),
        };
        let high = match holds(FRAC_PI_2) {
            true => 1.0,
            false => (ends[0].max(ends[1]) + SINE).min(1.0),
        };
        Interval {
            low,
            high,
            defined: self.defined,
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    #[test]
    fn extremes_of_sines_are_seen() {
        let around = |low: f64, high: f64| Interval::new(low, high);
        assert_eq!(around(1.5, 1.6).sine().high, 1.0);
        assert!(around(1.0, 1.5).sine().high < 0.9975);
        assert_eq!(around(-0.1, 0.1).cosine().high, 1.0);
        assert_eq!(around(3.1, 3.2).cosine().low, -1.0);
        assert!(around(0.5, 0.6).cosine().holds(0.55_f64.cos()));
        assert_eq!(around(0.0, 7.0).sine(), around(-1.0, 1.0));
        assert_eq!(
            around(100.0 * TAU - 0.1, 100.0 * TAU + 0.1).cosine().high,
            1.0
        );
    }

    #[test]
    fn what_is_not_defined_everywhere_says_so() {
        assert!(!Interval::new(-1.0, 1.0).reciprocal().defined);
        assert!(!Interval::new(-1.0, 1.0).root().defined);
        assert!(Interval::new(0.5, 1.0).root().defined);
        let square = Interval::new(-2.0, 1.0).power(2);
        assert!(square.low == 0.0 && square.holds(4.0) && !square.holds(4.1));
        assert!(Interval::new(-2.0, -1.0).power(3).holds(-8.0));
    }

    #[test]
    fn angles_are_those_of_the_corners() {
        let angle = Interval::angle(Interval::new(1.0, 2.0), Interval::new(-1.0, 1.0));
        assert!(angle.holds(FRAC_PI_2) && angle.holds(0.25 * PI) && angle.holds(0.75 * PI));
        assert!(!angle.holds(0.78) && !angle.holds(2.36));
        let around = Interval::angle(Interval::new(-1.0, 1.0), Interval::new(-2.0, -1.0));
        assert!(!around.defined);
    }

    #[test]
    fn exponentials_and_logarithms_hold_theirs() {
        let unit = Interval::new(0.0, 1.0);
        assert!(unit.exponential().holds(1.0) && unit.exponential().holds(std::f64::consts::E));
        assert!(!unit.exponential().holds(2.72) && !unit.logarithm().defined);
        assert!(
            Interval::new(1.0, 2.0)
                .logarithm()
                .holds(std::f64::consts::LN_2)
        );
    }

    /// 0.1 is no number of the machine, and neither is the sum of three of them 0.3.
    #[test]
    fn rounding_leads_outwards() {
        let tenth = Interval::point(0.1);
        let sum = tenth.plus(tenth).plus(tenth);
        assert!(sum.holds(0.3) && sum.low < sum.high);
        assert!(tenth.times(tenth).holds(0.01));
    }
}
