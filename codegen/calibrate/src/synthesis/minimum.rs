//! Minimizes the squared differences from the targets, beginning with one mechanism.
//!
//! Parameters stay strictly within their bounds. Steps to mechanisms that do not move over the whole range are taken back.

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt, TerminationReason};
use linkwright_solver::comparison::difference;
use linkwright_solver::{Modes, Observable};
use nalgebra::storage::Owned;
use nalgebra::{DMatrix, DVector, Dyn};

use super::motion::{MovedQuantities, Sample, Wanted};
use super::penalties::Penalties;
use super::starts::Start;
use super::{Candidate, Task, targets};

/// Largest number of solutions of the motion per variable.
const PATIENCE: usize = 40;

/// Largest number of rounds in which limits are kept more closely.
const ROUNDS: usize = 12;

/// Relative excess of a limit in a frame that is left to rounding.
const EXCESS: f64 = 1e-9;

/// Number of times that limits are narrowed by the excess between frames.
const NARROWED: usize = 4;

/// Part of an excess between frames by which a limit is narrowed beyond it.
const BEYOND: f64 = 0.1;

/// Residual that represents a mechanism that does not move, in terms of the initial one.
const FAILURE_FACTOR: f64 = 1e3;

/// Search for the minimum near one start.
pub(super) struct Minimizer<'a> {
    task: &'a Task,
    moved: &'a MovedQuantities,
    observables: Vec<Observable>,
    /// Rates of the observables; `None` if the times of rows are known.
    rates: Option<Vec<Observable>>,
    limited: Vec<Observable>,
    /// Ends of the limits, narrowed so that the motion keeps them between frames, too.
    ends: Vec<[Option<f64>; 2]>,
}

impl<'a> Minimizer<'a> {
    pub fn new(task: &'a Task, moved: &'a MovedQuantities) -> Minimizer<'a> {
        let observables = task.targets.observables();
        let rates = match task.targets.times {
            Some(_) => None,
            None => observables.iter().map(|it| targets::rate(*it)).collect(),
        };
        Minimizer {
            limited: task.limits.iter().map(|it| it.observable).collect(),
            ends: task.limits.iter().map(|it| it.ends).collect(),
            task,
            moved,
            observables,
            rates,
        }
    }

    /// Returns the minimum; `None` if the limits cannot be kept, or the rows are not in their order.
    pub fn minimum(mut self, start: &Start) -> Option<Candidate> {
        let mut start = start.clone();
        for _ in 0..NARROWED {
            let (problem, is_converged) = self.within_limits(&start)?;
            let (values, times) = problem.values();
            let broken = self
                .moved
                .broken(&values, &start.modes, &self.task.frames)?;
            if broken.iter().all(Option::is_none) {
                return self.task.candidate(&problem, is_converged);
            }
            start.values = values;
            start.times = times;
            for (kept, ends) in self.task.limits.iter().zip(&mut self.ends) {
                let Some(worst) = broken[kept.place] else {
                    continue;
                };
                let [low, high] = kept.ends;
                let (below, above) = (
                    low.map_or(0.0, |it| it - worst),
                    high.map_or(0.0, |it| worst - it),
                );
                if let (true, Some(end)) = (below > 0.0, &mut ends[0]) {
                    *end += (1.0 + BEYOND) * below;
                }
                if let (true, Some(end)) = (above > 0.0, &mut ends[1]) {
                    *end -= (1.0 + BEYOND) * above;
                }
            }
        }
        None
    }

    /// Minimizes with growing multipliers until all limits hold in all frames.
    fn within_limits<'b>(&'b self, start: &'b Start) -> Option<(Problem<'b>, bool)> {
        let frames = self.task.frames.len();
        let mut penalties = Penalties::new(2 * frames * self.limited.len());
        let mut problem = Problem::new(self, start, penalties.clone())?;
        for _ in 0..ROUNDS {
            let minimizer = LevenbergMarquardt::new().with_patience(PATIENCE);
            let (minimum, report) = minimizer.minimize(problem);
            problem = minimum;
            let is_converged = report.termination.was_successful()
                || matches!(
                    report.termination,
                    TerminationReason::NoImprovementPossible(_)
                );
            // The minimizer may end with a step that is taken back.
            problem.update();
            let excesses = problem.excesses()?;
            if penalties.update(&excesses) <= EXCESS {
                return Some((problem, is_converged));
            }
            problem.penalties = penalties.clone();
        }
        None
    }
}

