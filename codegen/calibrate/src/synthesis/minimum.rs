//! Minimizes the squared differences from the targets, beginning with one mechanism.
//!
//! Parameters stay strictly within their bounds. Steps to mechanisms that do not move over the whole range are taken back.

use levenberg_marquardt::{LeastSquaresProblem as _, LevenbergMarquardt, TerminationReason};
use linkwright_solver::Observable;

use super::motion::MovedQuantities;
use super::penalties::Penalties;
use super::problem::Problem;
use super::starts::Start;
use super::{Candidate, KeptLimit, Task, targets};

/// Largest number of solutions of the motion per variable, of a first fit and of a last one.
const FIRST_PATIENCE: usize = 25;
const PATIENCE: usize = 100;

/// Largest number of rounds in which limits are kept more closely.
const ROUNDS: usize = 12;

/// Relative excess of a limit in a frame that is left to rounding.
const EXCESS: f64 = 1e-9;

/// Distance from the ends of a limit that solutions keep, in sizes of the measure.
const INSIDE: f64 = 1e-6;

/// Number of times that limits are narrowed by the excess between frames.
const NARROWED: usize = 4;

/// Part of an excess between frames by which a limit is narrowed beyond it.
const BEYOND: f64 = 0.1;

/// Search for the minimum near one start.
pub(super) struct Minimizer<'a> {
    pub task: &'a Task,
    pub moved: &'a MovedQuantities,
    pub observables: Vec<Observable>,
    /// Rates of the observables; `None` if the times of rows are known.
    pub rates: Option<Vec<Observable>>,
    pub limited: Vec<Observable>,
    /// Ends of the limits, narrowed so that the motion keeps them between frames, too.
    pub ends: Vec<[Option<f64>; 2]>,
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
            ends: task.limits.iter().map(narrowed).collect(),
            task,
            moved,
            observables,
            rates,
        }
    }

    /// Returns what a short fit makes of a start, with the penalties of broken limits among its squares; `None` if it cannot be moved.
    pub fn first_fit(&self, start: &Start) -> Option<Start> {
        let penalties = Penalties::new(self.penalty_count());
        let problem = Problem::new(self, start, penalties)?;
        let minimizer = LevenbergMarquardt::new().with_patience(FIRST_PATIENCE);
        let (mut problem, _) = minimizer.minimize(problem);
        // The minimizer may end with a step that is taken back.
        problem.update();
        problem.excesses()?;
        let (values, times) = problem.values();
        Some(Start {
            squares: problem.residuals()?.norm_squared(),
            modes: start.modes.clone(),
            values,
            times,
        })
    }

    /// Number of ends of limits in all frames.
    fn penalty_count(&self) -> usize {
        2 * self.task.frames.len() * self.limited.len()
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
        let mut penalties = Penalties::new(self.penalty_count());
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
            problem.update();
            let excesses = problem.excesses()?;
            if penalties.update(&excesses) <= EXCESS {
                return Some((problem, is_converged));
            }
            problem.penalize(penalties.clone());
        }
        None
    }
}

/// Returns the ends of a limit, narrowed so that rounding and a proof leave it kept.
fn narrowed(limit: &KeptLimit) -> [Option<f64>; 2] {
    let [low, high] = limit.ends;
    let margin = INSIDE * limit.size;
    [low.map(|it| it + margin), high.map(|it| it - margin)]
}
