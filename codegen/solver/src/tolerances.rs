//! *The error of a step* → *the same in tolerances, and the length of the next step*.

use crate::rates::Rates;

/// Largest growth of a step beside the one before it.
const LARGEST_GROWTH: f64 = 6.0;

/// Part of the length that the error estimate allows which is taken.
const SAFETY: f64 = 0.9;

/// The largest error of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerances {
    /// Of each component, relative to itself.
    pub relative: f64,
    /// Added to that, in the unit of each component.
    pub absolute: f64,
}

impl Tolerances {
    /// The error that a component may have which is as large as the larger of two values, at most `largest`.
    pub(crate) fn of(&self, one: f64, other: f64, largest: f64) -> f64 {
        self.absolute + self.relative * one.abs().max(other.abs()).min(largest)
    }

    /// The root of the mean square of values in tolerances, for components that are as large as in the larger of two states.
    pub(crate) fn mean<R: Rates>(&self, values: &[f64], states: [&[f64]; 2], rates: &R) -> f64 {
        let judged = rates.judged();
        let squares = (0..judged).map(|component| {
            let [one, other] = states.map(|state| state[component]);
            (values[component] / self.of(one, other, rates.largest(component))).powi(2)
        });
        (squares.sum::<f64>() / judged as f64).sqrt()
    }
}

/// The length of the step after one with an error in tolerances, which falls with a power of the length, or of the next attempt where the
/// error is too large. An attempt keeps at least the part `kept` of the length; a step that is `held` is not longer.
pub(crate) fn next_length(length: f64, error: f64, power: f64, kept: f64, held: bool) -> f64 {
    // An error that is no number is as large as can be.
    let allowed = match error.is_finite() {
        true => SAFETY * error.max(f64::MIN_POSITIVE).powf(-1.0 / power),
        false => kept,
    };
    let most = if held { 1.0 } else { LARGEST_GROWTH };
    length * allowed.clamp(kept, most)
}
