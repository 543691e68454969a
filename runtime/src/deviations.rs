//! Inflates deviation bounds until an operator maps them into themselves.

use nalgebra::allocator::Allocator;
use nalgebra::{DefaultAllocator, Dim, OVector};

use crate::math::Real;
use crate::vector::add;

/// Multiple of the least deviations that is tried first.
const FIRST: f64 = 2.0;

/// Factor of deviations that the operator does not map into themselves (ε-inflation; Rump, Acta Numerica 2010, section
/// 10.5).
const INFLATION: f64 = 1.25;
/// Largest number of inflations.
const WIDENED: u8 = 8;

/// Round from which on deviations must approach being mapped into themselves.
const SETTLED: u8 = 2;

/// Deviations of n unknowns that contain their image under the operator and its remainder on the chord, `least` (n).
///
/// # Errors
/// Returns the row that misses the condition by most without such deviations.
pub(crate) fn settled<T: Real, D: Dim>(
    least: &OVector<T, D>,
    mut spread: impl FnMut(&OVector<T, D>) -> OVector<T, D>,
) -> Result<OVector<T, D>, usize>
where
    DefaultAllocator: Allocator<D>,
{
    // If a map least + k R + a R² of one deviation takes any R into itself, the largest such R is 2 least or more.
    let mut deviations = scaled(least, FIRST);
    let (mut farthest, mut before) = (0, T::ZERO);
    for round in 0..WIDENED {
        let mut needed = spread(&deviations);
        add(&mut needed, least);
        let mut largest = T::ONE;
        let mut is_inside = true;
        let both = needed.as_slice().iter().zip(deviations.as_slice());
        for (row, (needed, deviation)) in both.enumerate() {
            // Written so that NaN and infinite bounds are refused.
            is_inside &= needed <= deviation && deviation.is_finite();
            let is_nearer = *needed <= largest * *deviation;
            if !is_nearer {
                (farthest, largest) = (row, *needed / *deviation);
            }
        }
        if is_inside {
            // The image of the deviations contains the solution as well.
            return Ok(needed);
        }
        // The first two rounds show the effects of the unknowns on each other; deviations that keep growing after that
        // have no bound.
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
