//! Solver of planar mechanisms as the Python module `linkwright._core`.
//!
//! Arrays are those of NumPy, and quantities are in SI units: m, rad, s. Calls release the interpreter while they solve. The package
//! `linkwright` in `python/` is what users import; it names and documents everything.

mod batch;
mod calibration;
mod check;
mod equations;
mod expressions;
mod findings;
mod frames;
mod interrupt;
mod mechanism;
mod motion;
mod page;
mod sets;
mod simulation;
mod table;

use pyo3::prelude::*;

/// Classes and functions of the solver.
#[pymodule(gil_used = false)]
mod _core {
    #[pymodule_export]
    use crate::mechanism::Mechanism;
    #[pymodule_export]
    use crate::motion::Solved;
    #[pymodule_export]
    use crate::sets::{axis, extremes, samples};
}
