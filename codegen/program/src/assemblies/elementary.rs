//! Bounds sines, angles, exponentials and logarithms of intervals.
//!
//! Computed elementary functions are within stated errors of the exact ones; these errors are added.

use std::f64::consts::{FRAC_PI_2, TAU};

use linkwright_math::double;

use super::interval::Interval;

/// Error bound of a computed sine or cosine.
pub const SINE: f64 = 4.0 * f64::EPSILON;

/// Error bound of a computed angle of a vector, in rad, for angles of at most half a turn.
pub const ANGLE: f64 = 8.0 * f64::EPSILON;

/// Error bound of an angle's quarter turn, which exceeds rounding for angles of a few turns.
const PLACE: f64 = 1e-9;

impl Interval {
    /// Bounds the sine of an angle.
    #[must_use]
    pub fn sine(self) -> Interval {
        self.wave(0.0, |angle| double::sin_cos(angle).0)
    }

    /// Bounds the cosine of an angle.
    #[must_use]
    pub fn cosine(self) -> Interval {
        self.wave(FRAC_PI_2, |angle| double::sin_cos(angle).1)
    }

    /// Bounds the angle of a vector, in (-π, π]. If the vector may point along -x, where the angle jumps, the bounds are
    /// infinite.
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

    /// Bounds the exponential function.
    #[must_use]
    pub fn exponential(self) -> Interval {
        self.rising(double::exp)
    }

    /// Bounds the natural logarithm.
    #[must_use]
    pub fn logarithm(self) -> Interval {
        match self.low > 0.0 {
            _ if self.is_empty() => self,
            true => self.rising(double::ln),
            false => Interval::undefined(),
        }
    }

    /// Bounds an increasing function whose values have a few roundings.
    fn rising(self, value: impl Fn(f64) -> f64) -> Interval {
        if self.is_empty() {
            return self;
        }
        let [low, high] = [self.low, self.high].map(|end| Interval::about(value(end)));
        Interval::outward(low.low, high.high, self.defined)
    }

    /// Bounds a sine with lead `ahead`, whose maximum 1 lies at a quarter turn less the lead.
    fn wave(self, ahead: f64, value: impl Fn(f64) -> f64) -> Interval {
        if self.is_empty() {
            return self;
        }
        let width = self.high - self.low;
        // NaN and infinite bounds must give unlimited bounds, hence this comparison.
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
}
