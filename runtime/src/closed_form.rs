//! Assembly modes and failures of closed-form blocks.
//!
//! A closed form takes the square root of a quantity that is positive while the links span the distance between their
//! far pins.

use crate::failure::{Failure, FailureKind, index};
use crate::math::Real;

/// Sign of a block's determinant.
///
/// A block with a closed form has two assembly modes, one of each sign. A block of Newton-Raphson may have several
/// poses of either sign. On a motion without singular poses the sign does not change.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Branch {
    /// Negative determinant of the block.
    Negative,
    /// Positive determinant of the block.
    Positive,
}

impl Branch {
    /// Returns +1 or −1.
    #[inline]
    pub fn sign<T: Real>(self) -> T {
        match self {
            Branch::Negative => -T::ONE,
            Branch::Positive => T::ONE,
        }
    }

    /// Returns the other branch.
    #[must_use]
    pub fn opposite(self) -> Self {
        match self {
            Branch::Negative => Branch::Positive,
            Branch::Positive => Branch::Negative,
        }
    }
}

/// Assembly mode of a block.
pub trait Mode: Sized {
    /// Mode beyond a change point; `None` if it is unknown.
    fn other(self) -> Option<Self>;
}

impl Mode for Branch {
    fn other(self) -> Option<Self> {
        Some(self.opposite())
    }
}

impl Mode for Option<Branch> {
    fn other(self) -> Option<Self> {
        self.map(|branch| Some(branch.opposite()))
    }
}

/// Multiple of ε below which the square of a sine is rounding: links that enclose an angle of less than about 6e-8 rad
/// (f64) are collinear.
pub const FOLD: f64 = 16.0;

/// Multiple of the smallest normal number below which the square of a half chord is no longer rounded in proportion:
/// the fourth powers of the links have left the range of the scalar.
pub const UNDERFLOW: f64 = 8.0;

/// True if the square of a half chord is a normal number and safely positive relative to `scale`. False for NaN.
#[inline]
pub fn exceeds_rounding<T: Real>(excess: T, scale: T) -> bool {
    excess > T::from_f64(FOLD) * T::EPSILON * scale + T::from_f64(UNDERFLOW) * T::MIN_POSITIVE
}

/// Failure of links in a closed-form block that do not span the distance (m) between their far pins; `longest` and
/// `shortest` bound the distances that they can span. If the distance is within these bounds, the links are collinear
/// and the block is singular.
#[cold]
pub fn out_of_reach<T: Real>(
    distance: T,
    longest: T,
    shortest: T,
    time: T,
    block: u16,
) -> Failure<T> {
    let shortest = shortest.abs();
    let kind = if !(distance.is_finite() && longest.is_finite() && shortest.is_finite()) {
        FailureKind::NotFinite
    } else if distance > longest {
        FailureKind::OutOfReach {
            by: distance - longest,
        }
    } else if distance < shortest {
        FailureKind::OutOfReach {
            by: shortest - distance,
        }
    } else {
        FailureKind::Singular {
            pivot_ratio: T::ZERO,
            column: 0,
        }
    };
    failed(kind, time, block)
}

/// Failure of a closed-form block that is singular because a divisor has vanished relative to `scale`.
#[cold]
pub fn singular_divisor<T: Real>(value: T, scale: T, time: T, block: u16) -> Failure<T> {
    let kind = FailureKind::Singular {
        pivot_ratio: value / scale,
        column: 0,
    };
    failed(kind, time, block)
}

/// Failure of a driven length that is not positive, by its index among the quantities that must be positive.
#[cold]
pub fn not_positive<T: Real>(value: T, time: T, place: u16) -> Failure<T> {
    failed(FailureKind::NotPositive { value }, time, place)
}

/// Failure of a closed-form block, which takes no iterations and leaves no residual.
#[cold]
pub fn failed<T: Real>(kind: FailureKind<T>, time: T, block: u16) -> Failure<T> {
    Failure {
        kind,
        time,
        block,
        iterations: 0,
        residual: T::ZERO,
        row: 0,
        input: None,
    }
}

