//! Measures the distance of a matrix from singular, independent of units.
//!
//! The columns of a Jacobian are measured in different units, and a short link makes a short column without being any
//! closer to a singular pose. Both numbers therefore belong to Ĵ, the matrix with columns of length 1. The inverse of
//! such a matrix tells for each column the angle to the plane of all others: the length of row k of Ĵ⁻¹ is 1/sin θ_k
//! (van der Sluis, *Numerische Mathematik* 14 (1969), 14-23, for why equal columns are next to the best choice). All
//! closed forms have two columns. Then θ is the angle between two links, and both numbers are its sine.

use nalgebra::allocator::Allocator;
use nalgebra::{DefaultAllocator, Dim, OMatrix};

use super::Factorization;
use crate::math::Real;
use crate::vector::zero_vector;

/// Distance of a square matrix from singular: both numbers are 0 for a singular matrix, and 1 in magnitude for
/// perpendicular columns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measure<T = f64> {
    /// Determinant divided by the lengths of all columns (Hadamard's ratio), from -1 to 1.
    pub determinant: T,
    /// √n / ‖Ĵ⁻¹‖_F, from 0 to 1: the reciprocal condition n / (‖Ĵ‖_F ‖Ĵ⁻¹‖_F) of the matrix with columns of length 1. It is
    /// at least the smallest singular value of that matrix, and at most √n times as large.
    pub reciprocal_condition: T,
}

impl<T: Real> Measure<T> {
    /// Returns the measure of two columns that enclose an angle with this sine.
    #[inline]
    pub fn sine(sine: T) -> Self {
        Self {
            determinant: sine,
            reciprocal_condition: sine.abs(),
        }
    }

    /// Returns the measure of a single equation for a single unknown, which encloses no angle: its scaled slope, or 1
    /// for larger slopes.
    #[inline]
    pub fn slope(slope: T) -> Self {
        Self::sine(slope / slope.abs().max(T::ONE))
    }
}

impl<T: Real, D: Dim> Factorization<T, D>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    /// Measures the distance of the scaled matrix from singular; only the directions of its columns count.
    ///
    /// `matrix` (n × n) is the matrix that was factorized, which is not kept. A single equation encloses no angle: its
    /// measure is its scaled slope. An empty matrix has 1; if the inverse overflows, the reciprocal condition is 0.
    ///
    /// # Work
    /// n solves.
    ///
    /// # Panics
    /// If the matrix does not have the dimension of the factorization, which only a dynamic dimension permits.
    pub fn measure(&self, matrix: &OMatrix<T, D, D>) -> Measure<T> {
        let (dimension, _) = self.factors.shape_generic();
        let n = dimension.value();
        assert!(
            matrix.as_slice().len() == self.factors.as_slice().len(),
            "the matrix must be the one that was factorized"
        );
        if let [slope] = self.factors.as_slice() {
            return Measure::slope(*slope);
        }
        let mut lengths = zero_vector(dimension);
        let columns = matrix.as_slice().chunks_exact(n.max(1));
        let columns = columns.zip(self.column_factors.as_slice());
        for (length, (column, column_factor)) in lengths.as_mut_slice().iter_mut().zip(columns) {
            let mut square = T::ZERO;
            for (entry, row_factor) in column.iter().zip(self.row_factors.as_slice()) {
                let scaled = *entry * (*row_factor * *column_factor);
                square += scaled * scaled;
            }
            *length = square.sqrt();
        }
        let mut determinant = T::ONE;
        let factors = self.factors.as_slice().chunks_exact(n.max(1)).enumerate();
        let sizes = lengths.as_slice().iter().zip(self.exchanges.as_slice());
        for ((k, column), (length, distance)) in factors.zip(sizes) {
            if let Some(pivot) = column.get(k) {
                let part = *pivot / *length;
                determinant *= if *distance == 0 { part } else { -part };
            }
        }
        let mut square = T::ZERO;
        for k in 0..n {
            let mut column = zero_vector(dimension);
            if let Some(entry) = column.as_mut_slice().get_mut(k) {
                *entry = T::ONE;
            }
            self.solve_scaled(column.as_mut_slice());
            for (entry, length) in column.as_slice().iter().zip(lengths.as_slice()) {
                square += (*entry * *length) * (*entry * *length);
            }
        }
        let ratio = if n == 0 {
            T::ONE
        } else {
            (T::from_f64(n as f64) / square).sqrt()
        };
        // Rounding may leave a little more than the limits.
        Measure {
            determinant: determinant.max(-T::ONE).min(T::ONE),
            reciprocal_condition: if ratio.is_finite() {
                ratio.min(T::ONE)
            } else {
                T::ZERO
            },
        }
    }
}
