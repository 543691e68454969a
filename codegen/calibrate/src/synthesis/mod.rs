//! Chooses parameters for which quantities of a mechanism take the values of a table.
//!
//! Sampled mechanisms are compared with the table in all assembly modes, and the nearest ones are starts of least squares with derived
//! sensitivities. A solution moves over the whole range at all instants that were tried, and keeps the limits there; a check of the
//! solution decides about the instants in between.

mod alignment;
mod distinct;
mod minimum;
mod motion;
mod penalties;
mod problem;
mod starts;
mod targets;

use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;

use linkwright_codegen::stages::model::Dimension;
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::{Instant, Interpreted, Modes, Observable, View};

use crate::Bounds;
use crate::slopes::Slopes;
use minimum::Minimizer;
use motion::MovedQuantities;
use starts::Start;
pub use starts::{MAX_PARAMETERS, StartSampling};
pub use targets::{Target, Targets};

/// Shares of the work that samples and first fits are taken for.
const SAMPLING: f64 = 0.2;
const FITS: f64 = 0.6;

/// Limited measure that the search keeps.
#[derive(Clone, Debug)]
struct KeptLimit {
    /// Index among the mechanism's limits.
    place: usize,
    observable: Observable,
    ends: [Option<f64>; 2],
    /// Size of the measure, in SI units: excess of this size weighs as much as a residual of 1.
    size: f64,
}

/// Search for parameters.
#[derive(Clone, Debug)]
pub struct Synthesis {
    /// Blocks without sensitivities.
    plain: Interpreted,
    moved: MovedQuantities,
    task: Task,
    threads: usize,
}

/// Task of a search.
#[derive(Clone, Debug)]
struct Task {
    targets: Targets,
    names: Vec<String>,
    /// True for each parameter that is an angle.
    are_angles: Vec<bool>,
    bounds: Vec<Bounds>,
    limits: Vec<KeptLimit>,
    /// Times (s) over which the mechanism moves, in equal steps.
    frames: Vec<f64>,
}

/// Parameters with which a mechanism comes nearest to its targets.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// Values in SI units, in the order of [`Synthesis::names`].
    pub values: Vec<f64>,
    /// Assembly modes.
    pub modes: Modes,
    /// Time (s) of each row.
    pub times: Vec<f64>,
    /// Targets minus solved values, column by column and row by row, in SI units.
    pub residuals: Vec<Vec<Option<f64>>>,
    /// Sum of the squared residuals, each in sizes of its column.
    pub squares: f64,
    /// True if the minimizer has converged.
    pub is_converged: bool,
}

/// Reason why a search cannot begin.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unsearchable {
    /// The equations have no order of solution.
    NoOrder,
    /// No parameter is to be chosen.
    NoParameters,
    /// There are more parameters than the sequence of starts has dimensions.
    TooManyParameters(usize),
    /// The dependence of this quantity on parameters is not derived.
    NotDerived(String),
    /// This measure is to be passed at times that are sought, for which its rate is unknown.
    NoRate(String),
}

/// Counts of a search.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SearchCounts {
    /// Number of combinations of assembly modes.
    pub modes: usize,
    /// Number of sampled mechanisms, each in one combination.
    pub sampled: usize,
    /// Number of these that move over the whole range.
    pub moving: usize,
    /// Number of fits.
    pub fitted: usize,
}

impl Synthesis {
    /// Prepares a search. `along` has the sensitivities to the parameters that are chosen, `plain` none; `frames` are the times (s) over which
    /// the mechanism moves, the first of which is that of its assembly.
    ///
    /// # Errors
    /// The reason why the search cannot begin.
    pub fn new(
        plain: &Derived,
        along: &Derived,
        targets: Targets,
        bounds: &[(String, Bounds)],
        frames: Vec<f64>,
        threads: usize,
    ) -> Result<Synthesis, Unsearchable> {
        let plain = Interpreted::new(plain).ok_or(Unsearchable::NoOrder)?;
        let along = Interpreted::new(along).ok_or(Unsearchable::NoOrder)?;
        let slopes = Slopes::new(&along);
        let parameters = &along.system().mechanism.parameters;
        let chosen = || slopes.parameters.iter().map(|it| &parameters[*it]);
        let names: Vec<String> = chosen().map(|it| it.name.clone()).collect();
        if names.is_empty() {
            return Err(Unsearchable::NoParameters);
        }
        if names.len() > MAX_PARAMETERS {
            return Err(Unsearchable::TooManyParameters(names.len()));
        }
        targets.check(along.derived())?;
        let bounds = names.iter().map(|name| {
            let mut named = bounds.iter().filter(|it| it.0 == *name);
            named.next().map_or(Bounds::NONE, |it| it.1)
        });
        let task = Task {
            are_angles: chosen()
                .map(|it| it.dimension == Dimension::Angle)
                .collect(),
            limits: kept_limits(along.derived()),
            bounds: bounds.collect(),
            targets,
            names,
            frames,
        };
        Ok(Synthesis {
            moved: MovedQuantities::new(along, slopes),
            plain,
            task,
            threads: threads.max(1),
        })
    }

