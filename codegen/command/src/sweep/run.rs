//! Solves the sets of a sweep in chunks, in their order.

use std::io;
use std::sync::mpsc;
use std::thread;

use linkwright::{Blocks as _, Signal, Values as _};
use linkwright_solver::{
    Batch, InputSignals, Interpreted, Modes, Numbers, Observable, Outcome, View as _,
};

use super::sets::Sets;
use super::varied::Place;

/// Number of values of a chunk that are kept at once: 32 MiB.
const CHUNK_VALUES: usize = 1 << 22;

/// Largest number of sets of a chunk.
const CHUNK_SETS: usize = 1 << 13;

/// Sweep that can be solved.
pub struct Sweep<'a> {
    blocks: &'a Interpreted,
    task: Task<'a>,
}

/// Modes and pose in which sets are assembled; `None` for those of the design configuration.
#[derive(Clone, Debug, Default)]
pub struct Start {
    /// Assembly modes.
    pub modes: Option<Modes>,
    /// Pose near which all sets are assembled.
    pub pose: Option<Numbers>,
}

/// Work of a sweep, apart from the mechanism.
struct Task<'a> {
    sets: &'a Sets,
    times: &'a [f64],
    observables: &'a [Observable],
    threads: usize,
    start: Start,
    /// Parameters of the description.
    nominal: Vec<f64>,
    /// Inputs at rest; `None` if none is varied, so that all follow their laws.
    resting: Option<InputSignals>,
    /// Number of sets of a chunk.
    chunk: usize,
}

/// Consecutive sets with their solutions.
#[derive(Default)]
struct Chunk {
    sets: Vec<u64>,
    given: Vec<f64>,
    parameters: Vec<f64>,
    inputs: Vec<InputSignals>,
    values: Vec<f64>,
    outcomes: Vec<Outcome>,
}

/// Set with its solution.
pub struct Solved<'a> {
    /// Index of the set.
    pub set: u64,
    /// Values of what is varied, in the units in which they are given.
    pub given: &'a [f64],
    /// Values of the observables, instant by instant, in SI units.
    pub values: &'a [f64],
    /// Result.
    pub outcome: Outcome,
}

