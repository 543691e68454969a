//! Factorizes a Jacobian in its scales, or decides that it is singular ([`Factorization`]).
//!
//! **The scaled matrix.** All work is done on Â = R⁻¹ A C, with the diagonal matrices R of row scales and C of
//! coordinate scales. Its entries are plain numbers: 1 means that a change of a coordinate by its scale changes the
//! residual by its scale. Neither the choice of pivots nor the verdict depends on the units of the description.
//!
//! **The verdict.** The *pivot ratio* of a column is |pivot| / max(1, max |â_ij|). A matrix is rejected as soon as one
//! ratio falls below the limit of the settings.
//! - With partial pivoting the pivot is the largest remaining entry of its column. Taking these entries off, each no
//!   larger than the pivot, makes the matrix exactly singular. So a rejected matrix *is* within the ratio of a
//!   singular one (relative to its largest entry): with a limit of a few n ε it cannot be told from a singular one.
//! - The reference is at least 1, because a matrix of tiny entries is singular too: coordinates can move by their
//!   scales without a residual that could be seen. Without this, a 1 × 1 matrix would never be singular.
//! - The converse does not hold: the ratio is an upper bound of the distance to singularity, not an estimate of it.
//!   Matrices are known whose pivots stay large although the matrix is nearly singular (Kahan 1966), so an accepted
//!   matrix is not certified to be well-conditioned.
//!
//! The elimination is Golub & Van Loan, *Matrix Computations* (4th ed.), algorithm 3.4.1, in its column-oriented
//! outer-product form. Row exchanges are not applied to the multipliers already stored; [`Factorization::solve`]
//! replays them in turn (as LINPACK does). An exchange therefore touches the trailing columns only, and each is stored
//! as the distance from the pivot's row. Slices are taken apart with checked splits: an impossible case ends a loop,
//! and no panic path is compiled.

mod condition;
mod measure;

pub(crate) use condition::position_of_largest;
pub use measure::Measure;

use nalgebra::allocator::Allocator;
use nalgebra::{Const, DefaultAllocator, Dim, OMatrix, OVector};

use crate::closed_form::Branch;
use crate::failure::{FailureKind, index};
use crate::math::Real;
use crate::scale::Scales;
use crate::vector::require_dimension;

/// Factors of an n × n matrix A as P Â = L U, with Â the scaled matrix; they yield A⁻¹ b and det A.
#[derive(Clone, Debug)]
pub struct Factorization<T: Real, D: Dim>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    /// U on and above the diagonal, the multipliers of L below it.
    factors: OMatrix<T, D, D>,
    /// Distance of column k's pivot below row k; 0 if the row stayed in its place.
    exchanges: OVector<u16, D>,
    /// Diagonals of R⁻¹ and C.
    row_factors: OVector<T, D>,
    column_factors: OVector<T, D>,
    pivot_ratio: T,
}