/// Samples at all rows, and in all frames.
struct Sampled {
    rows: Vec<Sample>,
    frames: Vec<Sample>,
}

/// Least-squares problem of a start.
pub(super) struct Problem<'a> {
    minimizer: &'a Minimizer<'a>,
    start: &'a Start,
    /// Variables of the parameters, then of the times of rows if these are sought.
    variables: DVector<f64>,
    sampled: Option<Sampled>,
    penalties: Penalties,
    /// Residual that represents a mechanism that does not move.
    far: f64,
    /// Times (s) that one unit of a variable of time is.
    span: f64,
}

impl<'a> Problem<'a> {
    fn new(minimizer: &'a Minimizer<'a>, start: &'a Start, penalties: Penalties) -> Option<Self> {
        let task = minimizer.task;
        let span = match &task.frames[..] {
            [first, .., last] if last > first => last - first,
            _ => 1.0,
        };
        let bounds = task.bounds.iter().zip(&start.values);
        let mut variables: Vec<f64> = bounds
            .map(|(it, value)| it.variable(*value, *value))
            .collect();
        if minimizer.rates.is_some() {
            variables.extend(start.times.iter().map(|t| t / span));
        }
        let mut problem = Problem {
            minimizer,
            start,
            variables: DVector::from_vec(variables),
            sampled: None,
            penalties,
            far: 0.0,
            span,
        };
        problem.update();
        problem.sampled.as_ref()?;
        let largest = problem.residuals().map_or(1.0, |it| it.amax());
        problem.far = FAILURE_FACTOR * largest.max(1.0);
        Some(problem)
    }

    /// Assembly modes, which a fit keeps.
    pub fn modes(&self) -> &Modes {
        &self.start.modes
    }

    /// Returns the parameters and the times of the rows.
    pub fn values(&self) -> (Vec<f64>, Vec<f64>) {
        let bounds = self.minimizer.task.bounds.iter().enumerate();
        let values =
            bounds.map(|(place, it)| it.value(self.variables[place], self.start.values[place])[0]);
        let values: Vec<f64> = values.collect();
        let times = match self.minimizer.rates {
            None => self.start.times.clone(),
            Some(_) => {
                let times = self.variables.iter().skip(values.len());
                times.map(|it| it * self.span).collect()
            }
        };
        (values, times)
    }

    fn update(&mut self) {
        let minimizer = self.minimizer;
        let (values, times) = self.values();
        let rows = Wanted {
            times: &times,
            observables: &minimizer.observables,
            rates: minimizer.rates.as_deref(),
        };
        let frames = Wanted {
            times: &minimizer.task.frames,
            observables: &minimizer.limited,
            rates: None,
        };
        let samples = minimizer
            .moved
            .samples(&values, &self.start.modes, &[rows, frames]);
        self.sampled = samples.and_then(|samples| {
            let [rows, frames] = <[Vec<Sample>; 2]>::try_from(samples).ok()?;
            Some(Sampled { rows, frames })
        });
    }

    /// Returns the relative excess of all limits in all frames, at both ends; negative within the limits.
    fn excesses(&self) -> Option<Vec<f64>> {
        let sampled = self.sampled.as_ref()?;
        let minimizer = self.minimizer;
        let limits = minimizer
            .task
            .limits
            .iter()
            .zip(&minimizer.ends)
            .enumerate();
        let excesses = limits.flat_map(|(limit, (kept, [low, high]))| {
            sampled.frames.iter().flat_map(move |frame| {
                let value = frame.values[limit];
                let below = low.map_or(f64::NEG_INFINITY, |low| (low - value) / kept.size);
                let above = high.map_or(f64::NEG_INFINITY, |high| (value - high) / kept.size);
                [below, above]
            })
        });
        Some(excesses.collect())
    }