    /// Names of the parameters, in the order of the description.
    pub fn names(&self) -> &[String] {
        &self.task.names
    }

    /// Mechanism with the sensitivities to the chosen parameters.
    pub fn view(&self) -> &Interpreted {
        &self.moved.view
    }

    /// Targets.
    pub fn targets(&self) -> &Targets {
        &self.task.targets
    }

    /// Assembles a candidate at the time `t` (s); `None` if that fails.
    pub fn assembled(&self, candidate: &Candidate, t: f64) -> Option<Instant> {
        let shell = self
            .moved
            .assembled(&candidate.values, &candidate.modes, t)?;
        Some(shell.frame().clone())
    }

    /// Returns the best candidates in the order of their squares, of which each differs from the better ones. `reached` receives the share of
    /// the work that is done. As soon as `stop` is true, the search ends with the candidates so far.
    pub fn search(
        &self,
        sampling: StartSampling,
        most: usize,
        stop: &AtomicBool,
        reached: &(dyn Fn(f64) + Sync),
    ) -> (Vec<Candidate>, SearchCounts) {
        let reached_samples = |share| reached(SAMPLING * share);
        let (starts, mut counts) = self.starts(sampling, stop, &reached_samples);
        let task = &self.task;
        let reached_fits = |share| reached(SAMPLING + FITS * share);
        let fits = self.each(&starts, stop, &reached_fits, |start, moved| {
            Minimizer::new(task, moved).first_fit(start)
        });
        counts.fitted = fits.len();
        let fits: Vec<Start> = fits.into_iter().flatten().collect();
        let best = task.distinct(fits, most);
        // An interrupted search brings the best fits so far to their minima.
        let reached_minima = |share| reached(SAMPLING + FITS + (1.0 - SAMPLING - FITS) * share);
        let minima = self.each(
            &best,
            &AtomicBool::new(false),
            &reached_minima,
            |start, moved| Minimizer::new(task, moved).minimum(start),
        );
        let candidates = minima.into_iter().flatten().collect();
        (task.distinct(candidates, most), counts)
    }

    /// Works on all items on all threads, until `stop` is true; returns the results in the order of the items.
    fn each<I: Sync, R: Send>(
        &self,
        items: &[I],
        stop: &AtomicBool,
        reached: &(dyn Fn(f64) + Sync),
        work: impl Fn(&I, &MovedQuantities) -> R + Sync,
    ) -> Vec<R> {
        let results = Mutex::new(Vec::with_capacity(items.len()));
        let next = Mutex::new(items.iter().enumerate());
        let take = |moved: MovedQuantities| {
            while !stop.load(Ordering::Relaxed) {
                let item = next.lock().map_or(None, |mut it| it.next());
                let Some((place, item)) = item else {
                    return;
                };
                let result = work(item, &moved);
                let Ok(mut results) = results.lock() else {
                    return;
                };
                results.push((place, result));
                reached(results.len() as f64 / items.len() as f64);
            }
        };
        thread::scope(|scope| {
            for _ in 0..self.threads.min(items.len()) {
                let moved = self.moved.clone();
                scope.spawn(|| take(moved));
            }
        });
        let mut results: Vec<(usize, R)> = results.into_inner().unwrap_or_default();
        // Threads end in any order.
        results.sort_by_key(|it| it.0);
        results.into_iter().map(|it| it.1).collect()
    }
}

/// Returns the limits of measures whose sensitivities are derived.
fn kept_limits(derived: &Derived) -> Vec<KeptLimit> {
    let mechanism = &derived.system.mechanism;
    let all = Observable::all(derived);
    // Measures are the last columns.
    let measures = &all[all.len() - mechanism.measurements.len()..];
    let limits = mechanism.limits.iter().enumerate();
    let limits = limits.filter_map(|(place, limit)| {
        let observable = measures[limit.measurement].1;
        let is_derived = observable.order(derived) <= 1;
        let ends = limit.ends.iter().flatten();
        let largest = ends.fold(0.0_f64, |largest, end| largest.max(end.abs()));
        is_derived.then_some(KeptLimit {
            place,
            observable,
            ends: limit.ends,
            size: if largest > 0.0 { largest } else { 1.0 },
        })
    });
    limits.collect()
}
