//! Integrates stiff rates with steps of order 9, an estimate of their error and a dense output of order 5.
//!
//! The method is Radau IIA with five stages (Hairer and Wanner 1996, Solving Ordinary Differential Equations II, sections IV.5 and IV.8):
//! collocation, L-stable and stiffly accurate, so that what decays within a step is gone at its end, however fast. All stages satisfy the
//! rates themselves, and the order does not fall if the stiff direction turns with the state: a strong damper then acts like a joint, and
//! the method keeps its order for equations with such joints (section VII.4).

mod coefficients;
mod differences;

pub use differences::Differences;

use coefficients::{ESTIMATE, GAMMA, INVERSE, NODES, STAGES};
use nalgebra::{DMatrix, DVector, Dyn, LU};

use crate::rates::Rates;
use crate::tolerances::{Tolerances, next_length};

/// Smallest factor of a step's length for the next attempt.
const LARGEST_LOSS: f64 = 0.2;

/// Largest number of corrections of the stages.
const CORRECTIONS: usize = 10;

/// Error of the stages, in tolerances, below which corrections end; the errors of thousands of steps add up.
const MISSED: f64 = 1e-4;

/// Error in tolerances that rounding may leave.
const ROUNDED: f64 = 1e-2;

/// Smallest tolerance of a variable, in rounding errors of its scale. Variables that a strong damper holds are found to a few rounding
/// errors, which then stay below [`ROUNDED`].
const RESOLVED: f64 = 400.0;

/// Smallest assumed convergence factor of corrections: the first ones converge faster, since most of the rates is linear.
const FASTEST: f64 = 0.1;

/// Attempted step.
#[derive(Clone, Debug)]
pub struct Step {
    /// Time at the beginning (s).
    pub from: f64,
    /// Time at the end (s).
    pub to: f64,
    /// Error in tolerances; a step is accepted up to 1. Infinite if the stages are not found.
    pub error: f64,
    start: Vec<f64>,
    end: Vec<f64>,
    slope: Vec<f64>,
    /// Distances of the stages from the start, one after another.
    stages: DVector<f64>,
}

/// Step during its attempt.
struct Attempt<'a, R> {
    rates: &'a mut R,
    from: f64,
    length: f64,
    state: &'a [f64],
    tolerances: &'a Tolerances,
    /// Scales of the judged components.
    scales: Vec<f64>,
}

impl<R: Rates> Attempt<'_, R> {
    /// Divides values by tolerances for components of the larger magnitude in the start and another state.
    fn in_tolerances(&self, values: &[f64], other: &[f64]) -> f64 {
        let squares = self.scales.iter().enumerate().map(|(component, scale)| {
            let largest = self.rates.largest(component);
            let [one, other] = [self.state, other].map(|state| state[component]);
            let allowed = self.tolerances.of(one, other, largest);
            (values[component] / (allowed + RESOLVED * f64::EPSILON * scale)).powi(2)
        });
        (squares.sum::<f64>() / self.scales.len() as f64).sqrt()
    }

    /// Returns the rates at the stages minus those of the polynomial through the stages.
    fn missed(&mut self, stages: &DVector<f64>) -> Result<DVector<f64>, R::Failure> {
        let count = self.state.len();
        let mut missed = DVector::zeros(STAGES * count);
        for stage in 0..STAGES {
            let place = moved(self.state, &stages.as_slice()[stage * count..]);
            let residual = &mut missed.as_mut_slice()[stage * count..(stage + 1) * count];
            let t = self.from + NODES[stage] * self.length;
            self.rates.rates(t, &place, residual)?;
            for (component, own) in residual.iter_mut().enumerate() {
                *own -= combined(stages, &INVERSE[stage], count, component) / self.length;
            }
        }
        Ok(missed)
    }

    /// Solves the stages by the simplified Newton method; `None` if it does not converge.
    fn stages(&mut self, jacobian: &DMatrix<f64>) -> Result<Option<DVector<f64>>, R::Failure> {
        let count = self.state.len();
        let size = STAGES * count;
        let matrix = DMatrix::from_fn(size, size, |row, column| {
            let [stage, other] = [row, column].map(|it| it / count);
            let [component, by] = [row, column].map(|it| it % count);
            let diagonal = if component == by {
                INVERSE[stage][other] / self.length
            } else {
                0.0
            };
            let rate = if stage == other {
                jacobian[(component, by)]
            } else {
                0.0
            };
            diagonal - rate
        });
        let factors = matrix.lu();
        let mut stages = DVector::zeros(size);
        let (mut before, mut least) = (f64::NAN, f64::INFINITY);
        for _ in 0..CORRECTIONS {
            let missed = self.missed(&stages)?;
            let Some(correction) = factors.solve(&missed) else {
                return Ok(None);
            };
            stages += &correction;
            let sizes = (0..STAGES).map(|stage| {
                let [own, place] = [&correction, &stages]
                    .map(|it| &it.as_slice()[stage * count..(stage + 1) * count]);
                self.in_tolerances(own, &moved(self.state, place))
            });
            // NaN must persist.
            let size = sizes.fold(0.0, |largest: f64, it| {
                let stays = it <= largest || largest.is_nan();
                if stays { largest } else { it }
            });
            // The remaining corrections form a geometric series with this factor.
            let factor = size / before;
            let left = match factor < 1.0 {
                true => size * factor.max(FASTEST) / (1.0 - factor),
                false => size,
            };
            least = left.min(least);
            before = size;
            // Corrections that no longer fall are rounding, or diverge.
            if left <= MISSED || !size.is_finite() || factor >= 1.0 {
                break;
            }
        }
        let is_found = least <= ROUNDED && before <= 1.0;
        Ok(is_found.then_some(stages))
    }

    /// Returns the error at the end in tolerances.
    fn error(
        &mut self,
        slope: &[f64],
        stages: &DVector<f64>,
        end: &[f64],
        jacobian: &DMatrix<f64>,
    ) -> Result<f64, R::Failure> {
        let count = self.state.len();
        let shifted = DMatrix::from_diagonal_element(count, count, 1.0 / (GAMMA * self.length));
        let factors: LU<f64, Dyn, Dyn> = (shifted - jacobian).lu();
        let estimate = |slope: &[f64]| {
            let right = DVector::from_fn(count, |component, _| {
                slope[component] + combined(stages, &ESTIMATE, count, component) / self.length
            });
            let error = factors.solve(&right);
            error.unwrap_or_else(|| DVector::repeat(count, f64::INFINITY))
        };
        let first = estimate(slope);
        let error = self.in_tolerances(first.as_slice(), end);
        if error <= 1.0 || !error.is_finite() {
            return Ok(error);
        }
        // Components that decay at once do not count: the rates are taken after the decay.
        let place = moved(self.state, first.as_slice());
        let mut there = vec![0.0; count];
        self.rates.rates(self.from, &place, &mut there)?;
        let second = estimate(&there);
        Ok(self.in_tolerances(second.as_slice(), end))
    }
}

