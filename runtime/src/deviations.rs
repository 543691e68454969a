//! What an operator leaves of a straight line, and how it spreads deviations → deviations that it maps into themselves.
//!
//! The module does not know the operator.

use nalgebra::allocator::Allocator;
use nalgebra::{DefaultAllocator, Dim, OVector};

use crate::math::Real;
use crate::vector::add;

/// The multiple of the least deviations that is tried first.
const FIRST: f64 = 2.0;

/// By how much deviations are widened that the operator does not map into themselves (ε-inflation; Rump, Acta Numerica 2010, section 10.5),
/// and how often.
const INFLATION: f64 = 1.25;
const WIDENED: u8 = 8;

/// The round from which on deviations must come nearer to being mapped into themselves.
const SETTLED: u8 = 2;

/// Deviations of n unknowns that together with what is left of the line, `least` (n), hold what the operator makes of them.
///
/// # Errors
/// The row that is farthest from it, where none are found.
pub(crate) fn settled<T: Real, D: Dim>(
    least: &OVector<T, D>,
    mut spread: impl FnMut(&OVector<T, D>) -> OVector<T, D>,
) -> Result<OVector<T, D>, usize>
where
    DefaultAllocator: Allocator<D>,
{
    // Where a map least + k R + a R² of one deviation takes any R into itself, the largest that it does so with is 2 least or more.
    let mut deviations = scaled(least, FIRST);
    let (mut farthest, mut before) = (0, T::ZERO);
    for round in 0..WIDENED {
        let mut needed = spread(&deviations);
        add(&mut needed, least);
        let mut largest = T::ONE;
        let mut is_inside = true;
        let both = needed.as_slice().iter().zip(deviations.as_slice());
        for (row, (needed, deviation)) in both.enumerate() {
            // Written so that NaN is refused, and bounds that have become infinite.
            is_inside &= needed <= deviation && deviation.is_finite();
            let is_nearer = *needed <= largest * *deviation;
            if !is_nearer {
                (farthest, largest) = (row, *needed / *deviation);
            }
        }
        if is_inside {
            // What the operator maps them to holds the solution as well.
            return Ok(needed);
        }
        // The first two rounds show what each unknown does to the others; deviations that need more and more after that have no end.
        let is_nearing = largest < before;
        if round >= SETTLED && !is_nearing {
            break;
        }
        before = largest;
        deviations = scaled(&needed, INFLATION);
    }
    Err(farthest)
}

fn scaled<T: Real, D: Dim>(vector: &OVector<T, D>, factor: f64) -> OVector<T, D>
where
    DefaultAllocator: Allocator<D>,
{
    let mut scaled = vector.clone();
    for entry in scaled.as_mut_slice() {
        *entry *= T::from_f64(factor);
    }
    scaled
}
