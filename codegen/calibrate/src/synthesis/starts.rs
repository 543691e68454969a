//! Samples mechanisms in all assembly modes, and selects starts of fits among those that move over the whole range.

use std::sync::atomic::{AtomicBool, Ordering};

use linkwright::Blocks as _;
use linkwright_solver::comparison::difference;
use linkwright_solver::sets::Sobol;
use linkwright_solver::{Batch, Modes};

use super::alignment::aligned;
use super::{SearchCounts, Synthesis};

/// Largest number of chosen parameters: dimensions of Sobol's sequence.
pub const MAX_PARAMETERS: usize = linkwright_solver::sets::MAX_DIMENSIONS;

/// Largest number of loops of which both modes are tried.
const MAX_LOOPS: usize = 6;

/// Number of mechanisms that are solved at once.
const CHUNK: usize = 1024;

/// Distance of samples from the bounds, as a share of their width: at a bound, a variable has no slope.
const MARGIN: f64 = 1e-3;

/// Relative difference below which the first and the last pose are the same.
const CLOSING: f64 = 1e-9;

/// Numbers of sampled and of fitted mechanisms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StartSampling {
    /// Number of sampled mechanisms.
    pub count: u32,
    /// Number of these from which a fit begins.
    pub fits: usize,
    /// Seed of the sequence.
    pub seed: u64,
}

/// Start of a fit.
#[derive(Clone, Debug)]
pub(super) struct Start {
    pub values: Vec<f64>,
    pub modes: Modes,
    /// Time (s) of each row.
    pub times: Vec<f64>,
    /// Sum of the squared differences, each in sizes of its column.
    pub squares: f64,
}

impl Synthesis {
    /// Returns the starts: half of them with the smallest squares, the others evenly from the remaining ones.
    pub(super) fn starts(
        &self,
        sampling: StartSampling,
        stop: &AtomicBool,
        reached: &dyn Fn(f64),
    ) -> (Vec<Start>, SearchCounts) {
        let all_modes = self.all_modes();
        let mut counts = SearchCounts {
            modes: all_modes.len(),
            ..SearchCounts::default()
        };
        let Some(sobol) = Sobol::new(self.task.names.len(), Some(sampling.seed)) else {
            return (Vec::new(), counts);
        };
        let mut starts: Vec<Start> = Vec::new();
        for first in (0..sampling.count).step_by(CHUNK) {
            if stop.load(Ordering::Relaxed) {
                break;
            }
            let indices = first..sampling.count.min(first + CHUNK as u32);
            for (place, modes) in all_modes.iter().enumerate() {
                let indices = indices.clone();
                let of_mode = indices.filter(|it| *it as usize % all_modes.len() == place);
                let values: Vec<Vec<f64>> = of_mode.map(|it| self.sampled(&sobol, it)).collect();
                starts.extend(self.moving(&values, modes));
            }
            counts.sampled = indices.end as usize;
            reached(f64::from(indices.end) / f64::from(sampling.count));
        }
        counts.moving = starts.len();
        starts.sort_by(|a, b| a.squares.total_cmp(&b.squares));
        let best = sampling.fits.div_ceil(2).min(starts.len());
        let others = starts.split_off(best);
        let spread = (sampling.fits - best).min(others.len());
        starts.extend((0..spread).map(|it| others[it * others.len() / spread].clone()));
        (starts, counts)
    }

    /// Returns all combinations of modes of the first loops in closed form; the others have those of the design configuration.
    fn all_modes(&self) -> Vec<Modes> {
        let drawn = self.plain.drawn_branches();
        let loops = drawn.closed.len().min(MAX_LOOPS);
        let combinations = (0..1_usize << loops).map(|choice| {
            let mut modes = drawn.clone();
            for (place, branch) in modes.closed.iter_mut().take(loops).enumerate() {
                if choice >> place & 1 == 1 {
                    *branch = branch.opposite();
                }
            }
            modes
        });
        combinations.collect()
    }

    /// Returns the parameters of a sample, strictly within their bounds.
    fn sampled(&self, sobol: &Sobol, index: u32) -> Vec<f64> {
        let bounds = self.task.bounds.iter().enumerate();
        let values = bounds.map(|(dimension, it)| {
            let margin = MARGIN * (it.high - it.low);
            sobol.within(index, dimension, [it.low + margin, it.high - margin])
        });
        values.collect()
    }

    /// Solves mechanisms with these parameters; returns those that move through all rows and frames.
    fn moving(&self, values: &[Vec<f64>], modes: &Modes) -> Vec<Start> {
        let rows = self.task.targets.times.as_deref().unwrap_or(&[]);
        let mut times = [rows, &self.task.frames[..]].concat();
        times.sort_by(f64::total_cmp);
        times.dedup();
        let observables = self.task.targets.observables();
        let mut batch = Batch::new(&self.plain, &times, &observables);
        batch.modes = Some(modes.clone());
        batch.threads = self.threads;
        let parameters = values.iter().flat_map(|it| self.moved.parameters(it).0);
        let parameters: Vec<f64> = parameters.collect();
        let of_set = times.len() * observables.len();
        let mut solved = vec![f64::NAN; values.len() * of_set];
        let outcomes = batch.solve(&parameters, &[], &mut solved);
        let sets = outcomes.unwrap_or_default().into_iter().zip(values);
        let sets = sets.zip(solved.chunks_exact(of_set.max(1)));
        let starts = sets.filter_map(|((outcome, values), solved)| {
            if outcome.failure.is_some() {
                return None;
            }
            let (squares, times) = self.compared(&times, solved)?;
            squares.is_finite().then(|| Start {
                values: values.clone(),
                modes: modes.clone(),
                times,
                squares,
            })
        });
        starts.collect()
    }

    /// Returns the sum of squares of a mechanism that is solved at these times, and the times of its rows.
    fn compared(&self, times: &[f64], solved: &[f64]) -> Option<(f64, Vec<f64>)> {
        let columns = &self.task.targets.columns;
        let cost = |row: usize, place: usize| {
            let values = &solved[place * columns.len()..][..columns.len()];
            let squares = columns.iter().zip(values).filter_map(|(column, value)| {
                let residual = difference(column.values[row]?, *value, column.is_angle);
                Some((residual / column.size).powi(2))
            });
            squares.sum::<f64>()
        };
        if let Some(rows) = &self.task.targets.times {
            let places = rows.iter().map(|t| times.partition_point(|it| it < t));
            let squares = places.enumerate().map(|(row, place)| cost(row, place));
            return Some((squares.sum(), rows.clone()));
        }
        let count = times.len();
        let ends = [0, count - 1].map(|it| &solved[it * columns.len()..][..columns.len()]);
        let mut ends = columns.iter().zip(ends[0]).zip(ends[1]);
        let is_closed = ends.all(|((column, first), last)| {
            difference(*first, *last, column.is_angle).abs()
                <= CLOSING * column.size.max(first.abs())
        });
        let instants = if is_closed { count - 1 } else { count };
        let costs =
            (0..self.task.targets.rows).map(|row| (0..instants).map(|it| cost(row, it)).collect());
        let costs: Vec<Vec<f64>> = costs.collect();
        let (squares, places) = aligned(&costs, is_closed)?;
        let turn = times[count - 1] - times[0];
        let time = |place: usize| times[place % instants] + (place / instants) as f64 * turn;
        Some((squares, places.into_iter().map(time).collect()))
    }
}
