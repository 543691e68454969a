//! Integrates with steps of order 8, an estimate of their error and a dense output of order 7.
//!
//! The method is DOP853 of Hairer, Nørsett and Wanner (1993, Solving Ordinary Differential Equations I, section II.10), with their
//! choice of the first step. It is implemented here because rates come from constraints: they may not exist inside a step, which is then
//! tried again with a smaller length. A step counts only after the mechanism has been moved along it.
mod coefficients;

use linkwright::math::Real;

use coefficients::{DENSE, DENSE_STAGES, END, FIFTH, STAGES, Stage, THIRD, Term};

use crate::rates::Rates;
use crate::tolerances::{Tolerances, next_length};

/// Smallest factor of a step's length for the next attempt.
const LARGEST_LOSS: f64 = 1.0 / 3.0;

/// Weight of the error of order 3 beside that of order 5.
const THIRD_WEIGHT: f64 = 0.01;

/// Length of a first step, as a part of the time in which the state changes by its own magnitude.
const FIRST_PART: f64 = 0.01;

/// Smallest first step (s) if the state does not determine a length.
const FIRST_STEP: f64 = 1e-6;

/// Slope of a state, in tolerances, below which the slope does not determine the length of a step.
const SMALL: f64 = 1e-5;

/// Largest length of a stable step, in units of the fastest decay time.
pub(crate) const STABILITY_LIMIT: f64 = 6.1;

/// Attempted step.
#[derive(Clone, Debug)]
pub struct Step {
    /// Time at the beginning (s).
    pub from: f64,
    /// Time at the end (s).
    pub to: f64,
    /// Error in tolerances; a step is accepted up to 1.
    pub error: f64,
    /// State at the beginning.
    start: Vec<f64>,
    /// State at the end.
    end: Vec<f64>,
    /// Rates of all stages.
    stages: Vec<Vec<f64>>,
    /// Coefficients of the dense output; `None` until they are requested.
    dense: Option<[Vec<f64>; 8]>,
}

/// Returns the state plus a combination of stages times a length.
fn moved(state: &[f64], stages: &[Vec<f64>], terms: &[Term], length: f64) -> Vec<f64> {
    let mut moved = state.to_vec();
    for (component, value) in moved.iter_mut().enumerate() {
        *value += length * combined(stages, terms, component);
    }
    moved
}

fn combined(stages: &[Vec<f64>], terms: &[Term], component: usize) -> f64 {
    let terms = terms.iter();
    terms
        .map(|&(stage, factor)| factor * stages[stage][component])
        .sum()
}

/// Returns the length of a first step (s) from a state with these rates, at most `longest`.
///
/// # Errors
/// Errors of the rates.
pub fn first_length<R: Rates>(
    rates: &mut R,
    t: f64,
    state: &[f64],
    slope: &[f64],
    longest: f64,
    tolerances: &Tolerances,
) -> Result<f64, R::Failure> {
    let size = tolerances.mean(state, [state; 2], rates);
    let steep = tolerances.mean(slope, [state; 2], rates);
    let tried = match size < SMALL || steep < SMALL {
        true => FIRST_STEP,
        false => FIRST_PART * size / steep,
    };
    let tried = tried.min(longest);
    let ahead = moved(state, &[slope.to_vec()], &[(0, 1.0)], tried);
    let mut there = vec![0.0; state.len()];
    rates.rates(t + tried, &ahead, &mut there)?;
    let bend: Vec<f64> = there
        .iter()
        .zip(slope)
        .map(|(one, other)| one - other)
        .collect();
    let bent = tolerances.mean(&bend, [state; 2], rates) / tried;
    let largest = steep.max(bent);
    let allowed = match largest > 0.0 {
        true => Real::powf(FIRST_PART / largest, 1.0 / 8.0),
        false => longest,
    };
    Ok(allowed.min(tried / FIRST_PART).min(longest))
}

