//! Measures how close Φ_q is to singular in a pose, and finds its weakest directions.
//!
//! The reciprocal condition is 1 / (‖A‖₁ ‖A⁻¹‖₁), computed from the inverse itself (not estimated): 1 at best, 0 for a
//! singular matrix, and up to a factor n the relative distance to the nearest singular matrix (Golub & Van Loan, *Matrix
//! Computations*, 4th ed., section 2.6.2). Of Φ_q in SI units the reciprocal condition depends on the unit of length, so verdicts use
//! the [`dimensionless`] matrix.

use linkwright::Equations;
use linkwright::generated::{Factorization, Scales};
use nalgebra::{DMatrix, DVector, Dyn};

/// Condition of a matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Condition {
    /// Determinant with its sign; infinite or zero if it leaves the range of `f64`.
    pub determinant: f64,
    /// Sign -1, 0 or 1, even if the determinant cannot be represented; 0 only if a pivot is exactly zero.
    pub sign: i8,
    /// Reciprocal condition number in the 1-norm; 0 for a singular matrix.
    pub reciprocal: f64,
}

/// Directions in which a matrix is closest to singular.
#[derive(Clone, Debug)]
pub struct Weakness {
    /// Left singular vector of the smallest singular value (n): the dependent combination of equations.
    pub equations: DVector<f64>,
    /// Right singular vector of the smallest singular value (n): the motion of coordinates that the equations permit.
    pub coordinates: DVector<f64>,
}

/// Returns Φ_q (n × n) at the pose `q` and time `t` (s).
pub fn jacobian(equations: &impl Equations<f64, Dyn>, q: &DVector<f64>, t: f64) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(q.len(), q.len());
    equations.jacobian(q, t, &mut matrix);
    matrix
}

/// Returns R⁻¹ Φ_q C with row scales R and coordinate scales C: lengths are divided by the characteristic length.
pub fn dimensionless(
    equations: &impl Equations<f64, Dyn>,
    mut matrix: DMatrix<f64>,
) -> DMatrix<f64> {
    for (column, mut entries) in matrix.column_iter_mut().enumerate() {
        for (row, entry) in entries.iter_mut().enumerate() {
            *entry *= equations.coordinate_scale(column) / equations.row_scale(row);
        }
    }
    matrix
}

impl Condition {
    /// Returns the condition of a square matrix. A matrix with an entry that is not finite counts as singular.
    pub fn of(matrix: &DMatrix<f64>) -> Condition {
        let n = matrix.nrows();
        // With a limit of zero, only exactly singular matrices fail.
        let Ok(factorization) = Factorization::new(matrix, &Scales::unit(Dyn(n)), 0.0) else {
            return Condition {
                determinant: 0.0,
                sign: 0,
                reciprocal: 0.0,
            };
        };
        let norm = |column: &[f64]| column.iter().map(|entry| entry.abs()).sum::<f64>();
        let matrix_norm = matrix
            .column_iter()
            .map(|column| norm(column.as_slice()))
            .fold(0.0, f64::max);
        let mut inverse = 0.0_f64;
        let mut column = DVector::zeros(n);
        for k in 0..n {
            column.fill(0.0);
            column[k] = 1.0;
            factorization.solve(&mut column);
            inverse = inverse.max(norm(column.as_slice()));
        }
        let determinant = factorization.determinant();
        let reciprocal = if n == 0 {
            1.0
        } else {
            1.0 / (matrix_norm * inverse)
        };
        Condition {
            determinant,
            // An underflowing determinant keeps its sign in the sign of zero.
            sign: if determinant.is_sign_negative() {
                -1
            } else {
                1
            },
            reciprocal: if reciprocal.is_finite() {
                reciprocal
            } else {
                0.0
            },
        }
    }
}

impl Weakness {
    /// Returns the weakest directions of a square matrix; `None` if an entry is not finite or the matrix is empty.
    pub fn of(matrix: &DMatrix<f64>) -> Option<Weakness> {
        if matrix.is_empty() || matrix.iter().any(|entry| !entry.is_finite()) {
            return None;
        }
        // QR takes two or three sweeps per singular value; the limit only guarantees an end.
        let sweeps = 100 * matrix.nrows();
        let decomposition = matrix.clone().try_svd(true, true, f64::EPSILON, sweeps)?;
        let (smallest, _) = decomposition.singular_values.argmin();
        Some(Weakness {
            equations: decomposition.u?.column(smallest).into_owned(),
            coordinates: decomposition.v_t?.row(smallest).transpose(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_diagonal_matrix_says_what_it_is() {
        let matrix = DMatrix::from_diagonal(&DVector::from_vec(vec![2.0, -8.0, 0.5]));
        let condition = Condition::of(&matrix);
        assert_eq!(condition.determinant, -8.0);
        assert_eq!(condition.sign, -1);
        assert_eq!(condition.reciprocal, 1.0 / 16.0);
        let weakness = Weakness::of(&matrix).expect("the matrix is finite");
        assert_eq!(weakness.equations.map(f64::abs).as_slice(), [0.0, 0.0, 1.0]);
        assert_eq!(
            weakness.coordinates.map(f64::abs).as_slice(),
            [0.0, 0.0, 1.0]
        );
    }

    #[test]
    fn a_singular_matrix_has_reciprocal_zero() {
        let matrix = DMatrix::from_row_slice(2, 2, &[1.0, 2.0, 2.0, 4.0]);
        assert_eq!(Condition::of(&matrix).reciprocal, 0.0);
        assert_eq!(Condition::of(&matrix).determinant, 0.0);
        let weakness = Weakness::of(&matrix).expect("the matrix is finite");
        let residual = &matrix * &weakness.coordinates;
        assert!(residual.amax() < 1e-15, "{residual}");
        let residual = matrix.transpose() * &weakness.equations;
        assert!(residual.amax() < 1e-15, "{residual}");
    }

    #[test]
    fn a_determinant_that_underflows_keeps_its_sign() {
        let matrix = DMatrix::from_diagonal(&DVector::from_element(5, -1e-100));
        let condition = Condition::of(&matrix);
        assert_eq!((condition.determinant, condition.sign), (0.0, -1));
        assert_eq!(condition.reciprocal, 1.0);
    }

    #[test]
    fn entries_that_are_not_finite_count_as_singular() {
        let matrix = DMatrix::from_element(2, 2, f64::NAN);
        assert_eq!(Condition::of(&matrix).reciprocal, 0.0);
        assert!(Weakness::of(&matrix).is_none());
    }
}
