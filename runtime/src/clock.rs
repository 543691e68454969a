//! Adds durations to a time, as a compensated sum.

use crate::math::Real;

/// Time with the rounding error of its sum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Clock<T> {
    /// Rounded sum (s).
    pub t: T,
    /// Remainder of the sum (s).
    rest: T,
}

impl<T: Real> Clock<T> {
    /// Returns a time without a sum.
    pub fn at(t: T) -> Self {
        Self { t, rest: T::ZERO }
    }

    /// Time after a duration (s) from the time `t` (s). The remainder of a sum counts if `t` is its time.
    ///
    /// The rounding of the sum is computed exactly, whichever of its terms is larger (Knuth 1969, section 4.2.2).
    pub fn after(self, t: T, duration: T) -> Self {
        let rest = match self.t == t {
            true => self.rest,
            false => T::ZERO,
        };
        let duration = duration + rest;
        let sum = t + duration;
        let added = sum - t;
        let rest = (t - (sum - added)) + (duration - added);
        Self { t: sum, rest }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_milliseconds_for_hours_in_single_precision() {
        let mut clock = Clock::at(0.0_f32);
        for _ in 0..4 * 3_600_000 {
            clock = clock.after(clock.t, 1e-3);
        }
        // The duration as rounded to single precision.
        let exact = 4.0 * 3_600_000.0 * f64::from(1e-3_f32);
        let rounding = f64::from(f32::EPSILON) * exact;
        assert!(
            (f64::from(clock.t) - exact).abs() <= rounding,
            "{}",
            clock.t
        );
    }

    #[test]
    fn forgets_the_rest_of_another_time() {
        let late = Clock::at(1e6_f32).after(1e6, 0.03);
        assert_eq!(late.t, 1e6);
        assert!(late.rest != 0.0);
        assert_eq!(late.after(0.0, 0.001).t, 0.001);
        assert_eq!(Clock::at(2.0).after(2.0, -0.5).t, 1.5);
        assert!(Clock::at(2.0).after(2.0, f64::NAN).t.is_nan());
    }
}
