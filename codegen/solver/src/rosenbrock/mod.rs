//! Steps of order 5 along stiff rates, with an estimate of their error and a dense output of order 4.
//!
//! The method is Rodas5P of Steinebach (2023): a Rosenbrock method, L-stable and stiffly accurate, so that what decays within a step is
//! gone at its end, however fast. Each stage solves one linear system with the derivatives of the rates at the start. The module knows
//! neither mechanisms nor how a step is followed.

mod coefficients;
mod differences;

pub use differences::Differences;

use coefficients::{CORRECTIONS, DENSE, GAMMA, NODES, PLACES, SLOPES, STAGES};
use nalgebra::{DMatrix, DVector};

use crate::rates::Rates;
use crate::tolerances::{Tolerances, next_length};

/// Part of its length that a step keeps at least when it is tried again.
const LARGEST_LOSS: f64 = 0.2;

/// A step that has been tried.
#[derive(Clone, Debug)]
pub struct Step {
    /// Time of its beginning (s).
    pub from: f64,
    /// Time of its end (s).
    pub to: f64,
    /// Its error in tolerances: it may be taken up to 1.
    pub error: f64,
    start: Vec<f64>,
    end: Vec<f64>,
    slope: Vec<f64>,
    /// The terms of the dense output.
    dense: [Vec<f64>; 3],
}

/// Multiples of stages.
fn combined(stages: &[DVector<f64>], factors: &[f64], component: usize) -> f64 {
    let terms = stages.iter().zip(factors);
    terms.map(|(stage, factor)| factor * stage[component]).sum()
}

impl Step {
    /// Tries a step of a length from a state with these rates and their derivatives there.
    ///
    /// # Errors
    /// There are no rates somewhere on the way.
    pub fn attempt<R: Rates>(
        rates: &mut R,
        [from, to]: [f64; 2],
        state: &[f64],
        slope: &[f64],
        differences: &Differences,
        tolerances: &Tolerances,
    ) -> Result<Step, R::Failure> {
        let (length, count) = (to - from, state.len());
        let shifted = DMatrix::from_diagonal_element(count, count, 1.0 / (GAMMA * length));
        let factors = (shifted - &differences.jacobian).lu();
        let mut stages: Vec<DVector<f64>> = Vec::with_capacity(STAGES);
        let mut place = state.to_vec();
        let mut own = slope.to_vec();
        for stage in 0..STAGES {
            if stage > 0 {
                for (component, at) in place.iter_mut().enumerate() {
                    *at = state[component] + combined(&stages, PLACES[stage], component);
                }
                rates.rates(from + NODES[stage] * length, &place, &mut own)?;
            }
            let right = DVector::from_fn(count, |component, _| {
                own[component]
                    + combined(&stages, CORRECTIONS[stage], component) / length
                    + length * SLOPES[stage] * differences.time[component]
            });
            // A matrix that is singular belongs to another length of the step.
            let found = factors.solve(&right);
            stages.push(found.unwrap_or_else(|| DVector::repeat(count, f64::NAN)));
        }
        let last = &stages[STAGES - 1];
        let end: Vec<f64> = place.iter().zip(last).map(|(at, own)| at + own).collect();
        let error = tolerances.mean(last.as_slice(), [state, &end], rates);
        let dense = DENSE.map(|factors| {
            let term = |component| combined(&stages, &factors, component);
            (0..count).map(term).collect()
        });
        Ok(Step {
            from,
            to,
            error,
            start: state.to_vec(),
            end,
            slope: Vec::new(),
            dense,
        })
    }

    /// Length of the next step, or of the next attempt where this one is too inaccurate; `held` says that it may not be longer.
    pub fn next_length(&self, held: bool) -> f64 {
        next_length(self.to - self.from, self.error, 5.0, LARGEST_LOSS, held)
    }

    /// The state at the end.
    pub fn end(&self) -> &[f64] {
        &self.end
    }

    /// Finds the rates at the end, with which the next step begins.
    ///
    /// # Errors
    /// There are none.
    pub fn finish<R: Rates>(&mut self, rates: &mut R) -> Result<(), R::Failure> {
        self.slope = vec![0.0; self.end.len()];
        rates.rates(self.to, &self.end, &mut self.slope)
    }

    /// The rates at the end of a finished step.
    pub fn end_rates(&self) -> &[f64] {
        &self.slope
    }

    /// The state at a time on the step.
    pub fn at(&self, t: f64) -> Vec<f64> {
        let part = (t - self.from) / (self.to - self.from);
        let rest = 1.0 - part;
        let value = |component: usize| {
            let inner = self.dense.iter().rev();
            let sum = inner.fold(0.0, |sum, term| term[component] + part * sum);
            rest * self.start[component] + part * (self.end[component] + rest * sum)
        };
        (0..self.start.len()).map(value).collect()
    }
}

#[cfg(test)]
mod tests;
