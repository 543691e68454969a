//! Solves the motion of many sets of parameters and inputs, sixteen at once and on several threads.
//!
//! The result of a set has the bits of a [`Shell`](linkwright::Shell) of its own: it depends neither on other sets nor on the number of
//! threads.

mod columns;
mod worker;

use std::fmt::{self, Display, Formatter};
use std::sync::Mutex;
use std::thread;

use linkwright::{Blocks, Failure, Settings, Values};

use crate::interpreted::Interpreted;
use crate::observable::Observable;
use crate::supplied::{InputSignals, Modes, Pose};
use crate::view::View;
use worker::{Piece, Worker};

/// Number of sets that a thread takes at once.
const PIECE: usize = 64;

/// Instants and quantities that are computed for each set of parameters and inputs.
///
/// ```
/// use linkwright_codegen::Source;
/// use linkwright_solver::{Batch, Interpreted, Observable};
///
/// let text = "
///     mechanism slider {
///         param rod = 0.5;
///         point O = (0, 0);
///         body crank at O { O, A: (0.2, 0) }
///         body link at (0.2, 0, 0) { A: (0, 0), B: (rod, 0) }
///         body ram at (0.7, 0, 0) { B: (0, 0) }
///         revolute O(ground, crank);
///         revolute A(crank, link);
///         revolute B(link, ram);
///         absolute_y(ram) = 0;
///         absolute_angle(ram) = 0;
///         drive phi(crank) = 2*t;
///     }";
/// let read = linkwright_codegen::read(&Source::new("slider.mech", text)).expect("no errors");
/// let blocks = Interpreted::new(&read.motions[0]).expect("the equations determine the motion");
///
/// let observables = [Observable::named(&read.motions[0], "x_ram").expect("a coordinate")];
/// let mut batch = Batch::new(&blocks, &[0.0, 0.1], &observables);
/// batch.threads = 1;
/// let mut places = [0.0; 6];
/// let outcomes = batch.solve(&[0.4, 0.5, 0.6], &[], &mut places)?;
/// assert!(outcomes.iter().all(|it| it.failure.is_none()));
/// // Set by set, instant by instant; the ram starts at the sum of crank and rod.
/// assert_eq!([places[0], places[4]], [0.2 + 0.4, 0.2 + 0.6]);
/// # Ok::<(), linkwright_solver::WrongLength>(())
/// ```
#[derive(Clone, Debug)]
pub struct Batch<'a> {
    /// Mechanism.
    pub blocks: &'a Interpreted,
    /// Times (s) in the order in which they are visited. Each set is assembled at the first one.
    pub times: &'a [f64],
    /// Quantities of each instant.
    pub observables: &'a [Observable],
    /// True if a set follows its path from instant to instant, and ends where the path does. False if each instant is solved by itself in the
    /// modes of the first one.
    pub follows_path: bool,
    /// Assembly modes of all sets; `None` for those of the design configuration.
    pub modes: Option<Modes>,
    /// Pose near which all sets are assembled; `None` for the design configuration of each set.
    pub pose: Option<Pose>,
    /// Number of threads, at least 1.
    pub threads: usize,
    /// Settings of Newton-Raphson and of steps.
    pub settings: Settings,
}

/// Result of a set.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outcome {
    /// Number of solved instants.
    pub solved: usize,
    /// First failure; `None` if all instants are solved.
    pub failure: Option<Failure>,
}

/// Slice whose length does not belong to the sets of a batch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WrongLength {
    /// Values: expected a multiple of the number of values of a set.
    Values {
        /// Number of values of a set: instants times observables.
        of_set: usize,
        /// Length of the slice.
        found: usize,
    },
    /// Parameters: expected those of all sets, one after another.
    Parameters {
        /// Expected length.
        expected: usize,
        /// Length of the slice.
        found: usize,
    },
    /// Inputs: expected none, those of each set, or those of each set at each instant.
    Inputs {
        /// Number of sets.
        sets: usize,
        /// Number of instants.
        instants: usize,
        /// Length of the slice.
        found: usize,
    },
}

