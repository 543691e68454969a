//! Verifies that a solved pose can be told from a singular one.
//!
//! A residual r leaves a pose uncertain by Φ_q⁻¹ r, which is large for a nearly singular Φ_q: a double root meets a
//! tolerance of 1e-12 from as far as 1e-6. This does no harm while Φ_q changes little within the uncertainty: the pose
//! is as exact as its condition permits. If Φ_q changes by as much as itself, a singular pose is among those that fit
//! the residual, and there may be a second solution, or none. This is the condition of Newton and Kantorovich, h =
//! ‖Φ_q⁻¹ (Φ_q(q + δ) - Φ_q(q))‖ ≤ 1/2 (Deuflhard, *Newton Methods for Nonlinear Problems*, 2004, section 2.1), for the
//! δ that the residual leaves most uncertain. It does not depend on the choice of coordinates. A quarter of it is
//! required, because the residual is itself known to rounding only; the condition then holds with that error too.
//!
//! A pose that rounding leaves uncertain by more than a thousandth in the scale of a coordinate is refused as well,
//! however little Φ_q changes: it has less than three digits. Far from the origin, or with links of very different
//! lengths, the rounding of the residual alone leaves that much.

use nalgebra::allocator::Allocator;
use nalgebra::{DefaultAllocator, Dim, OMatrix, OVector};

use crate::equations::Equations;
use crate::failure::{FailureKind, index};
use crate::linear::{Factorization, position_of_largest};
use crate::math::Real;
use crate::newton::ROUNDING;
use crate::scale::Scales;
use crate::vector::{add, zero_matrix, zero_vector};

/// Multiple of the residual below which the square of the pivot ratio makes a pose doubtful. At a fold of curvature κ,
/// a pose is refused if the square of the smallest singular value is below 4 κ r. The rest allows for curvatures above
/// 1 and for pivots that are larger than the singular value.
const DOUBT: f64 = 256.0;

/// Largest uncertainty of a coordinate, in its scale; a pose beyond it has less than three digits and is refused.
pub const LARGEST_UNCERTAINTY: f64 = 1e-3;

/// Largest change of the Jacobian, relative to itself, at a regular pose.
const LARGEST_CHANGE: f64 = 0.125;

/// True if [`require`] must decide; false for every pose that is safely away from singular ones.
#[inline]
pub(crate) fn is_doubtful<T: Real, D: Dim>(factorization: &Factorization<T, D>, residual: T) -> bool
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let ratio = factorization.pivot_ratio();
    ratio * ratio < T::from_f64(DOUBT) * level(residual)
}

/// Residual, or rounding if the residual is lower.
fn level<T: Real>(residual: T) -> T {
    residual.max(T::from_f64(ROUNDING) * T::EPSILON)
}

/// Requires that the pose `q` (n) with the scaled `residual` is regular. `jacobian` (n × n) is the Jacobian at `q`, and
/// `factorization` belongs to it.
///
/// # Work
/// One evaluation of the Jacobian and at most 13 solves.
#[cold]
pub(crate) fn require<T: Real, D: Dim, E: Equations<T, D>>(
    equations: &E,
    q: &OVector<T, D>,
    t: T,
    residual: T,
    jacobian: &OMatrix<T, D, D>,
    factorization: &Factorization<T, D>,
) -> Result<(), FailureKind<T>>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let dimension = equations.dimension();
    let n = dimension.value();
    let scales = Scales::of(equations);
    let (_, mut uncertain) = factorization.inverse_norm();
    let column = position_of_largest(uncertain.as_slice());
    // From a change per scaled residual to a change of the coordinates. The residual may have either sign, so two poses
    // that both fit differ by twice the uncertainty.
    let reach = level(residual) + level(residual);
    let entries = uncertain.as_mut_slice().iter_mut();
    for (entry, scale) in entries.zip(scales.columns.as_slice()) {
        *entry *= reach * *scale;
    }
    let singular = Err(FailureKind::Singular {
        pivot_ratio: factorization.pivot_ratio(),
        column: index(column),
    });
    let size = scales.step_length(&uncertain);
    // A caller may choose a tolerance that leaves less digits; rounding alone must leave enough. Written so that NaN is
    // rejected too.
    let by_rounding = size * (level(T::ZERO) / level(residual));
    let certain = by_rounding <= T::from_f64(LARGEST_UNCERTAINTY);
    if !certain {
        return singular;
    }
    let mut moved = q.clone();
    add(&mut moved, &uncertain);
    let mut changed = zero_matrix(dimension);
    equations.jacobian(&moved, t, &mut changed);
    let mut image = zero_vector(dimension);
    let columns = changed.as_slice().chunks_exact(n.max(1));
    let columns = columns.zip(jacobian.as_slice().chunks_exact(n.max(1)));
    for ((after, before), factor) in columns.zip(uncertain.as_slice()) {
        let sums = image
            .as_mut_slice()
            .iter_mut()
            .zip(after.iter().zip(before));
        for (sum, (after, before)) in sums {
            *sum += (*after - *before) * *factor;
        }
    }
    factorization.solve(&mut image);
    let change = scales.step_length(&image);
    // Written so that NaN is rejected too.
    if change <= T::from_f64(LARGEST_CHANGE) * size {
        return Ok(());
    }
    singular
}
