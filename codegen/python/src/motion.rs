//! Solves the motion of one mechanism over some instants.

use std::io;

use linkwright_page::motion::{Columns, Followed, Wanted};
use linkwright_solver::{Schedule, View};
use numpy::{PyArray1, PyArray2, PyArrayMethods as _, PyReadonlyArray1};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use crate::findings::refused;
use crate::frames::Frames;
use crate::mechanism::Mechanism;

/// Solved motion: columns, values and findings.
#[pyclass(frozen, module = "linkwright._core")]
pub struct Solved {
    /// Name, SI unit, and true for an angle.
    #[pyo3(get)]
    columns: Vec<(String, String, bool)>,
    /// Instants by columns.
    #[pyo3(get)]
    values: Py<PyArray2<f64>>,
    /// Name of the kind of failure, time (s) and block; `None` if the motion is complete.
    #[pyo3(get)]
    failure: Option<(&'static str, f64, Option<u16>)>,
    /// Reason of the failure as a sentence.
    #[pyo3(get)]
    error: Option<String>,
    #[pyo3(get)]
    warnings: Vec<String>,
    /// Largest scaled residual of a position.
    #[pyo3(get)]
    residual: f64,
    /// Reciprocal condition of the dimensionless Φ_q at the start.
    #[pyo3(get)]
    reciprocal_condition: f64,
    /// Numbers of evaluations, steps, implicit steps and rejected steps, and the drift of energy (J); `None` unless simulated.
    #[pyo3(get)]
    simulation: Option<([u64; 4], f64)>,
}

impl Solved {
    /// Returns a followed motion at these times (s).
    pub fn of<V: View>(
        py: Python<'_>,
        motion: Followed<V>,
        frames: &Frames,
        times: &[f64],
    ) -> PyResult<Solved> {
        let columns = Columns::of(&motion).columns;
        let values = PyArray1::from_vec(py, frames.at(times));
        let effort = motion.simulated.as_ref().map(|it| {
            let effort = &it.effort;
            let numbers = [
                effort.evaluations,
                effort.steps,
                effort.implicit,
                effort.rejected,
            ];
            (numbers, it.drift.0)
        });
        Ok(Solved {
            values: values.reshape([times.len(), columns.len()])?.unbind(),
            columns: columns
                .into_iter()
                .map(|it| (it.name, it.unit, it.is_angle))
                .collect(),
            failure: motion.failure.map(|it| (it.kind, it.t, it.block)),
            error: motion.error,
            warnings: motion.warnings,
            residual: motion.residuals.largest.scaled,
            reciprocal_condition: motion.dimensionless_condition.reciprocal,
            simulation: effort,
        })
    }
}

/// Returns the selection of all quantities.
pub fn everything<V: View>(view: &V) -> Wanted {
    let system = view.system();
    Wanted {
        points: (0..system.outputs.len()).collect(),
        coordinates: (0..system.coordinates.len()).collect(),
        monitor: system.mechanism.monitor,
        ..Wanted::default()
    }
}

/// Returns the times that can be solved for.
///
/// # Errors
/// A time is infinite or NaN.
pub fn instants(times: &PyReadonlyArray1<'_, f64>) -> PyResult<Vec<f64>> {
    let times: Vec<f64> = times.as_array().iter().map(|t| t + 0.0).collect();
    match times.iter().position(|it| !it.is_finite()) {
        Some(place) => Err(refused(format!(
            "t[{place}] is {}, not a finite time",
            times[place]
        ))),
        None => Ok(times),
    }
}

/// Plans the way to instants from a start, by steps of at most `step` (s); straight from instant to instant without it.
///
/// # Errors
/// A number cannot be used.
pub fn schedule(start: f64, times: &[f64], step: Option<f64>) -> PyResult<Schedule> {
    let farthest = times.iter().map(|t| (t - start).abs()).fold(0.0, f64::max);
    // A step that leads beyond every instant adds no time.
    let step = step.unwrap_or((2.0 * farthest + 1.0).min(f64::MAX));
    Schedule::instants(start, times, step).map_err(refused)
}

/// Returns the exception of a sink, which is that of a signal.
pub fn ended(error: io::Error) -> PyErr {
    match error.downcast::<PyErr>() {
        Ok(error) => error,
        Err(error) => PyRuntimeError::new_err(error.to_string()),
    }
}

#[pymethods]
impl Mechanism {
    /// Solves the motion at these times (s), from its assembly at `start` on.
    fn solve(
        &self,
        py: Python<'_>,
        times: PyReadonlyArray1<'_, f64>,
        start: f64,
        step: Option<f64>,
    ) -> PyResult<Solved> {
        let times = instants(&times)?;
        let schedule = schedule(start, &times, step)?;
        let view = self.view();
        let chosen = self.chosen(&view, start)?;
        let (motion, frames) = py.detach(move || {
            let selection = everything(&view);
            let mut motion = Followed::new(view, selection, start, chosen);
            let mut frames = Frames::new(Columns::of(&motion));
            let followed = motion.follow(&schedule, &mut [&mut frames], |_| {});
            followed.map(|()| (motion, frames)).map_err(ended)
        })?;
        Solved::of(py, motion, &frames, &times)
    }
}