impl Step {
    /// Tries a step of a length from a state with these rates.
    ///
    /// # Errors
    /// Rates do not exist at one of the stages.
    pub fn attempt<R: Rates>(
        rates: &mut R,
        [from, to]: [f64; 2],
        state: &[f64],
        slope: &[f64],
        tolerances: &Tolerances,
    ) -> Result<Step, R::Failure> {
        let length = to - from;
        let mut stages = vec![slope.to_vec()];
        for stage in &STAGES {
            stages.push(rates_at(rates, stage, from, length, state, &stages)?);
        }
        let end = moved(state, &stages, &END, length);
        let judged = rates.judged();
        let [mut fifth, mut third] = [0.0; 2];
        for component in 0..judged {
            let largest = rates.largest(component);
            let tolerance = tolerances.of(state[component], end[component], largest);
            let [whole, inner] =
                [&END[..], &THIRD].map(|terms| combined(&stages, terms, component));
            third += ((whole - inner) / tolerance).powi(2);
            fifth += (combined(&stages, &FIFTH, component) / tolerance).powi(2);
        }
        let weighed = fifth + THIRD_WEIGHT * third;
        let error = match weighed > 0.0 {
            true => length.abs() * fifth / (weighed * judged as f64).sqrt(),
            false => 0.0,
        };
        Ok(Step {
            from,
            to,
            error,
            start: state.to_vec(),
            end,
            stages,
            dense: None,
        })
    }

    /// Returns the length of the next step, or of the next attempt if this one is too inaccurate. A `held` step may not be longer.
    pub fn next_length(&self, held: bool) -> f64 {
        next_length(self.to - self.from, self.error, 8.0, LARGEST_LOSS, held)
    }

    /// State at the end.
    pub fn end(&self) -> &[f64] {
        &self.end
    }

    /// Returns the length in units of the fastest decay time among the first components.
    ///
    /// Two stages at the end of a finished step yield the estimate, or the rounding of the stages.
    ///
    /// Beyond `STABILITY_LIMIT`, stability limits a step and not its error (Hairer and Wanner 1996, Solving Ordinary Differential Equations II,
    /// section IV.2).
    pub fn stiffness(&self, judged: usize) -> f64 {
        let length = self.to - self.from;
        let last = STAGES.len();
        let place = moved(&self.start, &self.stages, STAGES[last - 1].terms, length);
        let distance = |pairs: [&[f64]; 2]| {
            let pairs = pairs[0].iter().zip(pairs[1]).take(judged);
            let squares = pairs.map(|(one, other)| (one - other).powi(2));
            squares.sum::<f64>().sqrt()
        };
        let apart = distance([&place, &self.end]);
        let rates = distance([&self.stages[last], self.end_rates()]);
        match apart > 0.0 {
            true => length * rates / apart,
            false => 0.0,
        }
    }

    /// Evaluates the rates at the end, with which the next step begins.
    ///
    /// # Errors
    /// The rates do not exist.
    pub fn finish<R: Rates>(&mut self, rates: &mut R) -> Result<(), R::Failure> {
        let mut slope = vec![0.0; self.end.len()];
        rates.rates(self.to, &self.end, &mut slope)?;
        self.stages.push(slope);
        Ok(())
    }

    /// Rates at the end of a finished step.
    pub fn end_rates(&self) -> &[f64] {
        &self.stages[STAGES.len() + 1]
    }

    /// Returns the state at a time within a finished step.
    ///
    /// # Errors
    /// Rates do not exist at one of the stages of the dense output.
    pub fn at<R: Rates>(&mut self, rates: &mut R, t: f64) -> Result<Vec<f64>, R::Failure> {
        if t == self.to {
            return Ok(self.end.clone());
        }
        let length = self.to - self.from;
        let parts = match &mut self.dense {
            Some(parts) => parts,
            dense @ None => {
                let mut stages = self.stages.clone();
                for stage in &DENSE_STAGES {
                    let slope = rates_at(rates, stage, self.from, length, &self.start, &stages)?;
                    stages.push(slope);
                }
                dense.insert(dense_parts(&self.start, &self.end, &stages, length))
            }
        };
        let part = (t - self.from) / length;
        let rest = 1.0 - part;
        let value = |component: usize| {
            // Factors alternate from the innermost term outwards.
            let inner = parts[1..].iter().enumerate().rev();
            let sum = inner.fold(0.0, |sum, (place, coefficients)| {
                let factor = if place % 2 == 0 { part } else { rest };
                factor * (coefficients[component] + sum)
            });
            parts[0][component] + sum
        };
        Ok((0..self.start.len()).map(value).collect())
    }
}

