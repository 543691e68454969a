//! Measures the error of a step in tolerances, and finds the length of the next step.

use linkwright::math::Real;

use crate::rates::Rates;

/// Largest ratio of the lengths of successive steps.
const LARGEST_GROWTH: f64 = 6.0;

/// Part of the length permitted by the error estimate that the next step takes.
const SAFETY: f64 = 0.9;

/// Largest error of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerances {
    /// Relative error of each component.
    pub relative: f64,
    /// Additional absolute error, in the unit of each component.
    pub absolute: f64,
}

impl Tolerances {
    /// Returns the permitted error of a component with the larger magnitude of two values, at most `largest`.
    pub(crate) fn of(&self, one: f64, other: f64, largest: f64) -> f64 {
        self.absolute + self.relative * one.abs().max(other.abs()).min(largest)
    }

    /// Returns the root mean square of values in tolerances, for components of the larger magnitude in two states.
    pub(crate) fn mean<R: Rates>(&self, values: &[f64], states: [&[f64]; 2], rates: &R) -> f64 {
        let judged = rates.judged();
        let squares = (0..judged).map(|component| {
            let [one, other] = states.map(|state| state[component]);
            (values[component] / self.of(one, other, rates.largest(component))).powi(2)
        });
        (squares.sum::<f64>() / judged as f64).sqrt()
    }
}

/// Returns the length of the next step after one with an error in tolerances, or of the next attempt if the error is too large.
///
/// The error falls with a power of the length. An attempt keeps at least the part `kept` of the length; a step that is `held` is not
/// longer.
pub(crate) fn next_length(length: f64, error: f64, power: f64, kept: f64, held: bool) -> f64 {
    // An error that is not finite counts as infinite.
    let allowed = match error.is_finite() {
        true => SAFETY * Real::powf(error.max(f64::MIN_POSITIVE), -1.0 / power),
        false => kept,
    };
    let most = if held { 1.0 } else { LARGEST_GROWTH };
    length * allowed.clamp(kept, most)
}
