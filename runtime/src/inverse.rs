//! Inverts a matrix in place.

use nalgebra::allocator::Allocator;
use nalgebra::{Const, DefaultAllocator, Dim, OMatrix, OVector};

use crate::math::Real;
use crate::vector::zero_vector;

/// Replaces a matrix by its inverse, by elimination with the largest pivot of each row.
///
/// # Errors
/// Returns the row in which every pivot vanishes.
pub(crate) fn invert<T: Real, D: Dim>(matrix: &mut OMatrix<T, D, D>) -> Result<(), usize>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let dimension = matrix.shape_generic().0;
    let order = dimension.value();
    let mut swapped: OVector<usize, D> =
        OVector::from_fn_generic(dimension, Const::<1>, |row, _| row);
    for row in 0..order {
        // Not every compiler proves that these entries exist.
        let size = |column: usize| {
            let entry = matrix.as_slice().get(column * order + row);
            entry.map_or(T::ZERO, |entry| entry.abs())
        };
        let (mut pivot, mut largest) = (row, size(row));
        for column in row + 1..order {
            let other = size(column);
            if other > largest {
                (pivot, largest) = (column, other);
            }
        }
        // Written so that NaN is refused.
        let is_pivot = largest > T::ZERO;
        if !is_pivot {
            return Err(row);
        }
        if pivot != row {
            // Column by column: not every compiler proves that the entries exist; indexing would leave a panic.
            let mut columns = matrix.as_mut_slice().chunks_exact_mut(order).skip(row);
            let first = columns.next();
            let second = columns.nth(pivot.wrapping_sub(row).wrapping_sub(1));
            for (first, second) in first.into_iter().zip(second) {
                for (first, second) in first.iter_mut().zip(second) {
                    core::mem::swap(first, second);
                }
            }
            if let Some(swapped) = swapped.as_mut_slice().get_mut(row) {
                *swapped = pivot;
            }
        }
        eliminate(matrix, row);
    }
    // Columns that were exchanged are rows of the inverse.
    for (row, &pivot) in swapped.as_slice().iter().enumerate().rev() {
        if pivot == row {
            continue;
        }
        for column in matrix.as_mut_slice().chunks_exact_mut(order) {
            let entries = (column.get(row).copied(), column.get(pivot).copied());
            if let (Some(first), Some(second)) = entries {
                for (place, entry) in [(row, second), (pivot, first)] {
                    if let Some(there) = column.get_mut(place) {
                        *there = entry;
                    }
                }
            }
        }
    }
    Ok(())
}

/// Makes a row that of the identity, by its column, and stores the row of the inverse in its place.
fn eliminate<T: Real, D: Dim>(matrix: &mut OMatrix<T, D, D>, row: usize)
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let dimension = matrix.shape_generic().0;
    let order = dimension.value();
    let mut scaled_row: OVector<T, D> = zero_vector(dimension);
    let mut columns = matrix.as_mut_slice().chunks_exact_mut(order);
    if let Some(column) = columns.nth(row) {
        let Some(pivot) = column.get_mut(row) else {
            return;
        };
        let reciprocal = T::ONE / core::mem::replace(pivot, T::ONE);
        for (scaled_row, entry) in scaled_row.as_mut_slice().iter_mut().zip(column) {
            *entry *= reciprocal;
            *scaled_row = *entry;
        }
    }
    let columns = matrix.as_mut_slice().chunks_exact_mut(order);
    for (number, column) in columns.enumerate() {
        let Some(entry) = column.get_mut(row).filter(|_| number != row) else {
            continue;
        };
        let factor = core::mem::replace(entry, T::ZERO);
        // A block does not depend on the blocks after it.
        if factor == T::ZERO {
            continue;
        }
        for (entry, scaled_row) in column.iter_mut().zip(scaled_row.as_slice()) {
            *entry -= factor * *scaled_row;
        }
    }
}
