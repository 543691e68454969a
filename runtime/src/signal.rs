//! Signals: measured or commanded quantities with their rates and accelerations.
//!
//! The caller guarantees that the rate is the derivative of the value, and the acceleration that of the rate.

use crate::math::Real;

/// Quantity that is supplied at one time, with its first two time derivatives.
///
/// Units are those of the description that declares it: SI (m or rad, and per s and s²) for generated mechanisms.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Signal<T = f64> {
    /// Value of the quantity.
    pub value: T,
    /// First time derivative.
    pub rate: T,
    /// Second time derivative.
    pub acceleration: T,
}

impl<T: Real> Signal<T> {
    /// Returns a signal that moves.
    pub fn new(value: T, rate: T, acceleration: T) -> Self {
        Self {
            value,
            rate,
            acceleration,
        }
    }

    /// Returns a signal that does not move.
    pub fn constant(value: T) -> Self {
        let zero = T::from_f64(0.0);
        Self {
            value,
            rate: zero,
            acceleration: zero,
        }
    }

    /// True if the value, the rate and the acceleration are finite.
    pub fn is_finite(&self) -> bool {
        self.value.is_finite() && self.rate.is_finite() && self.acceleration.is_finite()
    }

    /// Signal after a time (s) with constant acceleration.
    #[must_use]
    pub fn after(&self, time: T) -> Self {
        let change = self.acceleration * time;
        Self {
            value: self.value + (self.rate + T::HALF * change) * time,
            rate: self.rate + change,
            acceleration: self.acceleration,
        }
    }

    /// Signal at the fraction `part` of the straight path from this one to `last`, on which no time passes.
    #[doc(hidden)]
    #[must_use]
    pub fn straight_towards(&self, last: &Self, part: T) -> Self {
        let between = |from: T, to: T| from + part * (to - from);
        Self {
            value: between(self.value, last.value),
            rate: between(self.rate, last.rate),
            acceleration: between(self.acceleration, last.acceleration),
        }
    }

    /// Signal at the fraction `part` of the time `h` (s) from this value to `last`, on the smoothest path: the
    /// polynomial of the fifth degree that has value, rate and acceleration of both ends.
    #[must_use]
    pub fn towards(&self, last: &Self, h: T, part: T) -> Self {
        let number = T::from_f64;
        // With s the fraction, the value is a + b s + c s² + d s³ + e s⁴ + f s⁵.
        let (a, b, c) = (
            self.value,
            self.rate * h,
            T::HALF * self.acceleration * h * h,
        );
        let value = last.value - a - b - c;
        let rate = last.rate * h - b - c - c;
        let acceleration = last.acceleration * h * h - c - c;
        let d = number(10.0) * value - number(4.0) * rate + T::HALF * acceleration;
        let e = number(7.0) * rate - number(15.0) * value - acceleration;
        let f = number(6.0) * value - number(3.0) * rate + T::HALF * acceleration;
        let s = part;
        let velocity = b + s
            * (number(2.0) * c
                + s * (number(3.0) * d + s * (number(4.0) * e + s * number(5.0) * f)));
        let change =
            number(2.0) * c + s * (number(6.0) * d + s * (number(12.0) * e + s * number(20.0) * f));
        Self {
            value: a + s * (b + s * (c + s * (d + s * (e + s * f)))),
            rate: velocity / h,
            acceleration: change / (h * h),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_polynomial_of_the_fifth_degree_is_its_own_smoothest_way() {
        let at = |t: f64| {
            Signal::new(
                1.0 - t + 2.0 * t.powi(3) - 0.5 * t.powi(4) + 0.25 * t.powi(5),
                -1.0 + 6.0 * t.powi(2) - 2.0 * t.powi(3) + 1.25 * t.powi(4),
                12.0 * t - 6.0 * t.powi(2) + 5.0 * t.powi(3),
            )
        };
        let (first, last) = (at(0.5), at(1.75));
        for place in 0..=8_u8 {
            let part = f64::from(place) / 8.0;
            let (found, exact) = (first.towards(&last, 1.25, part), at(0.5 + 1.25 * part));
            assert!((found.value - exact.value).abs() < 1e-13);
            assert!((found.rate - exact.rate).abs() < 1e-12);
            assert!((found.acceleration - exact.acceleration).abs() < 1e-11);
        }
    }
}
