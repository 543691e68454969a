//! Solves equations for the pose at a time by Newton-Raphson, from an estimate; otherwise returns a typed [`Failure`].
//!
//! This is the only Newton-Raphson of the project. A pose in an `Ok` has a residual that was evaluated *at this pose*
//! and meets the tolerance; on failure the caller's pose is unchanged. A call takes at most [`Settings::iterations`]
//! steps and one polishing step.
//!
//! Each step solves Φ_q Δq = -Φ and adds Δq (Haug 1989, section 4.5). Residuals are measured in row scales, steps in
//! coordinate scales, so no decision depends on the units. A step may leave a residual above the tolerance. The solver
//! then checks in this order that all values are finite, and that the iteration has not stalled, diverged or begun to
//! cycle.

use nalgebra::allocator::Allocator;
use nalgebra::{DefaultAllocator, Dim, OMatrix, OVector};

use crate::equations::Equations;
use crate::failure::{Failure, FailureKind};
use crate::linear::Factorization;
use crate::math::Real;
use crate::progress::Progress;
use crate::regularity;
use crate::scale::{Residual, Scales};
use crate::settings::Settings;
use crate::vector::{add, all_finite, negate, require_dimension, zero_matrix, zero_vector};
use crate::watch::{Unwatched, Watch};

/// Longest step, in coordinate scales, that still counts as progress. A body that is a million mechanism lengths away
/// does not return.
pub const LONGEST_STEP: f64 = 1e6;

/// Largest growth of the scaled residual over the first one, or over 1 if that is larger. One bad step from a poor
/// estimate may well increase the residual, but not beyond this.
pub const LARGEST_GROWTH: f64 = 1e4;

/// Number of consecutive steps with growing residual that count as divergence.
pub const GROWING_STEPS: u16 = 5;

/// Multiple of ε below which a change of a coordinate, or a residual, is rounding.
pub const ROUNDING: f64 = 4.0;

/// Part of the residual above which a polishing step ends a solve: the remaining residual is rounding. At a pose whose
/// Jacobian is singular, a step leaves at most e^(-1/e) = 0.69 of the residual.
pub const NOISE: f64 = 0.75;

/// Newton-Raphson step with all quantities of a calculation by hand.
#[derive(Clone, Debug, PartialEq)]
pub struct Step<T: Real, D: Dim>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    /// Jacobian Φ_q (n × n) at the pose before the step.
    pub jacobian: OMatrix<T, D, D>,
    /// Right-hand side -Φ (n).
    pub right_hand_side: OVector<T, D>,
    /// Update Δq (n), which solves Φ_q Δq = -Φ.
    pub update: OVector<T, D>,
    /// New pose q + Δq (n).
    pub pose: OVector<T, D>,
}

/// Convergence of a solve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Convergence<T = f64> {
    /// Number of steps until the tolerance was met, without the polishing step.
    pub iterations: u16,
    /// Scaled residual at the returned pose.
    pub residual: T,
    /// Equation with that residual, counted from 0.
    pub row: u16,
    /// True if a polishing step was taken.
    pub polished: bool,
}

/// Takes a single Newton-Raphson step from the pose `q` (n) at time `t`.
///
/// The residual is not compared with the tolerance: this is the step as taught, for display.
///
/// # Errors
/// Returns [`FailureKind::Singular`] or [`FailureKind::NotFinite`].
///
/// # Panics
/// If `q` does not have the dimension of the equations, which only a dynamic dimension permits.
pub fn step<T: Real, D: Dim, E: Equations<T, D>>(
    equations: &E,
    q: &OVector<T, D>,
    t: T,
    settings: &Settings<T>,
) -> Result<Step<T, D>, Failure<T>>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let dimension = equations.dimension();
    require_dimension(q, dimension);
    let scales = Scales::of(equations);
    let mut right_hand_side = zero_vector(dimension);
    let mut jacobian = zero_matrix(dimension);
    equations.residual(q, t, &mut right_hand_side);
    let residual = scales.residual(&right_hand_side);
    negate(&mut right_hand_side);
    let fail = |kind| failure(kind, t, 0, residual);
    let finite = all_finite(q.as_slice()) && residual.magnitude.is_finite();
    if !(t.is_finite() && scales.are_valid() && finite) {
        return Err(fail(FailureKind::NotFinite));
    }
    equations.jacobian(q, t, &mut jacobian);
    let factorization =
        Factorization::new(&jacobian, &scales, settings.pivot_ratio).map_err(fail)?;
    let mut update = right_hand_side.clone();
    factorization.solve(&mut update);
    let mut pose = q.clone();
    add(&mut pose, &update);
    if !all_finite(pose.as_slice()) {
        return Err(fail(FailureKind::NotFinite));
    }
    Ok(Step {
        jacobian,
        right_hand_side,
        update,
        pose,
    })
}

