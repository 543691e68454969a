//! Holds ranges of parameters and inputs; no frame is solved with a value outside of its range.

use crate::math::Real;

/// Range of a parameter or an input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ValueRange<'a, T = f64> {
    /// Both ends, which belong to the range, in the unit.
    pub ends: [T; 2],
    /// Unit of SI; empty for a plain number.
    pub unit: &'a str,
}

impl<T: Real> ValueRange<'_, T> {
    /// True for a number outside of the range; false for NaN.
    pub fn excludes(&self, value: T) -> bool {
        value < self.ends[0] || self.ends[1] < value
    }
}

/// Returns the index and the value of the first number outside of its range; `None` if all are in their ranges.
#[inline]
pub(crate) fn first_outside<'a, T: Real>(
    values: impl Iterator<Item = T>,
    range: impl Fn(usize) -> Option<ValueRange<'a, T>>,
) -> Option<(u16, T)> {
    let mut values = (0..).zip(values);
    values.find(|&(place, value)| range(usize::from(place)).is_some_and(|it| it.excludes(value)))
}