impl Batch<'_> {
    /// Returns a batch that follows paths with default settings, on all threads of the machine.
    pub fn new<'a>(
        blocks: &'a Interpreted,
        times: &'a [f64],
        observables: &'a [Observable],
    ) -> Batch<'a> {
        Batch {
            blocks,
            times,
            observables,
            follows_path: true,
            modes: None,
            pose: None,
            threads: thread::available_parallelism().map_or(1, usize::from),
            settings: Settings::default(),
        }
    }

    /// Solves all sets; overwrites `values` by set, then by instant, then by observable, in SI units (m, rad, s). Values of instants without a
    /// solution are NaN. What no observable needs is not computed, so a set does not fail where only that is infinite.
    ///
    /// `parameters` holds the parameters of each set in the order of the description, one set after another. `inputs` holds the inputs of each
    /// set, which stay as they are, or those of each set at each instant, set by set; if it is empty, inputs follow the laws of the description.
    ///
    /// # Errors
    /// Returns [`WrongLength`] if a slice does not have the length that belongs to the number of sets; nothing is computed then.
    pub fn solve(
        &self,
        parameters: &[f64],
        inputs: &[InputSignals],
        values: &mut [f64],
    ) -> Result<Vec<Outcome>, WrongLength> {
        let count = self.sets(parameters, inputs, values)?;
        let of_set = self.times.len() * self.observables.len();
        let laws = self.blocks.input_laws();
        let supplied = Supplied {
            parameters,
            parameter_count: self.blocks.nominal_parameters().count(),
            inputs,
            inputs_of_set: inputs.len() / count.max(1),
            laws: match inputs.is_empty() {
                true => self.times.iter().map(|&t| laws.at(t)).collect(),
                false => Vec::new(),
            },
        };
        let mut outcomes = vec![Outcome::default(); count];
        let values = values.chunks_mut((PIECE * of_set).max(1));
        let pieces = outcomes.chunks_mut(PIECE).zip(values).enumerate();
        let pieces = Mutex::new(pieces);
        let next = || pieces.lock().map_or(None, |mut pieces| pieces.next());
        let threads = self.threads.clamp(1, count.div_ceil(PIECE).max(1));
        let task = Task {
            times: self.times,
            observables: self.observables,
            follows_path: self.follows_path,
            modes: self.modes.as_ref(),
            pose: self.pose.as_ref(),
            settings: self.settings,
        };
        let blocks = self.blocks.limited_to(self.observables);
        let workers = (0..threads).map(|_| Worker::new(task, blocks.clone()));
        let work = |mut worker: Worker<'_>| {
            while let Some((piece, (outcomes, values))) = next() {
                worker.solve(Piece {
                    first: piece * PIECE,
                    supplied: &supplied,
                    outcomes,
                    values,
                });
            }
        };
        thread::scope(|scope| {
            let mut workers: Vec<Worker<'_>> = workers.collect();
            let last = workers.pop();
            for worker in workers {
                scope.spawn(|| work(worker));
            }
            last.into_iter().for_each(work);
        });
        Ok(outcomes)
    }

    /// Returns the number of sets.
    fn sets(
        &self,
        parameters: &[f64],
        inputs: &[InputSignals],
        values: &[f64],
    ) -> Result<usize, WrongLength> {
        let of_set = self.times.len() * self.observables.len();
        let length = values.len();
        if of_set == 0 || !length.is_multiple_of(of_set) {
            return match length {
                0 => Ok(0),
                found => Err(WrongLength::Values { of_set, found }),
            };
        }
        let count = length / of_set;
        let expected = count * self.blocks.nominal_parameters().count();
        if parameters.len() != expected {
            return Err(WrongLength::Parameters {
                expected,
                found: parameters.len(),
            });
        }
        let instants = self.times.len();
        if ![0, count, count * instants].contains(&inputs.len()) {
            return Err(WrongLength::Inputs {
                sets: count,
                instants,
                found: inputs.len(),
            });
        }
        Ok(count)
    }
}

/// Work that is done for each set.
#[derive(Clone, Copy)]
struct Task<'a> {
    times: &'a [f64],
    observables: &'a [Observable],
    follows_path: bool,
    modes: Option<&'a Modes>,
    pose: Option<&'a Pose>,
    settings: Settings,
}

/// Parameters and inputs of all sets.
struct Supplied<'a> {
    parameters: &'a [f64],
    parameter_count: usize,
    /// Inputs by set, or by set and instant; empty if they follow their laws.
    inputs: &'a [InputSignals],
    /// Number of inputs of a set: 0, 1, or one per instant.
    inputs_of_set: usize,
    /// Inputs by instant; empty if each set has its own.
    laws: Vec<InputSignals>,
}

impl Supplied<'_> {
    fn parameters(&self, set: usize) -> &[f64] {
        &self.parameters[set * self.parameter_count..][..self.parameter_count]
    }

    fn inputs(&self, set: usize, instant: usize) -> &InputSignals {
        match self.inputs_of_set {
            0 => &self.laws[instant],
            1 => &self.inputs[set],
            count => &self.inputs[set * count + instant],
        }
    }
}

impl Display for WrongLength {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            WrongLength::Values { of_set, found } => {
                write!(f, "expected a multiple of {of_set} values, found {found}")
            }
            WrongLength::Parameters { expected, found } => {
                write!(f, "expected {expected} parameters, found {found}")
            }
            WrongLength::Inputs {
                sets,
                instants,
                found,
            } => {
                write!(
                    f,
                    "expected inputs of {sets} sets, of {sets} sets at {instants} instants each, or none, found {found}"
                )
            }
        }
    }
}

impl std::error::Error for WrongLength {}
