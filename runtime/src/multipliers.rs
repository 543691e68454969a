//! *A Jacobian J (n × n) and generalized forces f* → *the multipliers λ of Jᵀ λ = f*.
//!
//! What the equations of a part without a closed form carry. Each row of J is scaled by its largest entry, so that the elimination
//! does not depend on the unit of an equation. The module does not know what the forces are.

use nalgebra::allocator::Allocator;
use nalgebra::{Const, DefaultAllocator, Dim, OMatrix, OVector, SMatrix, SVector};

use crate::closed_form::failed;
use crate::failure::{Failure, FailureKind};
use crate::linear::Factorization;
use crate::math::Real;
use crate::scale::Scales;
use crate::vector::all_finite;

/// λ, one for each row of `jacobian`, for the `forces` on its columns.
///
/// # Errors
/// [`FailureKind::Singular`] where the Jacobian is, and [`FailureKind::NotFinite`] where it or the solution is not finite.
pub fn multipliers<T: Real, const N: usize>(
    jacobian: [[T; N]; N],
    forces: [T; N],
    time: T,
    block: u16,
) -> Result<[T; N], Failure<T>> {
    let entry = |row: usize, column: usize| jacobian.get(row)?.get(column).copied();
    let matrix = SMatrix::<T, N, N>::from_fn(|row, column| entry(row, column).unwrap_or(T::ZERO));
    let mut found = SVector::<T, N>::from(forces);
    solve::<T, Const<N>>(&matrix, &mut found).map_err(|kind| failed(kind, time, block))?;
    Ok(found.into())
}

/// The same for any dimension: replaces the forces with the multipliers.
///
/// # Errors
/// Those of [`multipliers`].
pub fn solve<T: Real, D: Dim>(
    jacobian: &OMatrix<T, D, D>,
    forces: &mut OVector<T, D>,
) -> Result<(), FailureKind<T>>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let (dimension, _) = jacobian.shape_generic();
    let mut scales = Scales::unit(dimension);
    scales.rows.fill(T::ZERO);
    for column in jacobian.as_slice().chunks_exact(dimension.value().max(1)) {
        for (scale, entry) in scales.rows.iter_mut().zip(column) {
            *scale = scale.max(entry.abs());
        }
    }
    for scale in scales.rows.iter_mut() {
        // Written so that a row of zeros, or of NaN, is judged as it is.
        let is_scale = *scale > T::ZERO;
        if !is_scale {
            *scale = T::ONE;
        }
    }
    let factorization = Factorization::new(jacobian, &scales, T::ZERO)?;
    factorization.solve_transposed(forces);
    match all_finite(forces.as_slice()) {
        true => Ok(()),
        false => Err(FailureKind::NotFinite),
    }
}
