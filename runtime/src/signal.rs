//! A measured or commanded quantity → one value that carries it with its rate and acceleration.
//!
//! The module does not know where a signal comes from, nor whether its rate is the derivative of its value: whoever supplies it
//! vouches for that.

use crate::math::Real;

/// A quantity that is supplied at one time: its value with its first two time derivatives.
///
/// Units are those of the description that declares it: SI (m or rad, and per s and s²) for generated mechanisms.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Signal<T = f64> {
    /// The value.
    pub value: T,
    /// Its first time derivative.
    pub rate: T,
    /// Its second time derivative.
    pub acceleration: T,
}

impl<T: Real> Signal<T> {
    /// A signal that moves.
    pub fn new(value: T, rate: T, acceleration: T) -> Self {
        Self {
            value,
            rate,
            acceleration,
        }
    }

    /// A signal that does not move.
    pub fn constant(value: T) -> Self {
        let zero = T::from_f64(0.0);
        Self {
            value,
            rate: zero,
            acceleration: zero,
        }
    }
}