fn rates_at<R: Rates>(
    rates: &mut R,
    stage: &Stage,
    from: f64,
    length: f64,
    state: &[f64],
    stages: &[Vec<f64>],
) -> Result<Vec<f64>, R::Failure> {
    let at = moved(state, stages, stage.terms, length);
    let mut slope = vec![0.0; state.len()];
    rates.rates(from + stage.node * length, &at, &mut slope)?;
    Ok(slope)
}

/// Returns the coefficients of the dense output, component by component.
fn dense_parts(start: &[f64], end: &[f64], stages: &[Vec<f64>], length: f64) -> [Vec<f64>; 8] {
    let count = start.len();
    let mut parts = [const { Vec::new() }; 8].map(|_: Vec<f64>| vec![0.0; count]);
    for component in 0..count {
        let change = end[component] - start[component];
        let first = length * stages[0][component] - change;
        let last = change - length * stages[STAGES.len() + 1][component] - first;
        parts[0][component] = start[component];
        parts[1][component] = change;
        parts[2][component] = first;
        parts[3][component] = last;
        for (place, terms) in DENSE.iter().enumerate() {
            parts[4 + place][component] = length * combined(stages, terms, component);
        }
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rates of a circle, which do not exist beyond a time.
    struct Circle {
        end: f64,
        count: usize,
    }

    impl Rates for Circle {
        type Failure = f64;

        fn rates(&mut self, t: f64, state: &[f64], rates: &mut [f64]) -> Result<(), f64> {
            self.count += 1;
            rates.copy_from_slice(&[-state[1], state[0]]);
            if t > self.end { Err(t) } else { Ok(()) }
        }

        fn judged(&self) -> usize {
            2
        }
    }

    const TIGHT: Tolerances = Tolerances {
        relative: 1e-12,
        absolute: 1e-12,
    };

    fn step(length: f64) -> (Step, Circle) {
        let mut circle = Circle { end: 1e3, count: 0 };
        let step = Step::attempt(&mut circle, [0.0, length], &[1.0, 0.0], &[0.0, 1.0], &TIGHT);
        let mut step = step.expect("a circle has rates");
        step.finish(&mut circle).expect("a circle has rates");
        (step, circle)
    }

    /// The error of a step is of order 9 in its length, that between its ends of order 8.
    #[test]
    fn the_orders_are_eight_and_seven() {
        let error = |length: f64, part: f64| {
            let (mut step, mut circle) = step(length);
            let t = part * length;
            let state = step.at(&mut circle, t).expect("a circle has rates");
            (state[0] - t.cos()).hypot(state[1] - t.sin())
        };
        for (part, order) in [(1.0, 9.0), (0.37, 8.0)] {
            let falls = (error(0.8, part) / error(0.4, part)).log2();
            assert!((falls - order).abs() < 0.6, "{part}: {falls}");
        }
        let (step, circle) = step(0.4);
        assert_eq!((circle.count, step.end().len()), (12, 2));
    }

    #[test]
    fn rates_that_do_not_exist_end_an_attempt() {
        let mut circle = Circle { end: 0.5, count: 0 };
        let tried = Step::attempt(&mut circle, [0.0, 1.0], &[1.0, 0.0], &[0.0, 1.0], &TIGHT);
        assert!(tried.is_err_and(|t| t > 0.5));
        let first = first_length(&mut circle, 0.0, &[1.0, 0.0], &[0.0, 1.0], 0.1, &TIGHT);
        assert!(first.is_ok_and(|length| length > 0.0 && length <= 0.1));
    }
}
