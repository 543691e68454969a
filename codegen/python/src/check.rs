//! Checks a mechanism: assemblies, singular poses, and the proof of a motion.

use linkwright_page::{check_json, check_text};
use linkwright_solver::assemblies::assemblies;
use linkwright_solver::{Check, Schedule};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use crate::findings::refused;
use crate::mechanism::Mechanism;

/// Width of tables in characters.
const WIDTH: usize = 100;

#[pymethods]
impl Mechanism {
    /// Checks the motion between two times (s), and returns the results as JSON and as text.
    fn check(
        &self,
        py: Python<'_>,
        from: f64,
        to: f64,
        step: f64,
        prove: bool,
    ) -> PyResult<(String, String)> {
        let view = self.view();
        let schedule = Schedule::whole(from, to, step).map_err(refused)?;
        py.detach(move || {
            let check = Check::new(view, &schedule, |_| {});
            let proof = prove.then(|| check.prove(&schedule, &[]));
            let (mut json, mut text) = (Vec::new(), Vec::new());
            check_json::write(&check, proof.as_ref(), &mut json)
                .and_then(|()| check_text::write(&check, WIDTH, &mut text))
                .map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
            let [json, text] = [json, text].map(|it| String::from_utf8_lossy(&it).into_owned());
            Ok((json, text))
        })
    }

    /// Finds the assemblies at `t` (s): their labels, poses, and true for that of the design configuration; and true if a proof excludes
    /// others.
    fn assemblies(&self, py: Python<'_>, t: f64) -> (Vec<(String, Vec<f64>, bool)>, bool) {
        let view = self.view();
        py.detach(move || {
            let search = assemblies(&view, t);
            let assemblies = search.found.iter();
            let listed = assemblies.map(|it| (it.label(), it.instant.q().to_vec(), it.drawn));
            (listed.collect(), search.are_all())
        })
    }
}