    /// Returns the differences from the targets, column by column.
    pub fn differences(&self) -> Option<Vec<Vec<Option<f64>>>> {
        Some(self.differences_of(&self.sampled.as_ref()?.rows))
    }

    /// Returns the differences from the targets if the rows are at these times (s).
    pub fn differences_at(&self, times: &[f64]) -> Option<Vec<Vec<Option<f64>>>> {
        let (values, _) = self.values();
        let rows = Wanted {
            times,
            observables: &self.minimizer.observables,
            rates: None,
        };
        let moved = self.minimizer.moved;
        let mut samples = moved.samples(&values, &self.start.modes, &[rows])?;
        Some(self.differences_of(&samples.pop()?))
    }

    fn differences_of(&self, samples: &[Sample]) -> Vec<Vec<Option<f64>>> {
        let columns = self.minimizer.task.targets.columns.iter().enumerate();
        let columns = columns.map(|(place, column)| {
            let rows = column.values.iter().zip(samples);
            let rows = rows.map(|(target, sample)| {
                Some(difference(
                    (*target)?,
                    sample.values[place],
                    column.is_angle,
                ))
            });
            rows.collect()
        });
        columns.collect()
    }

    fn count(&self) -> usize {
        let task = self.minimizer.task;
        task.targets.count() + 2 * task.limits.len() * task.frames.len()
    }
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Problem<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, variables: &DVector<f64>) {
        self.variables.copy_from(variables);
        self.update();
    }

    fn params(&self) -> DVector<f64> {
        self.variables.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        let (Some(differences), Some(excesses)) = (self.differences(), self.excesses()) else {
            return Some(DVector::from_element(self.count(), self.far));
        };
        let columns = self.minimizer.task.targets.columns.iter().zip(&differences);
        let differences = columns.flat_map(|(column, differences)| {
            let differences = differences.iter().flatten();
            differences.map(move |it| it / column.size)
        });
        let excesses = excesses.iter().enumerate();
        let excesses = excesses.map(|(place, it)| self.penalties.residual(place, *it)[0]);
        Some(DVector::from_iterator(
            self.count(),
            differences.chain(excesses),
        ))
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let sampled = self.sampled.as_ref()?;
        let minimizer = self.minimizer;
        let task = minimizer.task;
        let parameters = minimizer.moved.count();
        let bounds = task.bounds.iter().enumerate();
        let by_variable: Vec<f64> = bounds
            .map(|(place, it)| it.value(self.variables[place], self.start.values[place])[1])
            .collect();
        let mut jacobian = DMatrix::zeros(self.count(), self.variables.len());
        let mut next = 0;
        for (place, column) in task.targets.columns.iter().enumerate() {
            for (row, sample) in sampled.rows.iter().enumerate() {
                if column.values[row].is_none() {
                    continue;
                }
                let slopes = &sample.slopes[place * parameters..][..parameters];
                for (parameter, slope) in slopes.iter().enumerate() {
                    jacobian[(next, parameter)] = -slope * by_variable[parameter] / column.size;
                }
                if let Some(rate) = sample.rates.get(place) {
                    jacobian[(next, parameters + row)] = -rate * self.span / column.size;
                }
                next += 1;
            }
        }
        let excesses = self.excesses()?;
        for (limit, kept) in task.limits.iter().enumerate() {
            for frame in &sampled.frames {
                let slopes = &frame.slopes[limit * parameters..][..parameters];
                for sign in [-1.0, 1.0] {
                    let place = next - task.targets.count();
                    let [_, weight] = self.penalties.residual(place, excesses[place]);
                    for (parameter, slope) in slopes.iter().enumerate() {
                        jacobian[(next, parameter)] =
                            sign * weight * slope * by_variable[parameter] / kept.size;
                    }
                    next += 1;
                }
            }
        }
        Some(jacobian)
    }
}
