//! Moves values of one mechanism into a lane and out of it.

use super::Lanes;
use crate::closed_form::Branch;
use crate::math::Real;
use crate::signal::Signal;

/// Values that can be zero in all lanes.
pub trait Zero: Copy {
    /// Zero in all lanes.
    const ZERO: Self;
}

/// Values of N mechanisms, a lane each.
pub trait LaneValues<V> {
    /// Changes the values of one lane; does nothing beyond the last one.
    fn set_lane(&mut self, lane: usize, values: &V);
}

/// Values of N mechanisms that are read again, as those of frames are.
pub trait ReadLanes<V>: LaneValues<V> {
    /// Overwrites values with those of one lane; does nothing beyond the last one.
    fn get_lane(&self, lane: usize, values: &mut V);
}

impl<T: Real, const N: usize> Zero for Lanes<T, N> {
    const ZERO: Self = Self::splat(T::ZERO);
}

impl<T: Real, const N: usize> Zero for Signal<Lanes<T, N>> {
    const ZERO: Self = Self {
        value: Lanes::splat(T::ZERO),
        rate: Lanes::splat(T::ZERO),
        acceleration: Lanes::splat(T::ZERO),
    };
}

impl<T: Real, const N: usize> LaneValues<T> for Lanes<T, N> {
    #[inline(always)]
    fn set_lane(&mut self, lane: usize, values: &T) {
        self.set(lane, *values);
    }
}

impl<T: Real, const N: usize> ReadLanes<T> for Lanes<T, N> {
    #[inline(always)]
    fn get_lane(&self, lane: usize, values: &mut T) {
        if let Some(value) = self.0.get(lane) {
            *values = *value;
        }
    }
}

/// The sign of a mode.
impl<T: Real, const N: usize> LaneValues<Branch> for Lanes<T, N> {
    #[inline(always)]
    fn set_lane(&mut self, lane: usize, values: &Branch) {
        self.set(lane, values.sign());
    }
}

impl<T: Real, const N: usize> LaneValues<Signal<T>> for Signal<Lanes<T, N>> {
    #[inline(always)]
    fn set_lane(&mut self, lane: usize, values: &Signal<T>) {
        self.value.set(lane, values.value);
        self.rate.set(lane, values.rate);
        self.acceleration.set(lane, values.acceleration);
    }
}
