//! Computes |A⁻¹| |L| |U| |x| for a solution x, the magnitudes by which elimination mixes the unknowns.
//!
//! Solving A x = b by elimination with partial pivoting is off by at most 3 n ε of this, to first order (Higham,
//! *Accuracy and Stability of Numerical Algorithms*, theorem 9.4). So an unknown that is exactly zero has this error
//! too. A is the Jacobian in the scales of rows and coordinates, as the runtime eliminates it.

use linkwright::Equations;
use linkwright_solver::textbook::TextbookEquations;
use nalgebra::{DMatrix, DVector};

/// The mixing of each of these solutions, entry by entry, in units of the coordinates; infinite where A is singular.
pub fn mixing(
    equations: &TextbookEquations,
    q: &[f64],
    t: f64,
    solutions: [&[f64]; 2],
) -> [Vec<f64>; 2] {
    let n = q.len();
    let mut matrix = DMatrix::zeros(n, n);
    equations.jacobian(&DVector::from_column_slice(q), t, &mut matrix);
    let scales: Vec<f64> = (0..n).map(|it| equations.coordinate_scale(it)).collect();
    for row in 0..n {
        matrix.row_mut(row).unscale_mut(equations.row_scale(row));
    }
    for (column, scale) in scales.iter().enumerate() {
        matrix.column_mut(column).scale_mut(*scale);
    }
    let factors = matrix.clone().lu();
    let Some(inverse) = factors.try_inverse() else {
        return solutions.map(|it| vec![f64::INFINITY; it.len()]);
    };
    let mut product = factors.l().abs() * factors.u().abs();
    factors.p().inv_permute_rows(&mut product);
    solutions.map(|solution| {
        let entries = solution.iter().zip(&scales);
        let scaled = entries.map(|(value, scale)| value.abs() / scale);
        let mixed = inverse.abs() * (&product * DVector::from_iterator(n, scaled));
        mixed
            .iter()
            .zip(&scales)
            .map(|(it, scale)| it * scale)
            .collect()
    })
}
