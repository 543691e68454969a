//! Takes candidates from minima, and leaves out those that nearly repeat a better one.

use std::f64::consts::TAU;

use linkwright_solver::Modes;

use super::problem::Problem;
use super::starts::Start;
use super::{Candidate, Task};

/// Difference of a parameter, as a share of the width of its bounds, from which on two candidates are distinct.
const DISTINCT: f64 = 1e-3;

/// Difference of a residual, in sizes of its column, that rounding explains.
const ROUNDING: f64 = 1e-9;

impl Task {
    /// Returns the candidate of a minimum; `None` if its rows are not in their order within one range.
    pub(super) fn candidate(&self, problem: &Problem<'_>, is_converged: bool) -> Option<Candidate> {
        let residuals = problem.differences()?;
        let columns = self.targets.columns.iter().zip(&residuals);
        let squares = columns.flat_map(|(column, residuals)| {
            let residuals = residuals.iter().flatten();
            residuals.map(|it| (it / column.size).powi(2))
        });
        let (values, times) = problem.values();
        let mut candidate = Candidate {
            squares: squares.sum(),
            modes: problem.modes().clone(),
            values,
            times,
            residuals,
            is_converged,
        };
        if self.targets.times.is_none() {
            self.bring_into_range(&mut candidate, problem)?;
        }
        Some(candidate)
    }

    /// Brings the times of rows into the range, by whole turns of a closed motion.
    fn bring_into_range(&self, candidate: &mut Candidate, problem: &Problem<'_>) -> Option<()> {
        let times = &mut candidate.times;
        let (from, to) = (*self.frames.first()?, *self.frames.last()?);
        let is_ascending = times.windows(2).all(|it| it[0] < it[1]);
        let is_within_turn = times.last()? - times.first()? <= (1.0 + ROUNDING) * (to - from);
        if !is_ascending || !is_within_turn {
            return None;
        }
        if *times.first()? >= from && *times.last()? <= to {
            return Some(());
        }
        for t in times.iter_mut() {
            *t = from + (*t - from).rem_euclid(to - from);
        }
        let moved = problem.differences_at(times)?;
        let columns = self.targets.columns.iter().zip(&moved);
        let mut columns = columns.zip(&candidate.residuals);
        let is_closed = columns.all(|((column, moved), residuals)| {
            let mut pairs = moved.iter().flatten().zip(residuals.iter().flatten());
            pairs.all(|(a, b)| (a - b).abs() <= ROUNDING * column.size)
        });
        is_closed.then_some(())
    }

    /// Returns the best mechanisms in the order of their squares, of which each differs from all better ones.
    pub(super) fn distinct<M: SearchPoint>(&self, mut all: Vec<M>, most: usize) -> Vec<M> {
        all.sort_by(|a, b| a.squares().total_cmp(&b.squares()));
        let mut kept: Vec<M> = Vec::new();
        for one in all {
            if kept.len() == most {
                break;
            }
            if !kept.iter().any(|it| self.are_alike(it, &one)) {
                kept.push(one);
            }
        }
        kept
    }

    fn are_alike(&self, a: &impl SearchPoint, b: &impl SearchPoint) -> bool {
        let values = a.values().iter().zip(b.values());
        let mut pairs = values.zip(self.bounds.iter().zip(&self.are_angles));
        let are_near = pairs.all(|((a, b), (bounds, is_angle))| {
            let difference = match is_angle {
                true => (a - b) - TAU * ((a - b) / TAU).round(),
                false => a - b,
            };
            difference.abs() <= DISTINCT * (bounds.high - bounds.low)
        });
        are_near && a.modes() == b.modes()
    }
}

/// Mechanism with its distance from the targets.
pub(super) trait SearchPoint {
    /// Sum of the squared differences.
    fn squares(&self) -> f64;

    /// Chosen parameters.
    fn values(&self) -> &[f64];

    /// Assembly modes.
    fn modes(&self) -> &Modes;
}

impl SearchPoint for Candidate {
    fn squares(&self) -> f64 {
        self.squares
    }

    fn values(&self) -> &[f64] {
        &self.values
    }

    fn modes(&self) -> &Modes {
        &self.modes
    }
}

impl SearchPoint for Start {
    fn squares(&self) -> f64 {
        self.squares
    }

    fn values(&self) -> &[f64] {
        &self.values
    }

    fn modes(&self) -> &Modes {
        &self.modes
    }
}