/// Moves the estimate `q` (n) to a pose at which the equations hold at time `t`.
///
/// At the returned pose, no scaled residual |Φ_i| / scale_i exceeds [`Settings::tolerance`]. With [`Settings::polish`]
/// one more step follows, unless the residual is at rounding level already. It reuses the newest factorization, whose
/// error is of the order of the last update and so usually too small to matter; it is taken back if the residual grows.
/// If it does not bring the residual to rounding level, steps with Jacobians at the pose itself follow. They end with a
/// step that leaves more than the part [`NOISE`] of the residual: then only the rounding of the equations is left.
///
/// A small residual alone does not tell whether the pose has settled, for x² = 1e-12 says little about x. A polishing
/// step reduces the error by the same part as the residual. So twice the length of the step times this part estimates
/// the remaining error; the factor two allows for the older Jacobian. If the estimate exceeds the tolerance, in
/// coordinate scales, and the steps are used up, the pose is not returned. Without the polishing step, and for an
/// estimate with a residual at rounding level already, the residual alone decides; [`crate::Frame::assemble`] and
/// [`crate::Frame::advance`] judge such poses by their Jacobian.
///
/// # Work
/// With N for [`Settings::iterations`] at most N + 3 evaluations of the residual and N + 3 of the Jacobian.
///
/// # Errors
/// Returns every [`FailureKind`]; `q` is then unchanged.
///
/// # Panics
/// If `q` does not have the dimension of the equations, which only a dynamic dimension permits.
pub fn solve<T: Real, D: Dim, E: Equations<T, D>>(
    equations: &E,
    q: &mut OVector<T, D>,
    t: T,
    settings: &Settings<T>,
) -> Result<Convergence<T>, Failure<T>>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    solve_watched(equations, q, t, settings, &mut Unwatched)
}

/// Calls the solver of [`solve`], abandoned if `watch` requires it.
pub(crate) fn solve_watched<T: Real, D: Dim, E: Equations<T, D>, W: Watch<T, D>>(
    equations: &E,
    q: &mut OVector<T, D>,
    t: T,
    settings: &Settings<T>,
    watch: &mut W,
) -> Result<Convergence<T>, Failure<T>>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    require_dimension(q, equations.dimension());
    let mut pose = q.clone();
    let convergence = iterate(equations, &mut pose, t, settings, watch)?;
    *q = pose;
    Ok(convergence)
}

