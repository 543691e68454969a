//! Solves Jᵀ λ = f for the multipliers λ of a Jacobian J (n × n) and generalized forces f.
//!
//! The multipliers are those of a subsystem without a closed form. Each row of J is scaled by its largest entry, so
//! that the elimination does not depend on the unit of an equation.

use nalgebra::allocator::Allocator;
use nalgebra::{Const, DefaultAllocator, Dim, OMatrix, OVector, SMatrix, SVector};

use crate::closed_form::failed;
use crate::failure::{Failure, FailureKind};
use crate::linear::Factorization;
use crate::math::Real;
use crate::scale::Scales;
use crate::vector::all_finite;

/// Returns λ, one for each row of `jacobian`, for the `forces` on its columns.
///
/// # Errors
/// Returns [`FailureKind::Singular`] for a singular Jacobian, and [`FailureKind::NotFinite`] if it or the solution is
/// not finite.
pub fn multipliers<T: Real, const N: usize>(
    jacobian: [[T; N]; N],
    forces: [T; N],
    time: T,
    block: u16,
) -> Result<[T; N], Failure<T>> {
    let entry = |row: usize, column: usize| jacobian.get(row)?.get(column).copied();
    let matrix = SMatrix::<T, N, N>::from_fn(|row, column| entry(row, column).unwrap_or(T::ZERO));
    let mut multipliers = SVector::<T, N>::from(forces);
    solve::<T, Const<N>>(&matrix, &mut multipliers).map_err(|kind| failed(kind, time, block))?;
    Ok(multipliers.into())
}

/// Solves for the multipliers in any dimension: they replace the forces.
///
/// # Errors
/// Returns those of [`multipliers`].
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
        // Written so that a row of zeros, or of NaN, is judged unscaled.
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
