//! Moves a poor estimate of the pose towards a minimum of the residuals.
//!
//! The method of Levenberg and Marquardt minimizes the sum of the squares of the scaled residuals. With J the scaled
//! Jacobian, each step solves (Jᵀ J + μ I) s = -Jᵀ Φ. A step that gains as the linear system predicts lowers μ, and any
//! other step raises it (Nielsen 1999; Madsen, Nielsen and Tingleff, *Methods for Non-Linear Least Squares Problems*,
//! 2004, section 3.2). Unlike Newton-Raphson the method is well defined at singular poses and passes them.
//!
//! The minimum need not be a pose; callers continue with Newton-Raphson.

use nalgebra::allocator::Allocator;
use nalgebra::{DefaultAllocator, Dim, OMatrix, OVector};

use crate::equations::Equations;
use crate::linear::Factorization;
use crate::math::Real;
use crate::scale::Scales;
use crate::vector::{add, negate, require_dimension, zero_matrix, zero_vector};

/// Largest number of steps, including those that are taken back.
pub const STEPS: u16 = 60;

/// Scaled residual at which the estimate is good enough for Newton-Raphson.
const GOOD: f64 = 1e-4;

/// First μ, relative to the largest entry of the diagonal of Jᵀ J.
const FIRST_DAMPING: f64 = 1e-2;

/// Smallest factor of μ after a step with the predicted gain.
const LARGEST_EASING: f64 = 1.0 / 3.0;

/// Moves the estimate `q` (n) towards a minimum of the residuals at time `t`. Returns true if they are small there.
///
/// # Work
/// At most 1 + [`STEPS`] evaluations of the residual and of the Jacobian.
///
/// # Panics
/// If `q` does not have the dimension of the equations, which only a dynamic dimension permits.
pub fn approach<T: Real, D: Dim, E: Equations<T, D>>(
    equations: &E,
    q: &mut OVector<T, D>,
    t: T,
) -> bool
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let dimension = equations.dimension();
    require_dimension(q, dimension);
    let scales = Scales::of(equations);
    let unit = Scales::unit(dimension);
    let mut phi = zero_vector(dimension);
    let mut jacobian = zero_matrix(dimension);
    let mut normal = zero_matrix(dimension);
    let mut gradient = zero_vector(dimension);
    equations.residual(q, t, &mut phi);
    let mut sum = sum_of_squares(&mut phi, &scales);
    equations.jacobian(q, t, &mut jacobian);
    assemble_normal(&mut jacobian, &phi, &scales, &mut normal, &mut gradient);
    let mut damping = T::from_f64(FIRST_DAMPING) * largest_of_diagonal(&normal);
    let mut growth = T::ONE + T::ONE;
    for _ in 0..STEPS {
        if sum.is_finite() && sum.sqrt() <= T::from_f64(GOOD) {
            return true;
        }
        let mut damped = normal.clone();
        let stride = dimension.value() + 1;
        for entry in damped.as_mut_slice().iter_mut().step_by(stride) {
            *entry += damping;
        }
        let mut step = gradient.clone();
        negate(&mut step);
        let Ok(factorization) = Factorization::new(&damped, &unit, T::ZERO) else {
            return false;
        };
        factorization.solve(&mut step);
        // Gain that the linear system predicts: sᵀ (μ s - g).
        let entries = step.as_slice().iter().zip(gradient.as_slice());
        let promised = entries.fold(T::ZERO, |total, (s, g)| total + *s * (damping * *s - *g));
        let mut trial = q.clone();
        let mut unscaled = step.clone();
        let changes = unscaled.as_mut_slice().iter_mut();
        for (change, scale) in changes.zip(scales.columns.as_slice()) {
            *change *= *scale;
        }
        add(&mut trial, &unscaled);
        let mut after = zero_vector(dimension);
        equations.residual(&trial, t, &mut after);
        let sum_after = sum_of_squares(&mut after, &scales);
        let gain = (sum - sum_after) / promised;
        if gain > T::ZERO {
            *q = trial;
            phi = after;
            sum = sum_after;
            equations.jacobian(q, t, &mut jacobian);
            assemble_normal(&mut jacobian, &phi, &scales, &mut normal, &mut gradient);
            let bend = gain + gain - T::ONE;
            damping *= (T::ONE - bend * bend * bend).max(T::from_f64(LARGEST_EASING));
            growth = T::ONE + T::ONE;
        } else {
            damping *= growth;
            growth += growth;
        }
        if !damping.is_finite() {
            return false;
        }
    }
    sum.sqrt() <= T::from_f64(GOOD)
}

/// Scales `phi` (n) and returns the sum of the squares of its entries.
fn sum_of_squares<T: Real, D: Dim>(phi: &mut OVector<T, D>, scales: &Scales<T, D>) -> T
where
    DefaultAllocator: Allocator<D>,
{
    let mut sum = T::ZERO;
    for (value, scale) in phi.as_mut_slice().iter_mut().zip(scales.rows.as_slice()) {
        *value /= *scale;
        sum += *value * *value;
    }
    sum
}

/// Scales `jacobian` (n × n), and fills `normal` (n × n) with Jᵀ J and `gradient` (n) with Jᵀ Φ.
fn assemble_normal<T: Real, D: Dim>(
    jacobian: &mut OMatrix<T, D, D>,
    phi: &OVector<T, D>,
    scales: &Scales<T, D>,
    normal: &mut OMatrix<T, D, D>,
    gradient: &mut OVector<T, D>,
) where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let n = phi.as_slice().len().max(1);
    let columns = jacobian.as_mut_slice().chunks_exact_mut(n);
    for (column, column_scale) in columns.zip(scales.columns.as_slice()) {
        for (entry, row_scale) in column.iter_mut().zip(scales.rows.as_slice()) {
            *entry *= *column_scale / *row_scale;
        }
    }
    let columns = || jacobian.as_slice().chunks_exact(n);
    for (entry, column) in gradient.as_mut_slice().iter_mut().zip(columns()) {
        *entry = product(column, phi.as_slice());
    }
    let targets = normal.as_mut_slice().chunks_exact_mut(n);
    for (target, left) in targets.zip(columns()) {
        for (entry, right) in target.iter_mut().zip(columns()) {
            *entry = product(left, right);
        }
    }
}

fn product<T: Real>(a: &[T], b: &[T]) -> T {
    let terms = a.iter().zip(b).map(|(a, b)| *a * *b);
    terms.fold(T::ZERO, |sum, term| sum + term)
}

fn largest_of_diagonal<T: Real, D: Dim>(matrix: &OMatrix<T, D, D>) -> T
where
    DefaultAllocator: Allocator<D, D>,
{
    let (dimension, _) = matrix.shape_generic();
    let diagonal = matrix.as_slice().iter().step_by(dimension.value() + 1);
    diagonal.fold(T::ZERO, |largest, entry| largest.max(*entry))
}