impl<T: Real, D: Dim> Factorization<T, D>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    /// Factorizes `matrix` (n × n), judged after scaling with `scales`.
    ///
    /// # Errors
    /// Returns [`FailureKind::Singular`] if the pivot ratio of a column is below `smallest_pivot_ratio`;
    /// [`FailureKind::NotFinite`] if an entry of the matrix, or of a factor, is infinite or NaN.
    ///
    /// # Panics
    /// If the scales do not have the dimension of the matrix, which only a dynamic dimension permits, or if the
    /// dimension exceeds 65535.
    pub fn new(
        matrix: &OMatrix<T, D, D>,
        scales: &Scales<T, D>,
        smallest_pivot_ratio: T,
    ) -> Result<Self, FailureKind<T>> {
        let (dimension, _) = matrix.shape_generic();
        require_dimension(&scales.rows, dimension);
        require_dimension(&scales.columns, dimension);
        assert!(
            dimension.value() <= usize::from(u16::MAX),
            "row exchanges are stored in 16 bits"
        );
        let row_factors = scales.rows.map(|scale| T::ONE / scale);
        let column_factors = scales.columns.clone();
        let mut factors = matrix.clone();
        scale_entries(
            factors.as_mut_slice(),
            row_factors.as_slice(),
            column_factors.as_slice(),
        );
        let largest = largest_finite_magnitude(factors.as_slice()).ok_or(FailureKind::NotFinite)?;
        let mut exchanges = OVector::from_fn_generic(dimension, Const::<1>, |_, _| 0);
        let pivot_ratio = eliminate(
            factors.as_mut_slice(),
            exchanges.as_mut_slice(),
            dimension.value(),
            largest.max(T::ONE),
            smallest_pivot_ratio,
        )?;
        largest_finite_magnitude(factors.as_slice()).ok_or(FailureKind::NotFinite)?;
        Ok(Self {
            factors,
            exchanges,
            row_factors,
            column_factors,
            pivot_ratio,
        })
    }

    /// Replaces the right-hand side b (n) with the solution x of A x = b.
    ///
    /// The solution is not finite where it overflows or where the right-hand side was not finite.
    ///
    /// # Panics
    /// If the right-hand side does not have the dimension of the matrix, which only a dynamic dimension permits.
    pub fn solve(&self, right_hand_side: &mut OVector<T, D>) {
        let (dimension, _) = self.factors.shape_generic();
        require_dimension(right_hand_side, dimension);
        let x = right_hand_side.as_mut_slice();
        for (entry, factor) in x.iter_mut().zip(self.row_factors.as_slice()) {
            *entry *= *factor;
        }
        self.solve_scaled(x);
        for (entry, factor) in x.iter_mut().zip(self.column_factors.as_slice()) {
            *entry *= *factor;
        }
    }

    /// Replaces the right-hand side (n) of the scaled system with its solution.
    #[inline]
    fn solve_scaled(&self, x: &mut [T]) {
        let n = self.exchanges.len();
        let columns = || self.factors.as_slice().chunks_exact(n.max(1)).enumerate();
        // Forward: L y = P b, the exchange of each column before its multipliers.
        for ((k, column), distance) in columns().zip(self.exchanges.as_slice()) {
            let (Some(active), Some(multipliers)) = (x.get_mut(k..), column.get(k + 1..)) else {
                break;
            };
            exchange(active, *distance);
            if let Some((head, tail)) = active.split_first_mut() {
                subtract_multiple(tail, *head, multipliers);
            }
        }
        // Backward: U z = y, column by column.
        for (k, column) in columns().rev() {
            let (Some((above, rest)), Some((upper, diagonal))) =
                (x.split_at_mut_checked(k), column.split_at_checked(k))
            else {
                break;
            };
            if let (Some(entry), Some(pivot)) = (rest.first_mut(), diagonal.first()) {
                *entry /= *pivot;
                subtract_multiple(above, *entry, upper);
            }
        }
    }

    /// Smallest pivot ratio of all columns: |pivot| / max(1, max |â_ij|), in (0, 1]; 1 for an empty matrix.
    pub fn pivot_ratio(&self) -> T {
        self.pivot_ratio
    }

    /// Sign of the determinant; positive for an empty matrix. Two poses with different signs belong to different
    /// assembly modes.
    pub fn branch(&self) -> Branch {
        let columns = self
            .factors
            .as_slice()
            .chunks_exact(self.exchanges.len().max(1));
        let mut negative = false;
        for ((k, column), distance) in columns.enumerate().zip(self.exchanges.as_slice()) {
            let below = column.get(k).is_some_and(|pivot| *pivot < T::ZERO);
            negative ^= below ^ (*distance != 0);
        }
        if negative {
            Branch::Negative
        } else {
            Branch::Positive
        }
    }

    /// Determinant of the given matrix, not of the scaled one, with its sign.
    ///
    /// Intermediate products cannot overflow; a determinant outside the range of the scalar is infinite or zero.
    pub fn determinant(&self) -> T {
        let n = self.exchanges.len();
        let mut significand = T::ONE;
        let mut exponent = 0;
        let mut accumulate = |factor: T, sign: i32| {
            let (part, power) = factor.significand_exponent();
            let product = if sign < 0 {
                significand / part
            } else {
                significand * part
            };
            let (part, carry) = product.significand_exponent();
            significand = part;
            exponent += sign * power + carry;
        };
        let columns = self.factors.as_slice().chunks_exact(n.max(1)).enumerate();
        for ((k, column), distance) in columns.zip(self.exchanges.as_slice()) {
            if let Some(pivot) = column.get(k) {
                accumulate(if *distance == 0 { *pivot } else { -*pivot }, 1);
            }
        }
        let row_factors = self.row_factors.as_slice().iter();
        for (row_factor, column_factor) in row_factors.zip(self.column_factors.as_slice()) {
            accumulate(*row_factor, -1);
            accumulate(*column_factor, -1);
        }
        significand.scale_by_power_of_two(exponent)
    }
}

/// Scales the columns of `matrix` (n × n) in place.
fn scale_entries<T: Real>(matrix: &mut [T], row_factors: &[T], column_factors: &[T]) {
    let columns = matrix.chunks_exact_mut(row_factors.len().max(1));
    for (column, column_factor) in columns.zip(column_factors) {
        for (entry, row_factor) in column.iter_mut().zip(row_factors) {
            *entry *= *row_factor * *column_factor;
        }
    }
}

