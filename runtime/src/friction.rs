//! Solves for the forces of Coulomb friction in joints.
//!
//! The reaction of a joint with friction has two components p, which are linear in the forces of friction f of all joints: p = p₀ + Σ uⱼ fⱼ,
//! with the components p₀ without friction and u to a unit of each. The force is f = c |p|: the coefficient c has the sign of what resists
//! sliding. The magnitude |p| is √(p₁² + p₂²) of a pin, and |p₁| + |p₂| of a slide.
//!
//! The iteration begins without friction. Each step solves the equations with the magnitudes linearized at the reactions of the last step,
//! so that it also settles where simple substitution would oscillate.

use nalgebra::allocator::Allocator;
use nalgebra::{Const, DefaultAllocator, Dim, OMatrix, OVector, SVector, U1};

use crate::closed_form::failed;
use crate::failure::{Failure, FailureKind};
use crate::math::Real;
use crate::multipliers;
use crate::vector::all_finite;

/// Largest number of steps.
pub const STEPS: usize = 32;

/// Largest change in the last step of forces that have settled, relative to the largest force.
pub const SETTLED: f64 = 1e-10;

/// Largest change in the last step of settled forces, in roundings of the scalar, if that is larger.
pub const SETTLED_ROUNDINGS: f64 = 32.0;

/// Change of forces after which no further step is taken, in roundings of the scalar.
const ROUNDINGS: f64 = 4.0;

/// Factor by which a change must shrink for another step after the forces have settled.
const SHRINKS: f64 = 0.5;

/// Returns the force of friction in each joint, pins before slides. `units[k][j]` are the components of joint k to a unit of the force of
/// joint j.
///
/// # Errors
/// Returns [`FailureKind::FrictionUnsettled`] if the forces do not settle, and [`FailureKind::NotFinite`] if they are not finite.
pub fn friction<T: Real, const N: usize>(
    pins: usize,
    coefficients: [T; N],
    alone: [[T; 2]; N],
    units: [[[T; 2]; N]; N],
    time: T,
    block: u16,
) -> Result<[T; N], Failure<T>> {
    let coefficients = SVector::<T, N>::from(coefficients);
    let forces = settle::<T, Const<N>>(pins, &coefficients, &alone, units.as_flattened());
    let forces = forces.map_err(|kind| failed(kind, time, block))?;
    Ok(forces.into())
}

/// Returns the force of friction in each joint, in any dimension; `units` are those of one joint after the other.
///
/// # Errors
/// Returns those of [`friction`].
pub fn settle<T: Real, D: Dim>(
    pins: usize,
    coefficients: &OVector<T, D>,
    alone: &[[T; 2]],
    units: &[[T; 2]],
) -> Result<OVector<T, D>, FailureKind<T>>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let (dimension, _) = coefficients.shape_generic();
    let count = dimension.value().max(1);
    let zeros = || OVector::<T, D>::from_element_generic(dimension, U1, T::ZERO);
    let mut matrix = OMatrix::<T, D, D>::from_element_generic(dimension, dimension, T::ZERO);
    let (mut forces, mut next, mut change) = (zeros(), zeros(), zeros());
    let settled = T::from_f64(SETTLED).max(T::from_f64(SETTLED_ROUNDINGS) * T::EPSILON);
    let mut last = T::from_f64(f64::INFINITY);
    let mut relative = last;
    for _ in 0..STEPS {
        let joints = coefficients
            .iter()
            .zip(alone)
            .zip(units.chunks_exact(count));
        for (joint, ((&coefficient, &[first, second]), units)) in joints.enumerate() {
            let (mut first, mut second) = (first, second);
            for (unit, &force) in units.iter().zip(forces.iter()) {
                first += unit[0] * force;
                second += unit[1] * force;
            }
            let (magnitude, slopes) = match joint < pins {
                true => of_pin(first, second),
                false => of_slide(first, second),
            };
            // The linear solve takes the transposed matrix.
            let row = matrix.column_mut(joint);
            for ((place, entry), unit) in row.into_iter().enumerate().zip(units) {
                let slope = coefficient * (slopes[0] * unit[0] + slopes[1] * unit[1]);
                let diagonal = if place == joint { T::ONE } else { T::ZERO };
                *entry = diagonal - slope;
            }
            if let (Some(next), Some(force), Some(change)) = (
                next.get_mut(joint),
                forces.get(joint),
                change.get_mut(joint),
            ) {
                *next = coefficient * magnitude;
                *change = *next - *force;
            }
        }
        if !(all_finite(next.as_slice()) && all_finite(change.as_slice())) {
            return Err(FailureKind::NotFinite);
        }
        let largest = |values: &OVector<T, D>| {
            let magnitudes = values.iter().map(|it| it.abs());
            magnitudes.fold(T::ZERO, T::max)
        };
        let (size, largest_change) = (largest(&next), largest(&change));
        if largest_change <= T::from_f64(ROUNDINGS) * T::EPSILON * size {
            return Ok(next);
        }
        relative = largest_change / size.max(T::MIN_POSITIVE);
        if relative <= settled && largest_change > T::from_f64(SHRINKS) * last {
            return Ok(next);
        }
        last = largest_change;
        match multipliers::solve::<T, D>(&matrix, &mut change) {
            Ok(()) => forces += &change,
            Err(_) => forces.copy_from(&next),
        }
    }
    match relative <= settled {
        true => Ok(next),
        false => Err(FailureKind::FrictionUnsettled { change: relative }),
    }
}

