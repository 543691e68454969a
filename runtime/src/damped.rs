//! Solves equations from a poor estimate of the pose by Newton-Raphson with damped steps.
//!
//! From far away a full Newton-Raphson step may lead anywhere. The step is therefore shortened until it passes the
//! natural monotonicity test: the next correction, computed with the same Jacobian, must be shorter than this one.
//! Corrections are distances to the pose. Unlike residuals, they do not depend on factors of the equations. The damping
//! factor is predicted from the difference between the last corrections and those of a linear system (Deuflhard,
//! *Newton Methods for Nonlinear Problems*, 2004, section 3.3.3, algorithm NLEQ-ERR).
//!
//! The iteration stays on the side of the singular poses on which it starts, and stops at them.

use nalgebra::allocator::Allocator;
use nalgebra::{DefaultAllocator, Dim, OVector};

use crate::equations::Equations;
use crate::failure::{Failure, FailureKind};
use crate::linear::Factorization;
use crate::math::Real;
use crate::newton::{self, Convergence, failure};
use crate::scale::Scales;
use crate::settings::Settings;
use crate::vector::{all_finite, negate, require_dimension, zero_matrix, zero_vector};

/// Largest number of times that one step is shortened.
pub const SHORTENINGS: u16 = 8;

/// Smallest part of a step that is taken.
pub const SMALLEST_PART: f64 = 1e-4;

/// Ratio of two consecutive corrections, both at full length, below which plain Newton-Raphson continues.
const CONTRACTION_LIMIT: f64 = 0.25;

/// Part of the step's fraction by which the next correction must at least be shorter than this one.
const LEAST_GAIN: f64 = 0.25;

/// Moves the estimate `q` (n) to a pose at which the equations hold at time `t`, by damped steps while they are needed.
///
/// The pose is as good as that of [`newton::solve`], which finishes the iteration.
///
/// # Work
/// With N for [`Settings::iterations`] at most N (1 + [`SHORTENINGS`]) + N + 4 evaluations of the residual and 2 N + 3 of the
/// Jacobian.
///
/// # Errors
/// Returns every [`FailureKind`]; `q` is then unchanged. [`FailureKind::Stalled`] also means that no part of a step
/// brings the pose nearer, as at a singular pose between the estimate and the pose.
///
/// # Panics
/// If `q` does not have the dimension of the equations, which only a dynamic dimension permits.
pub fn solve_damped<T: Real, D: Dim, E: Equations<T, D>>(
    equations: &E,
    q: &mut OVector<T, D>,
    t: T,
    settings: &Settings<T>,
) -> Result<Convergence<T>, Failure<T>>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let dimension = equations.dimension();
    require_dimension(q, dimension);
    let scales = Scales::of(equations);
    let mut pose = q.clone();
    let mut phi = zero_vector(dimension);
    let mut jacobian = zero_matrix(dimension);
    equations.residual(&pose, t, &mut phi);
    let mut residual = scales.residual(&phi);
    let finite = all_finite(pose.as_slice()) && residual.magnitude.is_finite();
    if !(t.is_finite() && scales.are_valid() && finite) {
        return Err(failure(FailureKind::NotFinite, t, 0, residual));
    }
    // Correction of the last Jacobian at this pose, with the length of the step before and its part.
    let mut expected: Option<(OVector<T, D>, T, T)> = None;
    let mut iterations = 0;
    while residual.magnitude > settings.tolerance {
        let fail = |kind| Err(failure(kind, t, iterations, residual));
        if iterations >= settings.iterations {
            return fail(FailureKind::IterationLimit);
        }
        equations.jacobian(&pose, t, &mut jacobian);
        let factorization = match Factorization::new(&jacobian, &scales, settings.pivot_ratio) {
            Ok(factorization) => factorization,
            Err(kind) => return fail(kind),
        };
        let mut update = phi.clone();
        negate(&mut update);
        factorization.solve(&mut update);
        let length = scales.step_length(&update);
        let mut part = match &expected {
            None => T::ONE,
            Some((correction, last_length, last_part)) => {
                let linear = scales.distance(correction, &update);
                let numerator = *last_length * scales.step_length(correction) * *last_part;
                (numerator / (linear * length)).min(T::ONE)
            }
        };
        part = part.max(T::from_f64(SMALLEST_PART));
        let mut shortenings = 0;
        let (correction, ratio) = loop {
            let mut trial = pose.clone();
            for (entry, change) in trial.as_mut_slice().iter_mut().zip(update.as_slice()) {
                *entry += part * *change;
            }
            equations.residual(&trial, t, &mut phi);
            let after = scales.residual(&phi);
            let mut correction = phi.clone();
            negate(&mut correction);
            factorization.solve(&mut correction);
            let next_length = scales.step_length(&correction);
            let ratio = next_length / length;
            // Written so that NaN is not accepted.
            if ratio <= T::ONE - T::from_f64(LEAST_GAIN) * part && after.magnitude.is_finite() {
                pose = trial;
                residual = after;
                break (correction, ratio);
            }
            // Difference of the correction from that of a linear system.
            let mut linear = update.clone();
            for entry in linear.as_mut_slice() {
                *entry *= T::ONE - part;
            }
            let bend = scales.distance(&correction, &linear);
            let better = T::HALF * length * part * part / bend;
            // The smaller of the two, and the half if the other is NaN.
            part = (T::HALF * part).min(better);
            shortenings += 1;
            if part < T::from_f64(SMALLEST_PART) || shortenings > SHORTENINGS {
                return fail(FailureKind::Stalled);
            }
        };
        iterations += 1;
        if part == T::ONE && ratio < T::from_f64(CONTRACTION_LIMIT) {
            break;
        }
        expected = Some((correction, length, part));
    }
    let convergence = newton::solve(equations, &mut pose, t, settings)?;
    *q = pose;
    Ok(Convergence {
        iterations: iterations + convergence.iterations,
        ..convergence
    })
}