fn iterate<T: Real, D: Dim, E: Equations<T, D>, W: Watch<T, D>>(
    equations: &E,
    pose: &mut OVector<T, D>,
    t: T,
    settings: &Settings<T>,
    watch: &mut W,
) -> Result<Convergence<T>, Failure<T>>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let dimension = equations.dimension();
    let scales = Scales::of(equations);
    let mut phi = zero_vector(dimension);
    let mut jacobian = zero_matrix(dimension);
    let mut update = zero_vector(dimension);
    equations.residual(pose, t, &mut phi);
    let mut residual = scales.residual(&phi);
    let finite = all_finite(pose.as_slice()) && residual.magnitude.is_finite();
    if !(t.is_finite() && scales.are_valid() && finite) {
        return Err(failure(FailureKind::NotFinite, t, 0, residual));
    }
    let mut progress = Progress::new(pose, residual.magnitude);
    let mut iterations = 0;
    let mut unsettled = false;
    loop {
        let solved = residual.magnitude <= settings.tolerance;
        if solved && !worth_polishing(residual, settings) {
            return Ok(convergence(iterations, residual, false));
        }
        if (!solved || unsettled) && iterations >= settings.iterations {
            let kind = if unsettled {
                verdict(equations, pose, t, residual, &scales, settings)
            } else {
                FailureKind::IterationLimit
            };
            return Err(failure(kind, t, iterations, residual));
        }
        equations.jacobian(pose, t, &mut jacobian);
        let factorization = match Factorization::new(&jacobian, &scales, settings.pivot_ratio) {
            Ok(factorization) => factorization,
            // The pose meets the tolerance already; a singular Jacobian only prevents polishing it.
            Err(_) if solved && !unsettled => return Ok(convergence(iterations, residual, false)),
            Err(kind) => return Err(failure(kind, t, iterations, residual)),
        };
        if !solved {
            update.clone_from(&phi);
            negate(&mut update);
            factorization.solve(&mut update);
            watch
                .jacobian(&factorization)
                .and_then(|()| watch.step(&scales, &update))
                .map_err(|kind| failure(kind, t, iterations, residual))?;
            add(pose, &update);
            equations.residual(pose, t, &mut phi);
            residual = scales.residual(&phi);
            iterations += 1;
            if !(all_finite(pose.as_slice()) && residual.magnitude.is_finite()) {
                return Err(failure(FailureKind::NotFinite, t, iterations, residual));
            }
            if residual.magnitude > settings.tolerance {
                if let Some(kind) = progress.judge(&scales, pose, &update, residual.magnitude) {
                    return Err(failure(kind, t, iterations, residual));
                }
                continue;
            }
            if !worth_polishing(residual, settings) {
                return Ok(convergence(iterations, residual, false));
            }
        }
        // The pose is solved. One more step is taken unless it makes the residual larger.
        update.clone_from(&phi);
        negate(&mut update);
        factorization.solve(&mut update);
        add(&mut update, pose);
        equations.residual(&update, t, &mut phi);
        let after = scales.residual(&phi);
        let better = after.magnitude <= residual.magnitude && all_finite(update.as_slice());
        let rounding = after.magnitude <= T::from_f64(ROUNDING) * T::EPSILON;
        // Written so that a NaN residual is not an improvement.
        let improves = after.magnitude < T::from_f64(NOISE) * residual.magnitude;
        unsettled = better
            && !rounding
            && improves
            && !scales.close(
                pose,
                &update,
                T::HALF * settings.tolerance * (residual.magnitude / after.magnitude),
            );
        // Only the step of a Jacobian at this very pose shows that nothing but noise is left.
        let again = !rounding && (improves || !solved) && iterations < settings.iterations;
        if better {
            pose.clone_from(&update);
            residual = after;
        }
        if unsettled || again {
            iterations += 1;
            if !better {
                equations.residual(pose, t, &mut phi);
            }
            continue;
        }
        return Ok(convergence(iterations, residual, better));
    }
}

/// Failure of a pose that meets the tolerance and has not settled within the limit: it is singular, or there were too
/// few steps.
#[cold]
fn verdict<T: Real, D: Dim, E: Equations<T, D>>(
    equations: &E,
    pose: &OVector<T, D>,
    t: T,
    residual: Residual<T>,
    scales: &Scales<T, D>,
    settings: &Settings<T>,
) -> FailureKind<T>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let mut jacobian = zero_matrix(equations.dimension());
    equations.jacobian(pose, t, &mut jacobian);
    let regular = Factorization::new(&jacobian, scales, settings.pivot_ratio).and_then(|factors| {
        regularity::require(equations, pose, t, residual.magnitude, &jacobian, &factors)
    });
    regular.err().unwrap_or(FailureKind::IterationLimit)
}

fn worth_polishing<T: Real>(residual: Residual<T>, settings: &Settings<T>) -> bool {
    settings.polish && residual.magnitude > T::from_f64(ROUNDING) * T::EPSILON
}

fn convergence<T: Real>(iterations: u16, residual: Residual<T>, polished: bool) -> Convergence<T> {
    Convergence {
        iterations,
        residual: residual.magnitude,
        row: residual.row,
        polished,
    }
}

pub(crate) fn failure<T: Real>(
    kind: FailureKind<T>,
    time: T,
    iterations: u16,
    residual: Residual<T>,
) -> Failure<T> {
    Failure {
        kind,
        time,
        block: 0,
        iterations,
        residual: residual.magnitude,
        row: residual.row,
        input: None,
    }
}
