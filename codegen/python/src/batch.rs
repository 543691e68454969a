//! Solves many sets of parameters and inputs in lanes and threads.

use linkwright::Signal;
use linkwright_solver::{Batch, InputSignals, Modes, Numbers, Observable, Outcome};
use numpy::{PyArray1, PyArray3, PyArrayMethods as _, PyReadonlyArray1, PyReadonlyArray2};
use numpy::{PyReadonlyArray4, PyUntypedArrayMethods as _};
use pyo3::prelude::*;

use crate::findings::refused;
use crate::mechanism::Mechanism;
use crate::motion::instants;

/// Frames after which signals are looked at and progress is reported.
const FRAMES: usize = 1 << 21;

/// Smallest number of sets for each thread between such looks.
const SETS: usize = 64;

/// Results of a batch: values by set, instant and quantity, and of each set the number of solved instants, the index of the name of its
/// failure, its time (s) and its block; and the names of failures, of which the first is empty.
type Solved<'py> = (
    Bound<'py, PyArray3<f64>>,
    Bound<'py, PyArray1<i64>>,
    Bound<'py, PyArray1<u8>>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<i64>>,
    Vec<&'static str>,
);

/// Number of threads, and a function that receives the number of completed sets.
#[derive(FromPyObject)]
pub struct Work(usize, Option<Py<PyAny>>);

#[pymethods]
impl Mechanism {
    /// Names of the quantities of a batch, with their SI units, and true for an angle.
    #[getter]
    fn quantities(&self) -> Vec<(String, String, bool)> {
        let linkwright_codegen::Derived { pool, system } = &self.derived;
        let all = linkwright_solver::observable::all(pool, system).into_iter();
        all.map(|it| {
            let is_angle = it.observable.is_angle(system);
            (it.name, it.unit, is_angle)
        })
        .collect()
    }

    /// Solves all sets at these times (s), each from its assembly at the first time on. `parameters` is sets by parameters, `inputs` is
    /// sets by 1 or by instants, by inputs, by value, rate and acceleration.
    fn solve_sets<'py>(
        &self,
        py: Python<'py>,
        parameters: PyReadonlyArray2<'py, f64>,
        inputs: Option<PyReadonlyArray4<'py, f64>>,
        times: PyReadonlyArray1<'py, f64>,
        names: Vec<String>,
        work: Work,
    ) -> PyResult<Solved<'py>> {
        let Work(threads, progress) = work;
        let times = instants(&times)?;
        let view = self.view();
        let observables = self.named(&names)?;
        let sets = parameters.shape()[0];
        let of_set = times.len() * observables.len();
        let parameter_count = parameters.shape()[1];
        let parameters: Vec<f64> = parameters.as_array().iter().copied().collect();
        let (signals, signals_of_set) = match &inputs {
            Some(inputs) => signals(inputs),
            None => (Vec::new(), 0),
        };
        let chosen = match times.first() {
            Some(first) => self.chosen(&view, *first)?,
            None => None,
        };
        let (pose, modes): (Option<Numbers>, Option<Modes>) = match chosen {
            Some((instant, modes)) => (Some(Numbers(instant.q().to_vec())), Some(modes)),
            None => (None, None),
        };
        let values = PyArray1::<f64>::zeros(py, sets * of_set, false);
        let mut outcomes: Vec<Outcome> = Vec::with_capacity(sets);
        {
            let mut writable = values.readwrite();
            let values = writable.as_slice_mut()?;
            py.detach(|| -> PyResult<()> {
                let view = view;
                let batch = Batch {
                    pose,
                    modes,
                    threads,
                    ..Batch::new(&view, &times, &observables)
                };
                let least = SETS * threads;
                let piece = (FRAMES / times.len().max(1))
                    .max(least)
                    .next_multiple_of(least);
                for first in (0..sets).step_by(piece) {
                    let count = piece.min(sets - first);
                    let parameters =
                        &parameters[first * parameter_count..][..count * parameter_count];
                    let signals = &signals[first * signals_of_set..][..count * signals_of_set];
                    let values = &mut values[first * of_set..][..count * of_set];
                    let solved = batch.solve(parameters, signals, values);
                    outcomes.extend(solved.map_err(|error| refused(error.to_string()))?);
                    Python::attach(|py| {
                        py.check_signals()?;
                        match &progress {
                            Some(progress) => progress.call1(py, (first + count,)).map(|_| ()),
                            None => Ok(()),
                        }
                    })?;
                }
                Ok(())
            })?;
        }
        // Without values there is nothing to solve.
        outcomes.resize(sets, Outcome::default());
        let failure = |it: &Outcome| {
            it.failure
                .map_or((f64::NAN, -1), |it| (it.time, i64::from(it.block)))
        };
        let (ends, blocks): (Vec<f64>, Vec<i64>) = outcomes.iter().map(failure).unzip();
        let mut names = vec![""];
        let kinds = outcomes.iter().map(|it| {
            let name = it.failure.map_or("", |it| it.kind.name());
            let place = names.iter().position(|it| *it == name);
            // There are fewer kinds than numbers of a byte.
            place.unwrap_or_else(|| {
                names.push(name);
                names.len() - 1
            }) as u8
        });
        let kinds: Vec<u8> = kinds.collect();
        let solved = outcomes.iter().map(|it| it.solved as i64);
        Ok((
            values.reshape([sets, times.len(), observables.len()])?,
            PyArray1::from_vec(py, solved.collect()),
            PyArray1::from_vec(py, kinds),
            PyArray1::from_vec(py, ends),
            PyArray1::from_vec(py, blocks),
            names,
        ))
    }
}

impl Mechanism {
    /// Returns the quantities of these names.
    ///
    /// # Errors
    /// The first unknown name.
    pub fn named(&self, names: &[String]) -> PyResult<Vec<Observable>> {
        let named = names.iter().map(|name| {
            let known = Observable::named(&self.derived, name);
            known.ok_or_else(|| refused(format!("no quantity is named `{name}`")))
        });
        named.collect()
    }
}

/// Returns the inputs of all sets, and the number of them for each set.
fn signals(inputs: &PyReadonlyArray4<'_, f64>) -> (Vec<InputSignals>, usize) {
    let inputs = inputs.as_array();
    let signals = inputs.outer_iter().flat_map(|set| {
        let instants = set.outer_iter().map(|instant| {
            let signals = instant
                .outer_iter()
                .map(|it| Signal::new(it[0], it[1], it[2]));
            InputSignals(signals.collect())
        });
        instants.collect::<Vec<_>>()
    });
    (signals.collect(), inputs.shape()[1])
}
