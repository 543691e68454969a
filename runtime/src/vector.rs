//! Elementary operations on vectors and matrices of one dimension.
//!
//! They are written over slices with iterators, so that for a static dimension no bounds check and no panic path is
//! compiled.

use nalgebra::allocator::Allocator;
use nalgebra::{Const, DefaultAllocator, Dim, OMatrix, OVector};

use crate::math::Real;

/// Requires that `vector` has the given dimension: iterating over vectors of different lengths would silently omit the
/// excess entries. A static dimension always agrees, and the check is compiled away.
#[inline]
pub(crate) fn require_dimension<T: Real, D: Dim>(vector: &OVector<T, D>, dimension: D)
where
    DefaultAllocator: Allocator<D>,
{
    assert!(
        vector.as_slice().len() == dimension.value(),
        "a vector must have the dimension of the equations"
    );
}

/// Returns a vector of zeros (n).
pub(crate) fn zero_vector<T: Real, D: Dim>(dimension: D) -> OVector<T, D>
where
    DefaultAllocator: Allocator<D>,
{
    OVector::from_fn_generic(dimension, Const::<1>, |_, _| T::ZERO)
}

/// Returns a matrix of zeros (n × n).
pub(crate) fn zero_matrix<T: Real, D: Dim>(dimension: D) -> OMatrix<T, D, D>
where
    DefaultAllocator: Allocator<D, D>,
{
    OMatrix::from_fn_generic(dimension, dimension, |_, _| T::ZERO)
}

/// Changes the sign of every entry.
pub(crate) fn negate<T: Real, D: Dim>(vector: &mut OVector<T, D>)
where
    DefaultAllocator: Allocator<D>,
{
    for entry in vector.as_mut_slice() {
        *entry = -*entry;
    }
}

/// Adds `addend` to `sum`.
pub(crate) fn add<T: Real, D: Dim>(sum: &mut OVector<T, D>, addend: &OVector<T, D>)
where
    DefaultAllocator: Allocator<D>,
{
    for (entry, increment) in sum.as_mut_slice().iter_mut().zip(addend.as_slice()) {
        *entry += *increment;
    }
}

/// True if every entry of `values` is finite.
pub(crate) fn all_finite<T: Real>(values: &[T]) -> bool {
    // No early exit, so that the loop vectorizes.
    values
        .iter()
        .fold(true, |finite, value| finite & value.is_finite())
}
