//! Makes the sets of a sweep, and finds extremes of its quantities.

use linkwright_solver::sets::{Axis, BITS, Extremes, MAX_DIMENSIONS, Sobol};
use numpy::{PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

use crate::findings::refused;

/// Returns evenly spaced values, both ends included.
#[pyfunction]
pub fn axis(py: Python<'_>, first: f64, last: f64, count: u64) -> Bound<'_, PyArray1<f64>> {
    let ends = [first, last];
    let axis = Axis { ends, count };
    PyArray1::from_vec(py, (0..count).map(|it| axis.value(it)).collect())
}

/// Returns samples of Sobol's sequence within ranges, (samples, ranges).
#[pyfunction]
pub fn samples(
    py: Python<'_>,
    ranges: Vec<[f64; 2]>,
    count: u64,
    seed: Option<u64>,
) -> PyResult<Bound<'_, PyArray2<f64>>> {
    let most = 1_u64 << BITS;
    if count > most {
        return Err(refused(format!("{count} samples are more than {most}")));
    }
    let sobol = Sobol::new(ranges.len(), seed)
        .ok_or_else(|| refused(format!("samples vary at most {MAX_DIMENSIONS} values")))?;
    let sample = |index: u32| -> Vec<f64> {
        let ends = ranges.iter().enumerate();
        ends.map(|(dimension, ends)| sobol.within(index, dimension, *ends))
            .collect()
    };
    let rows: Vec<Vec<f64>> = (0..count).map(|index| sample(index as u32)).collect();
    PyArray2::from_vec2(py, &rows).map_err(|error| refused(error.to_string()))
}

/// Returns minimum, its time, maximum and its time of each row, (sets, 4); NaN for a row with a value that is not finite.
#[pyfunction]
pub fn extremes<'py>(
    py: Python<'py>,
    times: PyReadonlyArray1<'py, f64>,
    values: PyReadonlyArray2<'py, f64>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let times: Vec<f64> = times.as_array().to_vec();
    let values = values.as_array();
    let rows = values.outer_iter().map(|row| {
        let extremes = Extremes::of(&times, row.iter().copied());
        let both = extremes.map(|it| [it.minimum, it.maximum]);
        both.unwrap_or([[f64::NAN; 2]; 2]).as_flattened().to_vec()
    });
    PyArray2::from_vec2(py, &rows.collect::<Vec<_>>()).map_err(|error| refused(error.to_string()))
}