/// Largest magnitude of all entries; `None` if an entry is not finite.
fn largest_finite_magnitude<T: Real>(entries: &[T]) -> Option<T> {
    // Four independent lanes, because a single chain of comparisons or sums would not be vectorized.
    let mut largest = [T::ZERO; 4];
    let mut invalid = [T::ZERO; 4];
    let (chunks, remainder) = entries.as_chunks::<4>();
    let mut padded = [T::ZERO; 4];
    for (slot, entry) in padded.iter_mut().zip(remainder) {
        *slot = *entry;
    }
    for chunk in chunks.iter().chain([&padded]) {
        for ((largest, invalid), entry) in largest.iter_mut().zip(&mut invalid).zip(chunk) {
            let magnitude = entry.abs();
            *largest = if magnitude > *largest {
                magnitude
            } else {
                *largest
            };
            // Zero for a finite entry, NaN for all others.
            *invalid += *entry * T::ZERO;
        }
    }
    let valid = invalid.iter().all(|sum| *sum == T::ZERO);
    valid.then(|| largest.into_iter().fold(T::ZERO, T::max))
}

/// Overwrites `matrix` (n × n) with its factors and returns the smallest pivot ratio.
fn eliminate<T: Real>(
    matrix: &mut [T],
    exchanges: &mut [u16],
    n: usize,
    reference: T,
    smallest_pivot_ratio: T,
) -> Result<T, FailureKind<T>> {
    let mut smallest = T::ONE;
    let mut rest = matrix;
    for (k, distance) in exchanges.iter_mut().enumerate() {
        let Some((column, trailing)) = rest.split_at_mut_checked(n) else {
            break;
        };
        let Some(active) = column.get_mut(k..) else {
            break;
        };
        let (offset, magnitude) = largest_entry(active);
        let pivot_ratio = magnitude / reference;
        // Written so that NaN is rejected too.
        if !(pivot_ratio >= smallest_pivot_ratio && pivot_ratio > T::ZERO) {
            return Err(FailureKind::Singular {
                pivot_ratio,
                column: index(k),
            });
        }
        smallest = smallest.min(pivot_ratio);
        *distance = index(offset);
        exchange(active, *distance);
        let Some((pivot, multipliers)) = active.split_first_mut() else {
            break;
        };
        let reciprocal = T::ONE / *pivot;
        for multiplier in multipliers.iter_mut() {
            *multiplier *= reciprocal;
        }
        for other in trailing.chunks_exact_mut(n.max(1)) {
            let Some(active) = other.get_mut(k..) else {
                break;
            };
            exchange(active, *distance);
            if let Some((head, tail)) = active.split_first_mut() {
                subtract_multiple(tail, *head, multipliers);
            }
        }
        rest = trailing;
    }
    Ok(smallest)
}

/// Position and magnitude of the first entry of largest magnitude; (0, 0) if there is none.
#[inline]
fn largest_entry<T: Real>(entries: &[T]) -> (usize, T) {
    // Two passes: the maximum in independent lanes and its position take less time than one dependent chain.
    let mut lanes = [T::ZERO; 4];
    let (chunks, remainder) = entries.as_chunks::<4>();
    for chunk in chunks {
        for (lane, entry) in lanes.iter_mut().zip(chunk) {
            let magnitude = entry.abs();
            *lane = if magnitude > *lane { magnitude } else { *lane };
        }
    }
    let mut largest = T::ZERO;
    for entry in remainder.iter().chain(&lanes) {
        let magnitude = entry.abs();
        largest = if magnitude > largest {
            magnitude
        } else {
            largest
        };
    }
    let offset = entries.iter().position(|entry| entry.abs() == largest);
    (offset.unwrap_or(0), largest)
}

/// Exchanges the first entry with the one `distance` below it.
#[inline]
fn exchange<T: Real>(entries: &mut [T], distance: u16) {
    if distance == 0 {
        return;
    }
    if let Some((head, tail)) = entries.split_first_mut()
        && let Some(other) = tail.get_mut(usize::from(distance) - 1)
    {
        core::mem::swap(head, other);
    }
}

/// entries -= factor · column.
#[inline]
fn subtract_multiple<T: Real>(entries: &mut [T], factor: T, column: &[T]) {
    // Jacobians of mechanisms are sparse: most factors are exactly zero, and the columns are finite.
    if factor == T::ZERO {
        return;
    }
    for (entry, value) in entries.iter_mut().zip(column) {
        *entry -= factor * *value;
    }
}