/// Returns a state plus a difference.
fn moved(state: &[f64], by: &[f64]) -> Vec<f64> {
    let pairs = state.iter().zip(by);
    pairs.map(|(at, by)| at + by).collect()
}

/// Returns a component of a combination of stages.
fn combined(stages: &DVector<f64>, factors: &[f64], count: usize, component: usize) -> f64 {
    let terms = factors.iter().enumerate();
    terms
        .map(|(stage, factor)| factor * stages[stage * count + component])
        .sum()
}

impl Step {
    /// Tries a step of a length from a state with these rates and their derivatives.
    ///
    /// # Errors
    /// Rates do not exist at one of the stages.
    pub fn attempt<R: Rates>(
        rates: &mut R,
        [from, to]: [f64; 2],
        state: &[f64],
        slope: &[f64],
        differences: &Differences,
        tolerances: &Tolerances,
    ) -> Result<Step, R::Failure> {
        let count = state.len();
        let scales = rates.scales(state, slope, to - from);
        let mut attempt = Attempt {
            rates,
            from,
            length: to - from,
            state,
            tolerances,
            scales,
        };
        let jacobian = &differences.jacobian;
        let mut step = Step {
            from,
            to,
            error: f64::INFINITY,
            start: state.to_vec(),
            end: Vec::new(),
            slope: Vec::new(),
            stages: DVector::zeros(0),
        };
        if let Some(stages) = attempt.stages(jacobian)? {
            step.end = moved(state, &stages.as_slice()[(STAGES - 1) * count..]);
            step.error = attempt.error(slope, &stages, &step.end, jacobian)?;
            step.stages = stages;
        }
        Ok(step)
    }

    /// Returns the length of the next step, or of the next attempt if this one is too inaccurate. A `held` step may not be longer.
    pub fn next_length(&self, held: bool) -> f64 {
        let power = (STAGES + 1) as f64;
        next_length(self.to - self.from, self.error, power, LARGEST_LOSS, held)
    }

    /// State at the end.
    pub fn end(&self) -> &[f64] {
        &self.end
    }

    /// Evaluates the rates at the end, with which the next step begins.
    ///
    /// # Errors
    /// The rates do not exist.
    pub fn finish<R: Rates>(&mut self, rates: &mut R) -> Result<(), R::Failure> {
        self.slope = vec![0.0; self.end.len()];
        rates.rates(self.to, &self.end, &mut self.slope)
    }

    /// Rates at the end of a finished step.
    pub fn end_rates(&self) -> &[f64] {
        &self.slope
    }

    /// Returns the state at a time within the step, on the polynomial through its start and its stages.
    pub fn at(&self, t: f64) -> Vec<f64> {
        let part = (t - self.from) / (self.to - self.from);
        let count = self.start.len();
        let factors: [f64; STAGES] = std::array::from_fn(|stage| {
            let at_stage = NODES[stage];
            let others = NODES.iter().enumerate().filter(|(it, _)| *it != stage);
            let product = others.map(|(_, node)| (part - node) / (at_stage - node));
            part / at_stage * product.product::<f64>()
        });
        let value =
            |component| self.start[component] + combined(&self.stages, &factors, count, component);
        (0..count).map(value).collect()
    }
}

#[cfg(test)]
mod tests;
