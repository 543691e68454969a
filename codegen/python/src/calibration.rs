//! Fits parameters to measured values, and compares a motion with them.

use linkwright_calibrate::{Bounds, Calibrator, Column, Measurements, Unfit};
use linkwright_solver::comparison::difference;
use linkwright_solver::observable::{Named, all, guess};
use linkwright_solver::{Comparison, View as _};
use numpy::PyReadonlyArray1;
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::findings::refused;
use crate::mechanism::Mechanism;
use crate::motion::instants;

/// Measured quantity: its name, values in SI units (NaN if missing), and the standard deviation of one value.
type Measured<'py> = (String, PyReadonlyArray1<'py, f64>, Option<f64>);

/// Differences of a column: number of values, root mean square, largest difference and its time (s).
type Compared = (usize, f64, f64, f64);

#[pymethods]
impl Mechanism {
    /// Returns the quantity that a name of a column means, and its alternatives in words; `None` without a unique guess.
    fn quantity_of(&self, name: &str) -> Option<(String, String)> {
        let linkwright_codegen::Derived { pool, system } = &self.derived;
        let all = all(pool, system);
        let exact = all.iter().find(|it| it.name == name);
        if let Some(exact) = exact {
            return Some((exact.name.clone(), String::new()));
        }
        let guess = guess(system, &all, name)?;
        Some((all[guess.place].name.clone(), guess.doubt))
    }

    /// Compares measured with solved values of a quantity; `None` without a pair. NaN stands for a missing value.
    fn differences(
        &self,
        name: &str,
        times: PyReadonlyArray1<'_, f64>,
        measured: PyReadonlyArray1<'_, f64>,
        solved: PyReadonlyArray1<'_, f64>,
    ) -> PyResult<Option<Compared>> {
        let observable = self.named(&[name.to_string()])?[0];
        let is_angle = observable.is_angle(&self.derived.system);
        let (times, measured, solved) = (times.as_array(), measured.as_array(), solved.as_array());
        let rows = times.iter().zip(measured.iter().zip(&solved));
        let pairs =
            rows.filter(|(_, (measured, solved))| measured.is_finite() && solved.is_finite());
        let differences =
            pairs.map(|(t, (measured, solved))| (*t, difference(*measured, *solved, is_angle)));
        let compared = Comparison::of(differences);
        Ok(compared.map(|it| (it.count, it.rms, it.largest, it.at)))
    }

    /// Fits the parameters by which this mechanism is differentiated. `bounds` are by name; `step` is the largest time between frames (s).
    fn fit<'py>(
        &self,
        py: Python<'py>,
        times: PyReadonlyArray1<'py, f64>,
        measured: Vec<Measured<'py>>,
        bounds: Vec<(String, f64, f64)>,
        step: f64,
    ) -> PyResult<Bound<'py, PyDict>> {
        let times = instants(&times)?;
        if times.windows(2).any(|it| it[1] < it[0]) {
            return Err(refused("the times of the measured values decrease"));
        }
        let linkwright_codegen::Derived { pool, system } = &self.derived;
        let all = all(pool, system);
        let mut kinds: Vec<[i32; 4]> = Vec::new();
        let mut columns = Vec::with_capacity(measured.len());
        for (name, values, deviation) in &measured {
            let quantity = all.iter().find(|it| it.name == *name);
            let Named {
                observable, powers, ..
            } = quantity.ok_or_else(|| refused(format!("no quantity is named `{name}`")))?;
            if Calibrator::can_fit(*observable).is_err() {
                return Err(refused(format!(
                    "accelerations and forces such as `{name}` cannot be fitted"
                )));
            }
            let group = kinds.iter().position(|it| it == powers).unwrap_or_else(|| {
                kinds.push(*powers);
                kinds.len() - 1
            });
            let values = values.as_array();
            if values.len() != times.len() {
                return Err(refused(format!(
                    "`{name}` has {} values at {} times",
                    values.len(),
                    times.len()
                )));
            }
            columns.push(Column {
                observable: *observable,
                values: values
                    .iter()
                    .map(|it| Some(*it).filter(|it| it.is_finite()))
                    .collect(),
                deviation: *deviation,
                rounding: None,
                group,
            });
        }
        let measurements = Measurements {
            times: times.clone(),
            columns,
        };
        let mut calibrator = Calibrator::of(self.view(), step);
        if let Some(first) = times.first()
            && let Some((_, modes)) = self.chosen(calibrator.view(), *first)?
        {
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
