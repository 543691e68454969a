//! Inverts a large matrix with few entries in place.
//!
//! Along a chain of links an equation has few unknowns, and elimination leaves few in it. The inverse then takes n²
//! operations for each of them, and elimination in place would take n³.

use nalgebra::allocator::Allocator;
use nalgebra::{Const, DefaultAllocator, Dim, OMatrix, OVector};

use crate::math::Real;

/// Replaces a matrix by its inverse, by A Q = L U, with the largest pivot of each row: U has ones in its diagonal, and
/// Q exchanges columns.
///
/// # Errors
/// Returns the row in which every pivot vanishes.
pub(crate) fn invert_by_factors<T: Real, D: Dim>(matrix: &mut OMatrix<T, D, D>) -> Result<(), usize>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let exchanged = factorize(matrix)?;
    let order = matrix.shape_generic().0.value();
    let mut rows = rows_of_lower_inverse(matrix);
    for (place, factors) in matrix.as_slice().chunks_exact(order).enumerate().rev() {
        let both = rows.as_mut_slice().split_at_mut_checked(place * order);
        let Some((above, own)) = both else {
            continue;
        };
        for (row, factor) in above.chunks_exact_mut(order).zip(factors) {
            subtract(row, own, *factor);
        }
    }
    // Columns that were exchanged are rows of the inverse.
    let rows = rows.as_slice().chunks_exact(order);
    for (row, place) in rows.zip(exchanged.as_slice()) {
        let columns = matrix.as_mut_slice().chunks_exact_mut(order);
        for (column, value) in columns.zip(row) {
            if let Some(entry) = column.get_mut(*place) {
                *entry = *value;
            }
        }
    }
    Ok(())
}

/// Replaces a matrix by L and U. Returns for each of their columns its index in the matrix.
///
/// # Errors
/// Returns the row in which every pivot vanishes.
fn factorize<T: Real, D: Dim>(matrix: &mut OMatrix<T, D, D>) -> Result<OVector<usize, D>, usize>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let dimension = matrix.shape_generic().0;
    let order = dimension.value();
    let mut exchanged: OVector<usize, D> =
        OVector::from_fn_generic(dimension, Const::<1>, |place, _| place);
    for row in 0..order {
        let open = matrix.as_mut_slice().get_mut(row * order..);
        let Some((own, rest)) = open.and_then(|open| open.split_at_mut_checked(order)) else {
            continue;
        };
        let size = |column: &[T]| column.get(row).map_or(T::ZERO, |entry| entry.abs());
        let (mut pivot, mut largest) = (None, size(own));
        for (place, column) in rest.chunks_exact(order).enumerate() {
            if size(column) > largest {
                (pivot, largest) = (Some(place), size(column));
            }
        }
        // Written so that NaN is refused.
        let is_pivot = largest > T::ZERO;
        if !is_pivot {
            return Err(row);
        }
        if let Some(place) = pivot
            && let Some(column) = rest.chunks_exact_mut(order).nth(place)
        {
            own.swap_with_slice(column);
            exchanged.as_mut_slice().swap(row, row + 1 + place);
        }
        let Some((divisor, below)) = own.get(row..).and_then(<[T]>::split_first) else {
            continue;
        };
        for column in rest.chunks_exact_mut(order) {
            let lower = column.get_mut(row..).and_then(<[T]>::split_first_mut);
            let Some((entry, lower)) = lower else {
                continue;
            };
            if *entry != T::ZERO {
                *entry /= *divisor;
                subtract(lower, below, *entry);
            }
        }
    }
    Ok(exchanged)
}

/// Inverse of L, row by row.
fn rows_of_lower_inverse<T: Real, D: Dim>(factors: &OMatrix<T, D, D>) -> OMatrix<T, D, D>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let dimension = factors.shape_generic().0;
    let order = dimension.value();
    let mut rows =
        OMatrix::from_fn_generic(dimension, dimension, |row, column| match row == column {
            true => T::ONE,
            false => T::ZERO,
        });
    for (place, factors) in factors.as_slice().chunks_exact(order).enumerate() {
        let open = rows.as_mut_slice().get_mut(place * order..);
        let Some((own, rest)) = open.and_then(|open| open.split_at_mut_checked(order)) else {
            continue;
        };
        let lower = factors.get(place..).and_then(<[T]>::split_first);
        let (Some((divisor, lower)), Some(own)) = (lower, own.get_mut(..=place)) else {
            continue;
        };
        for entry in &mut *own {
            *entry /= *divisor;
        }
        for (row, factor) in rest.chunks_exact_mut(order).zip(lower) {
            subtract(row, own, *factor);
        }
    }
    rows
}

/// Subtracts a multiple from the first entries of a row.
fn subtract<T: Real>(row: &mut [T], subtrahend: &[T], factor: T) {
    // Most entries are zero.
    if factor == T::ZERO {
        return;
    }
    for (entry, subtrahend) in row.iter_mut().zip(subtrahend) {
        *entry -= factor * *subtrahend;
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;

    use super::invert_by_factors;

    /// Jacobian of a chain that ends in a row of all unknowns, with rows in another order.
    fn chain(order: usize) -> DMatrix<f64> {
        let mut matrix = DMatrix::zeros(order, order);
        for row in 0..order {
            let place = (row * 7 + 3) % order;
            for column in row.saturating_sub(1)..(row + 3).min(order) {
                matrix[(place, column)] = f64::sin((3 * row + 11 * column) as f64);
            }
        }
        matrix.row_mut(order / 2).fill(0.5);
        matrix
    }

    #[test]
    fn the_product_with_the_inverse_is_the_identity() {
        for order in [1, 2, 5, 40, 96] {
            let matrix = chain(order);
            let mut inverse = matrix.clone();
            invert_by_factors(&mut inverse).unwrap();
            let off = (&matrix * &inverse - DMatrix::identity(order, order)).amax();
            let condition = matrix.amax() * inverse.amax() * order as f64;
            assert!(off <= 4.0 * f64::EPSILON * condition, "{order}: {off}");
        }
    }

    #[test]
    fn a_row_without_a_pivot_is_named() {
        let mut matrix = chain(40);
        matrix.row_mut(17).fill(0.0);
        assert_eq!(invert_by_factors(&mut matrix), Err(17));
        let mut matrix = chain(40);
        matrix.column_mut(17).fill(0.0);
        assert_eq!(invert_by_factors(&mut matrix), Err(39));
    }
}
