//! Computes the derivatives of rates by state at the start of a step.
//!
//! Differences are central, so that the derivatives of quadratic rates are exact up to rounding.

use nalgebra::{DMatrix, Schur};

use crate::rates::Rates;

/// Displacement of a variable in its scale: the cube root of ε, where truncation and rounding are equal.
pub const PART: f64 = 6e-6;

/// Largest number of iterations of an eigenvalue.
const ITERATIONS: usize = 100;

/// Derivatives of the rates of a state.
#[derive(Clone, Debug)]
pub struct Differences {
    /// Derivatives by the components of the state.
    pub jacobian: DMatrix<f64>,
}

impl Differences {
    /// Computes derivatives at a time and a state with these rates, before a step of a length.
    ///
    /// # Errors
    /// Rates do not exist beside the state.
    pub fn of<R: Rates>(
        rates: &mut R,
        t: f64,
        state: &[f64],
        slope: &[f64],
        length: f64,
    ) -> Result<Differences, R::Failure> {
        let count = state.len();
        let mut jacobian = DMatrix::zeros(count, count);
        let mut sides = [vec![0.0; count], vec![0.0; count]];
        let mut moved = state.to_vec();
        let scales = rates.scales(state, slope, length);
        for (column, scale) in scales.iter().enumerate() {
            let from = state[column];
            let [after, before] = [from + PART * scale, from - PART * scale];
            for (side, at) in sides.iter_mut().zip([after, before]) {
                moved[column] = at;
                rates.rates(t, &moved, side)?;
            }
            moved[column] = from;
            for row in 0..count {
                jacobian[(row, column)] = (sides[0][row] - sides[1][row]) / (after - before);
            }
        }
        Ok(Differences { jacobian })
    }

    /// Returns the largest magnitude of an eigenvalue among the first components, and the fastest decay (1/s); infinite if they are not found.
    pub fn fastest(&self, judged: usize) -> [f64; 2] {
        let block = self.jacobian.view((0, 0), (judged, judged)).into_owned();
        let limit = ITERATIONS * judged;
        let is_finite = block.iter().all(|it| it.is_finite());
        let schur_form = is_finite.then(|| Schur::try_new(block, f64::EPSILON, limit));
        schur_form.flatten().map_or([f64::INFINITY; 2], |schur| {
            let values = schur.complex_eigenvalues();
            let largest = |of: fn(f64, f64) -> f64| {
                values.iter().map(|it| of(it.re, it.im)).fold(0.0, f64::max)
            };
            [largest(f64::hypot), largest(|re, _| -re)]
        })
    }
}
