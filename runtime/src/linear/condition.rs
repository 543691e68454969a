//! Estimates the norm of the inverse from a factorization, with a vector that attains the estimate.
//!
//! The 1-norm of the inverse is estimated from a few solves with the matrix and with its transpose (Hager 1984; Higham,
//! *ACM Transactions on Mathematical Software* 14 (1988), 381-396, algorithm 4.1, which LAPACK has as `xLACON`). The
//! estimate is a lower bound of the norm, attained by a known vector, and it is rarely less than a third of the norm.
//!
//! Everything here is computed on request; a factorization without requests costs nothing more.

use nalgebra::allocator::Allocator;
use nalgebra::{DefaultAllocator, Dim, OMatrix, OVector};

use super::{Factorization, exchange};
use crate::math::Real;
use crate::vector::{require_dimension, zero_vector};

/// Largest number of unit vectors that are tried. Higham found that more than two are hardly ever needed.
const TRIALS: u8 = 5;

impl<T: Real, D: Dim> Factorization<T, D>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    /// Replaces the right-hand side b (n) with the solution x of Aᵀ x = b.
    ///
    /// # Panics
    /// If the right-hand side does not have the dimension of the matrix, which only a dynamic dimension permits.
    pub fn solve_transposed(&self, right_hand_side: &mut OVector<T, D>) {
        let (dimension, _) = self.factors.shape_generic();
        require_dimension(right_hand_side, dimension);
        let x = right_hand_side.as_mut_slice();
        for (entry, factor) in x.iter_mut().zip(self.column_factors.as_slice()) {
            *entry *= *factor;
        }
        self.solve_scaled_transposed(x);
        for (entry, factor) in x.iter_mut().zip(self.row_factors.as_slice()) {
            *entry *= *factor;
        }
    }

    /// Estimates 1 / (‖Â‖₁ ‖Â⁻¹‖₁), where Â is the scaled matrix: 1 for the identity, 0 for a singular matrix.
    ///
    /// `matrix` (n × n) is the matrix that was factorized, which is not kept. The estimate is seldom more than three
    /// times too large and never too small, up to rounding. An empty matrix has 1; if the inverse overflows, the
    /// estimate is 0.
    ///
    /// # Work
    /// At most 12 solves.
    ///
    /// # Panics
    /// If the matrix does not have the dimension of the factorization, which only a dynamic dimension permits.
    pub fn reciprocal_condition(&self, matrix: &OMatrix<T, D, D>) -> T {
        let n = self.exchanges.len();
        assert!(
            matrix.as_slice().len() == self.factors.as_slice().len(),
            "the matrix must be the one that was factorized"
        );
        if n == 0 {
            return T::ONE;
        }
        let mut norm = T::ZERO;
        let columns = matrix.as_slice().chunks_exact(n.max(1));
        for (column, column_factor) in columns.zip(self.column_factors.as_slice()) {
            let mut sum = T::ZERO;
            for (entry, row_factor) in column.iter().zip(self.row_factors.as_slice()) {
                sum += (*entry * (*row_factor * *column_factor)).abs();
            }
            norm = norm.max(sum);
        }
        let (inverse_norm, _) = self.inverse_norm();
        let reciprocal = T::ONE / (norm * inverse_norm);
        if reciprocal.is_finite() {
            reciprocal
        } else {
            T::ZERO
        }
    }

    /// Estimates ‖Â⁻¹‖₁, with a vector Â⁻¹ b of this 1-norm, ‖b‖₁ = 1.
    pub(crate) fn inverse_norm(&self) -> (T, OVector<T, D>) {
        let (dimension, _) = self.factors.shape_generic();
        let n = dimension.value();
        let count = T::from_f64(n as f64);
        let mut image = zero_vector(dimension);
        let mut gradient = zero_vector(dimension);
        image.as_mut_slice().fill(T::ONE / count);
        self.solve_scaled(image.as_mut_slice());
        let mut norm = sum_of_magnitudes(image.as_slice());
        let mut unit = None;
        for _ in 0..TRIALS {
            // Gradient of the norm of the image with respect to b.
            for (slope, value) in gradient.as_mut_slice().iter_mut().zip(image.as_slice()) {
                *slope = if *value < T::ZERO { -T::ONE } else { T::ONE };
            }
            self.solve_scaled_transposed(gradient.as_mut_slice());
            let steepest = position_of_largest(gradient.as_slice());
            // A unit vector that returns is a local maximum.
            if unit == Some(steepest) {
                break;
            }
            unit = Some(steepest);
            let mut candidate = zero_vector(dimension);
            if let Some(entry) = candidate.as_mut_slice().get_mut(steepest) {
                *entry = T::ONE;
            }
            self.solve_scaled(candidate.as_mut_slice());
            let larger = sum_of_magnitudes(candidate.as_slice());
            if larger <= norm {
                break;
            }
            norm = larger;
            image = candidate;
        }
        // Vector of alternating signs, for the matrices on which the search above is misled.
        let mut alternating = zero_vector(dimension);
        let mut total = T::ZERO;
        for (place, entry) in alternating.as_mut_slice().iter_mut().enumerate() {
            let magnitude = T::ONE + T::from_f64(place as f64) / count;
            total += magnitude;
            *entry = if place % 2 == 0 {
                magnitude
            } else {
                -magnitude
            };
        }
        for entry in alternating.as_mut_slice() {
            *entry /= total;
        }
        self.solve_scaled(alternating.as_mut_slice());
        let other = sum_of_magnitudes(alternating.as_slice());
        if other > norm {
            (other, alternating)
        } else {
            (norm, image)
        }
    }

    /// Replaces the right-hand side (n) of the transposed scaled system with its solution.
    fn solve_scaled_transposed(&self, x: &mut [T]) {
        let n = self.exchanges.len();
        let columns = || self.factors.as_slice().chunks_exact(n.max(1)).enumerate();
        // Forward: Uᵀ y = b, row by row.
        for (k, column) in columns() {
            let (Some((above, rest)), Some((upper, diagonal))) =
                (x.split_at_mut_checked(k), column.split_at_checked(k))
            else {
                break;
            };
            if let (Some(entry), Some(pivot)) = (rest.first_mut(), diagonal.first()) {
                *entry = (*entry - product(above, upper)) / *pivot;
            }
        }
        // Backward: the multipliers of each column before its exchange, in the reverse order of the elimination.
        for ((k, column), distance) in columns().rev().zip(self.exchanges.as_slice().iter().rev()) {
            let (Some(active), Some(multipliers)) = (x.get_mut(k..), column.get(k + 1..)) else {
                break;
            };
            if let Some((head, tail)) = active.split_first_mut() {
                *head -= product(tail, multipliers);
            }
            exchange(active, *distance);
        }
    }
}

fn product<T: Real>(a: &[T], b: &[T]) -> T {
    let terms = a.iter().zip(b).map(|(a, b)| *a * *b);
    terms.fold(T::ZERO, |sum, term| sum + term)
}

fn sum_of_magnitudes<T: Real>(entries: &[T]) -> T {
    entries.iter().fold(T::ZERO, |sum, entry| sum + entry.abs())
}

/// Position of the first entry of largest magnitude; 0 if there is none.
pub(crate) fn position_of_largest<T: Real>(entries: &[T]) -> usize {
    let mut largest = (0, T::ZERO);
    for (place, entry) in entries.iter().enumerate() {
        if entry.abs() > largest.1 {
            largest = (place, entry.abs());
        }
    }
    largest.0
}