impl<'a> Sweep<'a> {
    /// Prepares a sweep over these instants and quantities, on this number of threads.
    ///
    /// # Errors
    /// The printed message: an input changes with time beside a varied one.
    pub fn new(
        blocks: &'a Interpreted,
        sets: &'a Sets,
        times: &'a [f64],
        observables: &'a [Observable],
        threads: usize,
    ) -> Result<Sweep<'a>, String> {
        let of_set = times.len() * observables.len();
        Ok(Sweep {
            blocks,
            task: Task {
                sets,
                times,
                observables,
                threads,
                start: Start::default(),
                nominal: blocks.nominal_parameters().0,
                resting: resting(blocks, sets, times)?,
                chunk: (CHUNK_VALUES / of_set.max(1)).clamp(1, CHUNK_SETS),
            },
        })
    }

    /// Assembles all sets in these modes, near this pose.
    pub fn started(mut self, start: Start) -> Sweep<'a> {
        self.task.start = start;
        self
    }

    /// Solves the sets from `first` on, and passes them on in their order.
    ///
    /// # Errors
    /// Errors of `take`, which end the sweep.
    pub fn solve(
        &self,
        first: u64,
        take: impl FnMut(Solved<'_>) -> io::Result<()>,
    ) -> io::Result<()> {
        self.solve_all(first..self.task.sets.count(), take)
    }

    /// Solves these sets, and passes them on in their order. With several threads, a chunk is passed on while the next one is solved.
    ///
    /// # Errors
    /// Errors of `take`, which end the sweep.
    pub fn solve_all(
        &self,
        mut sets: impl Iterator<Item = u64> + Send,
        mut take: impl FnMut(Solved<'_>) -> io::Result<()>,
    ) -> io::Result<()> {
        let task = &self.task;
        if task.threads == 1 {
            let (batch, mut chunk) = (task.batch(self.blocks), Chunk::default());
            while task.solve(&batch, &mut sets, &mut chunk)? {
                task.pass_on(&chunk, &mut take)?;
            }
            return Ok(());
        }
        let blocks = self.blocks.clone();
        thread::scope(|scope| {
            let (solved, chunks) = mpsc::sync_channel(1);
            let (passed, spare) = mpsc::channel::<Chunk>();
            scope.spawn(move || {
                let batch = task.batch(&blocks);
                loop {
                    let mut chunk = spare.try_recv().unwrap_or_default();
                    let ended = match task.solve(&batch, &mut sets, &mut chunk) {
                        Ok(false) => return,
                        Ok(true) => solved.send(Ok(chunk)),
                        Err(error) => solved.send(Err(error)),
                    };
                    // The sweep has ended by an error.
                    if ended.is_err() {
                        return;
                    }
                }
            });
            for chunk in chunks {
                let chunk = chunk?;
                task.pass_on(&chunk, &mut take)?;
                // The last chunks are not needed again.
                let _ = passed.send(chunk);
            }
            Ok(())
        })
    }
}

impl Task<'_> {
    fn batch<'b>(&'b self, blocks: &'b Interpreted) -> Batch<'b> {
        Batch {
            threads: self.threads,
            modes: self.start.modes.clone(),
            pose: self.start.pose.clone(),
            ..Batch::new(blocks, self.times, self.observables)
        }
    }

    /// Solves the next sets; returns false if there are none.
    fn solve(
        &self,
        batch: &Batch<'_>,
        sets: &mut impl Iterator<Item = u64>,
        chunk: &mut Chunk,
    ) -> io::Result<bool> {
        let varied = self.sets.varied();
        chunk.sets.clear();
        chunk.given.clear();
        chunk.parameters.clear();
        chunk.inputs.clear();
        chunk.sets.extend(sets.take(self.chunk));
        for (row, set) in chunk.sets.iter().enumerate() {
            self.sets.extend(*set, &mut chunk.given);
            chunk.parameters.extend_from_slice(&self.nominal);
            chunk.inputs.extend(self.resting.clone());
            let first = row * self.nominal.len();
            let of_row = &chunk.given[row * varied.len()..];
            for (varied, value) in varied.iter().zip(of_row) {
                let si = varied.si(*value);
                match varied.place {
                    Place::Parameter(at) => chunk.parameters[first + at] = si,
                    Place::Input(at) => {
                        if let Some(inputs) = chunk.inputs.last_mut() {
                            inputs.set(at, Signal::constant(si));
                        }
                    }
                }
            }
        }
        let of_set = self.times.len() * self.observables.len();
        chunk.values.resize(chunk.sets.len() * of_set, 0.0);
        let outcomes = batch.solve(&chunk.parameters, &chunk.inputs, &mut chunk.values);
        chunk.outcomes = outcomes.map_err(io::Error::other)?;
        Ok(!chunk.sets.is_empty())
    }

    /// Passes the sets of a chunk on in their order.
    fn pass_on(
        &self,
        chunk: &Chunk,
        take: &mut impl FnMut(Solved<'_>) -> io::Result<()>,
    ) -> io::Result<()> {
        let of_set = self.times.len() * self.observables.len();
        let rows = chunk.given.chunks_exact(self.sets.varied().len());
        let solved = chunk.values.chunks_exact(of_set).zip(&chunk.outcomes);
        for ((set, given), (values, outcome)) in chunk.sets.iter().zip(rows).zip(solved) {
            take(Solved {
                set: *set,
                given,
                values,
                outcome: *outcome,
            })?;
        }
        Ok(())
    }
}

/// Returns the inputs at rest, `None` if none is varied.
///
/// # Errors
/// The printed message: an input that is not varied changes with time.
fn resting(
    blocks: &Interpreted,
    sets: &Sets,
    times: &[f64],
) -> Result<Option<InputSignals>, String> {
    let is_varied = |input: usize| {
        let mut varied = sets.varied().iter();
        varied.any(|it| it.place == Place::Input(input))
    };
    let inputs = &blocks.system().mechanism.inputs;
    if !(0..inputs.len()).any(is_varied) {
        return Ok(None);
    }
    let laws = blocks.input_laws();
    let start = laws.at(times[0]);
    for t in times {
        let signals = laws.at(*t);
        for (place, (signal, at_start)) in signals.0.iter().zip(&start.0).enumerate() {
            let resting = Signal::constant(at_start.value);
            if !is_varied(place) && *signal != resting {
                let name = &inputs[place].name;
                return Err(format!(
                    "error: the input `{name}` changes with time, while another input is varied\n  = help: vary `{name}` too, or give it a constant value with `--set {name}=…`"
                ));
            }
        }
    }
    Ok(Some(start))
}

#[cfg(test)]
mod tests {
    use linkwright_codegen::Source;

    use super::*;
    use crate::sweep::{Grid, Range};

    /// A four-bar that some of its couplers do not close.
    const LIFT: &str = "mechanism lift {
        param L3 = 120mm;
        input tilt = 0;
        point A = (0, 0), D = (100mm, 0);
        body crank   at (0, 0, 40deg)       { A: (0, 0), B: (40mm, 0) }
        body coupler at (30mm, 25mm, 20deg) { B: (0, 0), C: (L3, 0) }
        body rocker  at D turned 57deg      { D, C: (80mm, 0) }
        revolute A(ground, crank);
        revolute B(crank, coupler);
        revolute C(coupler, rocker);
        revolute D(ground, rocker);
        drive phi(crank) = 40deg + tilt + 3*t;
    }";

    #[test]
    fn chunks_and_threads_do_not_change_a_bit() {
        let read = linkwright_codegen::read(&Source::new("lift.mech", LIFT)).expect("no errors");
        let derived = &read.motions[0];
        let blocks = Interpreted::new(derived).expect("the equations determine the motion");
        let ranges = ["L3=50mm..150mm:23", "tilt=0..90deg:11"];
        let ranges = ranges.map(|it| Range::read(derived, "--vary", it).expect("a range"));
        let sets = Sets::Grid(Grid::new(ranges.into()).expect("few sets"));
        let observables = [Observable::named(derived, "phi_rocker").expect("a coordinate")];
        let times = [0.0, 0.1, 0.2, 0.3];
        let solved = |threads, chunk| {
            let sweep = Sweep::new(&blocks, &sets, &times, &observables, threads);
            let mut sweep = sweep.expect("no laws");
            sweep.task.chunk = chunk;
            let mut rows: Vec<(u64, Vec<u64>, Outcome)> = Vec::new();
            let ended = sweep.solve(3, |solved| {
                let numbers = solved.given.iter().chain(solved.values);
                rows.push((
                    solved.set,
                    numbers.map(|it| it.to_bits()).collect(),
                    solved.outcome,
                ));
                Ok(())
            });
            ended.expect("no output");
            rows
        };
        let whole = solved(1, 1000);
        assert_eq!(whole.len(), 23 * 11 - 3);
        let failed = whole.iter().filter(|it| it.2.failure.is_some()).count();
        assert!((10..200).contains(&failed), "{failed}");
        // An error of the output ends the sweep, also while the next chunk is solved.
        for threads in [1, 2] {
            let sweep = Sweep::new(&blocks, &sets, &times, &observables, threads);
            let mut sweep = sweep.expect("no laws");
            sweep.task.chunk = 10;
            let ended = sweep.solve(0, |solved| match solved.set {
                25 => Err(io::Error::other("full")),
                _ => Ok(()),
            });
            assert_eq!(ended.expect_err("an error").to_string(), "full");
        }
        for (threads, chunk) in [(1, 1), (2, 7), (3, 64), (2, 130), (4, 1000)] {
            assert!(solved(threads, chunk) == whole, "{threads} {chunk}");
        }
    }
}