/// Returns the magnitude of the force in a pin, and its derivatives in both components.
fn of_pin<T: Real>(first: T, second: T) -> (T, [T; 2]) {
    let magnitude = (first * first + second * second).sqrt();
    match magnitude > T::ZERO {
        true => (magnitude, [first / magnitude, second / magnitude]),
        false => (magnitude, [T::ZERO; 2]),
    }
}

/// Returns the sum of the magnitudes of both forces on a slide, and its derivatives.
fn of_slide<T: Real>(first: T, second: T) -> (T, [T; 2]) {
    let sign = |force: T| match (force > T::ZERO, force < T::ZERO) {
        (true, _) => T::ONE,
        (_, true) => -T::ONE,
        _ => T::ZERO,
    };
    (first.abs() + second.abs(), [sign(first), sign(second)])
}

#[cfg(test)]
mod tests {
    use super::{SETTLED, friction};
    use crate::FailureKind;

    /// Force of one slide whose normal force is p₀ + u f.
    fn of_one(coefficient: f64, alone: f64, unit: f64) -> Result<f64, FailureKind> {
        let settled = friction(0, [coefficient], [[alone, 0.0]], [[[unit, 0.0]]], 0.0, 0);
        settled.map(|[force]| force).map_err(|it| it.kind)
    }

    #[test]
    fn a_slide_that_friction_loads_has_the_geometric_series() {
        for (coefficient, unit) in [
            (0.1, 2.0),
            (0.1, -2.0),
            (0.3, 3.0),
            (-0.3, 3.0),
            (0.9, -8.0),
        ] {
            let expected = coefficient * 5.0 / (1.0 - coefficient * unit);
            let force = of_one(coefficient, 5.0, unit).expect("it settles");
            assert!((force - expected).abs() < 1e-15 * expected.abs(), "{force}");
        }
    }

    #[test]
    fn a_slide_that_friction_jams_does_not_settle() {
        for (coefficient, alone, unit) in [(0.5, 5.0, 3.0), (-0.5, 5.0, -3.0), (0.5, -5.0, -2.5)] {
            let failure = of_one(coefficient, alone, unit).expect_err("no force balances");
            let FailureKind::FrictionUnsettled { change } = failure else {
                panic!("{failure:?}");
            };
            assert!(change > SETTLED);
        }
    }

    #[test]
    fn nothing_acts_without_a_coefficient_or_a_reaction() {
        assert_eq!(of_one(0.0, 5.0, 3.0), Ok(0.0));
        assert_eq!(of_one(0.5, 0.0, 3.0), Ok(0.0));
        assert_eq!(of_one(0.5, f64::NAN, 3.0), Err(FailureKind::NotFinite));
        let none: [f64; 0] = friction(0, [], [], [], 0.0, 0).expect("nothing to do");
        assert!(none.is_empty());
    }

    #[test]
    fn single_precision_settles_to_its_rounding() {
        let settled = friction(1, [0.2_f32], [[3.0, 4.0]], [[[1.5, -0.5]]], 0.0, 0);
        let [force] = settled.expect("it settles");
        let expected = 0.2 * f32::hypot(3.0 + 1.5 * force, 4.0 - 0.5 * force);
        assert!((force - expected).abs() < 4.0 * f32::EPSILON, "{force}");
        let jammed = friction(0, [0.5_f32], [[5.0, 0.0]], [[[3.0, 0.0]]], 0.0, 0);
        let kind = jammed.map_err(|it| it.kind);
        assert!(matches!(kind, Err(FailureKind::FrictionUnsettled { .. })));
    }

    #[test]
    fn pins_that_load_one_another_balance() {
        let (coefficients, alone) = ([0.1, -0.2], [[3.0, 4.0], [-1.0, 2.0]]);
        let units = [[[0.5, -1.0], [1.5, 0.5]], [[-2.0, 1.0], [0.5, 0.25]]];
        let forces = friction(2, coefficients, alone, units, 0.0, 0).expect("it settles");
        for joint in 0..2 {
            let component = |axis: usize| {
                let of_units = [0, 1].map(|unit| units[joint][unit][axis] * forces[unit]);
                alone[joint][axis] + of_units[0] + of_units[1]
            };
            let expected = coefficients[joint] * f64::hypot(component(0), component(1));
            assert!((forces[joint] - expected).abs() < 1e-15, "{forces:?}");
        }
    }
}
