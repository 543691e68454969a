//! Scales residuals and coordinates to comparable magnitudes ([`Scales`]).
//!
//! A residual in meters and one in radians cannot be compared, and neither can their derivatives. Divided by these
//! magnitudes, both are unitless, and decisions on them do not change if a mechanism is described in millimeters.

use nalgebra::allocator::Allocator;
use nalgebra::{Const, DefaultAllocator, Dim, OVector};

use crate::equations::Equations;
use crate::failure::index;
use crate::math::Real;

/// Magnitudes of all equations and coordinates of a mechanism.
#[derive(Clone, Debug, PartialEq)]
pub struct Scales<T: Real, D: Dim>
where
    DefaultAllocator: Allocator<D>,
{
    /// Magnitude of each equation's residual (n), positive.
    pub rows: OVector<T, D>,
    /// Magnitude of each coordinate's changes (n), positive.
    pub columns: OVector<T, D>,
}

/// Largest magnitude of these lengths (m), or `otherwise` if that is zero or NaN: the scale of residuals in m for a
/// mechanism whose size depends on parameters.
pub fn largest_length<T: Real, const N: usize>(lengths: &[T; N], otherwise: T) -> T {
    let largest = lengths
        .iter()
        .fold(T::ZERO, |largest, length| largest.max(length.abs()));
    if largest > T::ZERO && largest.is_finite() {
        largest
    } else {
        otherwise
    }
}

/// Scaled residual of a pose.
#[derive(Clone, Copy)]
pub(crate) struct Residual<T> {
    /// max |Φ_i| / scale_i, or the first such value that is not finite.
    pub(crate) magnitude: T,
    /// Equation with that magnitude.
    pub(crate) row: u16,
}

impl<T: Real, D: Dim> Scales<T, D>
where
    DefaultAllocator: Allocator<D>,
{
    /// Returns the magnitudes that `equations` state.
    pub fn of<E>(equations: &E) -> Self
    where
        E: Equations<T, D>,
        DefaultAllocator: Allocator<D, D>,
    {
        let dimension = equations.dimension();
        Self {
            rows: OVector::from_fn_generic(dimension, Const::<1>, |row, _| {
                equations.row_scale(row)
            }),
            columns: OVector::from_fn_generic(dimension, Const::<1>, |column, _| {
                equations.coordinate_scale(column)
            }),
        }
    }

    /// Returns magnitude 1 for all `dimension` equations and coordinates: a matrix is judged as it is.
    pub fn unit(dimension: D) -> Self {
        Self {
            rows: OVector::from_fn_generic(dimension, Const::<1>, |_, _| T::ONE),
            columns: OVector::from_fn_generic(dimension, Const::<1>, |_, _| T::ONE),
        }
    }

    /// True if every magnitude is positive and finite. Measured against any other, a residual could pass for solved.
    pub(crate) fn are_valid(&self) -> bool {
        let magnitudes = self.rows.as_slice().iter().chain(self.columns.as_slice());
        magnitudes.fold(true, |valid, magnitude| {
            valid & (*magnitude > T::ZERO) & magnitude.is_finite()
        })
    }

    /// Largest scaled residual in `phi` and its row.
    pub(crate) fn residual(&self, phi: &OVector<T, D>) -> Residual<T> {
        let mut largest = Residual {
            magnitude: T::ZERO,
            row: 0,
        };
        for (row, (value, scale)) in phi.as_slice().iter().zip(self.rows.as_slice()).enumerate() {
            let magnitude = value.abs() / *scale;
            if !magnitude.is_finite() {
                return Residual {
                    magnitude,
                    row: index(row),
                };
            }
            if magnitude > largest.magnitude {
                largest = Residual {
                    magnitude,
                    row: index(row),
                };
            }
        }
        largest
    }

    /// Length of a step in coordinate scales: max |Δq_j| / scale_j.
    pub(crate) fn step_length(&self, update: &OVector<T, D>) -> T {
        let entries = update.as_slice().iter().zip(self.columns.as_slice());
        entries.fold(T::ZERO, |longest, (entry, scale)| {
            longest.max(entry.abs() / *scale)
        })
    }

    /// Distance of two vectors in coordinate scales: max |a_j - b_j| / scale_j.
    pub(crate) fn distance(&self, a: &OVector<T, D>, b: &OVector<T, D>) -> T {
        let entries = a.as_slice().iter().zip(b.as_slice());
        entries
            .zip(self.columns.as_slice())
            .fold(T::ZERO, |longest, ((a, b), scale)| {
                longest.max((*a - *b).abs() / *scale)
            })
    }

    /// True if no coordinate of two poses differs by more than `fraction` of its scale.
    pub(crate) fn close(&self, a: &OVector<T, D>, b: &OVector<T, D>, fraction: T) -> bool {
        let entries = a.as_slice().iter().zip(b.as_slice());
        entries
            .zip(self.columns.as_slice())
            .all(|((a, b), scale)| (*a - *b).abs() <= fraction * *scale)
    }

    /// True if no entry of `update` exceeds `fraction` of its coordinate or of its scale, whichever is larger.
    pub(crate) fn negligible(
        &self,
        update: &OVector<T, D>,
        pose: &OVector<T, D>,
        fraction: T,
    ) -> bool {
        let entries = update.as_slice().iter().zip(pose.as_slice());
        entries
            .zip(self.columns.as_slice())
            .all(|((entry, q), scale)| entry.abs() <= fraction * q.abs().max(*scale))
    }

    /// True if no coordinate of two poses differs by more than `fraction` of its value or of its scale, whichever is
    /// larger.
    pub(crate) fn coincide(&self, a: &OVector<T, D>, b: &OVector<T, D>, fraction: T) -> bool {
        let entries = a.as_slice().iter().zip(b.as_slice());
        entries
            .zip(self.columns.as_slice())
            .all(|((a, b), scale)| (*a - *b).abs() <= fraction * a.abs().max(*scale))
    }
}