/// True if every value is finite.
///
/// Zero times infinity or NaN is NaN, and a sum with NaN is NaN. Eight independent sums let the processor work on
/// several values at once; their total takes one comparison.
#[inline]
pub fn all_finite<T: Real, const N: usize>(values: &[T; N]) -> bool {
    let mut sums = [T::ZERO; 8];
    let mut chunks = values.chunks_exact(8);
    for chunk in &mut chunks {
        for (sum, value) in sums.iter_mut().zip(chunk) {
            *sum += T::ZERO * *value;
        }
    }
    for (sum, value) in sums.iter_mut().zip(chunks.remainder()) {
        *sum += T::ZERO * *value;
    }
    let [a, b, c, d, e, f, g, h] = sums;
    ((a + b) + (c + d)) + ((e + f) + (g + h)) == T::ZERO
}

/// Failure of a block with a value that is not finite.
#[cold]
pub fn not_finite<T: Real>(time: T, block: u16) -> Failure<T> {
    failed(FailureKind::NotFinite, time, block)
}

/// Ascribes a failure of a frame with a value that is not finite to the first such load. `read` holds the values that
/// loads follow from, `loads` one value of each, and `block` uses them. Other failures stay unchanged, and so does that
/// of a pose that is not finite.
#[cold]
pub fn load_not_finite<T: Real>(
    failure: Failure<T>,
    read: &[T],
    loads: &[T],
    block: u16,
) -> Failure<T> {
    let is_sound = read.iter().all(|value| value.is_finite());
    let load = loads.iter().position(|value| !value.is_finite());
    match load {
        Some(load) if is_sound && failure.kind == FailureKind::NotFinite => {
            let load = index(load);
            failed(FailureKind::LoadNotFinite { load }, failure.time, block)
        }
        _ => failure,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_value_that_is_no_number_is_found_at_every_place() {
        let numbers = [1.5_f64; 19];
        assert!(all_finite(&numbers) && all_finite::<f32, 0>(&[]));
        for place in 0..19 {
            for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                let mut values = numbers;
                values[place] = bad;
                assert!(!all_finite(&values), "{bad} at {place}");
            }
        }
    }

    #[test]
    fn an_infinite_load_is_named_where_the_pose_is_sound() {
        let infinite = not_finite(0.5_f64, 0);
        let kind =
            |failure, read: &[f64], loads: &[f64]| load_not_finite(failure, read, loads, 3).kind;
        let named = FailureKind::LoadNotFinite { load: 1 };
        assert_eq!(
            kind(infinite, &[1.0], &[2.0, f64::NAN, f64::INFINITY]),
            named
        );
        assert_eq!(kind(infinite, &[1.0], &[2.0, 3.0]), FailureKind::NotFinite);
        assert_eq!(
            kind(infinite, &[f64::NAN], &[f64::NAN]),
            FailureKind::NotFinite
        );
        let singular = singular_divisor(0.0, 1.0, 0.5, 2);
        assert_eq!(load_not_finite(singular, &[1.0], &[f64::NAN], 3), singular);
        let named = load_not_finite(infinite, &[], &[f64::NEG_INFINITY], 3);
        assert_eq!((named.block, named.time), (3, 0.5));
    }

    #[test]
    fn a_gap_is_told_from_links_in_line() {
        let by = |distance, longest, shortest| {
            out_of_reach(distance, longest, shortest, 0.5_f64, 3).kind
        };
        assert_eq!(by(3.0, 2.5, 0.5), FailureKind::OutOfReach { by: 0.5 });
        assert_eq!(by(0.25, 2.5, -0.5), FailureKind::OutOfReach { by: 0.25 });
        assert!(matches!(by(2.5, 2.5, 0.5), FailureKind::Singular { .. }));
        assert_eq!(by(f64::NAN, 2.5, 0.5), FailureKind::NotFinite);
        assert!(
            !exceeds_rounding(f64::NAN, 1.0)
                && !exceeds_rounding(1e-16, 1.0)
                && exceeds_rounding(1e-14, 1.0)
        );
        // The product of subnormal squares has lost its digits.
        assert!(exceeds_rounding(1e-306, 1e-306) && !exceeds_rounding(1e-310, 1e-310));
        assert!(exceeds_rounding(1e-36_f32, 1e-36) && !exceeds_rounding(1e-38_f32, 1e-38));
    }
}
