//! Compares a motion with measured values, and fits parameters to them.

use linkwright_calibrate::{Bounds, Calibrator, Measurements, Unfit, leave_out_underived};
use linkwright_codegen::Diagnostics;
use linkwright_page::motion::{Followed, Wanted};
use linkwright_solver::data::Data;
use linkwright_solver::opened::solvable;
use linkwright_solver::{Interpreted, Schedule, View as _};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::findings::{refused, unopened};
use crate::interrupt::Interrupt;
use crate::mechanism::Mechanism;
use crate::motion::ended;
use crate::table::{Notes, Table};

/// Compared column: its name and quantity, and number of values, root mean square, largest difference and its time (s); `None` if no row
/// has both values.
type Column = (String, String, Option<(usize, f64, f64, f64)>);

/// Compared columns, reason of an early end with its warnings, and notes on the table.
type Comparison = (Vec<Column>, Option<String>, Vec<String>, Notes);

impl Mechanism {
    /// Returns the solution with inputs that follow their columns.
    fn driven(&self, py: Python<'_>, data: &Data) -> PyResult<Interpreted> {
        if data.inputs.is_empty() {
            return Ok(self.view());
        }
        let derived = data.drive(self.derived.clone()).map_err(refused)?;
        // Warnings of the description were given when it was opened.
        let driven = solvable(&derived, &mut Diagnostics::new());
        driven.map_err(|reason| unopened(py, &reason, &self.source))
    }
}

#[pymethods]
impl Mechanism {
    /// Compares the columns of a table with the motion, assembled at `start` (s; `None` for the first time of the table). `step` is the
    /// largest time between frames (s).
    fn compare(
        &self,
        py: Python<'_>,
        table: Table,
        start: Option<f64>,
        step: f64,
    ) -> PyResult<Comparison> {
        let data = table.read(&self.derived)?;
        let view = self.driven(py, &data)?;
        let start = start.unwrap_or(data.times[0]);
        let schedule = Schedule::instants(start, &data.times, step).map_err(refused)?;
        let chosen = self.chosen(&view, start)?;
        let selection = Wanted::default();
        py.detach(move || {
            let mut motion = Followed::new(view, selection, start, chosen);
            let mut interrupt = Interrupt::new();
            let compared = motion.compare(&data, &schedule, &mut [&mut interrupt], |_| {});
            let columns = compared.map_err(ended)?.into_iter().zip(&data.measured);
            let columns = columns.map(|(compared, measured)| {
                let comparison = compared.comparison;
                let numbers = comparison.map(|it| (it.count, it.rms, it.largest, it.at));
                (
                    measured.name.clone(),
                    measured.quantity.name.clone(),
                    numbers,
                )
            });
            Ok((
                columns.collect(),
                motion.error,
                motion.warnings,
                Notes::of(&data),
            ))
        })
    }

    /// Fits the parameters by which this mechanism is differentiated to the columns of a table. `deviations` are those of the command,
    /// `bounds` are by name, and `step` is the largest time between frames (s).
    fn calibrate<'py>(
        &self,
        py: Python<'py>,
        table: Table,
        deviations: Vec<String>,
        bounds: Vec<(String, f64, f64)>,
        step: f64,
    ) -> PyResult<Bound<'py, PyDict>> {
        let mut data = table.read(&self.derived)?;
        let view = self.driven(py, &data)?;
        leave_out_underived(&mut data, &self.derived).map_err(refused)?;
        let measurements = Measurements::of(&data, "deviations", &deviations).map_err(refused)?;
        let notes = Notes::of(&data);
        let mut calibrator = Calibrator::of(view, step);
        if let Some((_, modes)) = self.chosen(calibrator.view(), data.times[0])? {
            calibrator = calibrator.in_modes(modes);
        }
        for (name, low, high) in bounds {
            let place = calibrator.names().iter().position(|it| *it == name);
            let place = place.ok_or_else(|| refused(format!("`{name}` is not fitted")))?;
            calibrator = calibrator.within(place, Bounds { low, high });
        }
        let title = calibrator.view().system().mechanism.title();
        let names = calibrator.names().to_vec();
        let fit = py.detach(move || calibrator.fit(&measurements, &calibrator.nominal()));
        let fit = fit.map_err(|unfit| unfitted(&unfit, &title))?;
        let result = PyDict::new(py);
        result.set_item("columns", names_of(&data))?;
        result.set_item("notes", notes)?;
        result.set_item("names", names)?;
        result.set_item("values", &fit.values)?;
        result.set_item("deviations", &fit.deviations)?;
        result.set_item("intervals", &fit.intervals)?;
        result.set_item("at_bound", &fit.at_bound)?;
        result.set_item("correlations", &fit.correlations)?;
        result.set_item("is_trusted", fit.is_trusted())?;
        result.set_item("freedom", fit.freedom)?;
        result.set_item("evaluations", fit.evaluations)?;
        result.set_item("column_deviations", &fit.column_deviations)?;
        let [_, after] = &fit.residuals;
        let missing = |it: &Option<f64>| it.unwrap_or(f64::NAN);
        let residuals: Vec<Vec<f64>> = after
            .iter()
            .map(|it| it.iter().map(missing).collect())
            .collect();
        result.set_item("residuals", residuals)?;
        result.set_item("undetermined", fit.identified.sentences())?;
        Ok(result)
    }
}

/// Names of the measured columns.
fn names_of(data: &Data) -> Vec<&str> {
    data.measured.iter().map(|it| it.name.as_str()).collect()
}

fn unfitted(unfit: &Unfit, title: &str) -> PyErr {
    match unfit {
        Unfit::Unsolved(why) => PyRuntimeError::new_err(format!("`{title}` {why}")),
        Unfit::TooFew(values, parameters) => PyValueError::new_err(format!(
            "{values} measured values are too few for {parameters} parameters"
        )),
        Unfit::NoParameters => PyValueError::new_err("no parameter is selected for the fit"),
        Unfit::OutsideBounds(name) => PyValueError::new_err(format!(
            "`{name}` does not begin strictly within its bounds"
        )),
        Unfit::NotConverged => PyRuntimeError::new_err("the fit does not converge"),
    }
}
