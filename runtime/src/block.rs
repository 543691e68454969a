//! Solves one block for its next frame, from its last frame and its assembly mode.
//!
//! A block without a closed form has its equations at one time only, because the blocks before it have just been solved
//! for that time. It therefore takes one step, and refuses it if the determinant changes its sign or Newton-Raphson
//! does not contract. The mechanism as a whole then takes shorter steps ([`crate::substeps`]). [`crate::guard`]
//! verifies for all blocks together that a frame lies on the path of the last one.

use nalgebra::allocator::Allocator;
use nalgebra::{DefaultAllocator, Dim, OVector};

use crate::closed_form::Branch;
use crate::equations::Equations;
use crate::failure::Failure;
use crate::kinematics::{Frame, advance_watched, factorize};
use crate::linear::Measure;
use crate::math::Real;
use crate::scale::Scales;
use crate::settings::Settings;
use crate::vector::{zero_matrix, zero_vector};
use crate::watch::{Measuring, OnBranch};

/// Kind of the frame from which a block is solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// Estimate of the pose, which may be poor.
    Estimate,
    /// Last frame of a motion, which continues from there.
    LastFrame,
}

/// Solves a block at time `t`.
///
/// From an estimate it is assembled in the mode `branch`, or near the estimate if that is `None`. Angles are near those
/// of the estimate if the equations do not count their turns; afterwards `branch` is its mode. From the last frame it
/// advances in this mode.
///
/// # Errors
/// Returns those of [`Frame::assemble_from_rough_estimate`], or those of [`Frame::advance`] and
/// [`WrongBranch`](crate::FailureKind::WrongBranch).
///
/// # Work
/// That of these functions; if the mode was `None`, one more Jacobian; and for an assembly at most n + 1 evaluations of
/// the residual.
///
/// # Panics
/// If a vector does not have the dimension of the equations, which only a dynamic dimension permits.
#[inline]
pub fn solve<T: Real, D: Dim, E: Equations<T, D>>(
    equations: &E,
    last: &Frame<T, D>,
    start: Start,
    branch: &mut Option<Branch>,
    t: T,
    settings: &Settings<T>,
) -> Result<Frame<T, D>, Failure<T>>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    match (start, *branch) {
        (Start::LastFrame, Some(branch)) => {
            advance_watched(equations, last, t, settings, OnBranch::new(branch))
        }
        _ => assemble(equations, last, branch, t, settings),
    }
}

/// Solves a block as [`solve`] does; afterwards `measure` is the distance of the Jacobian at the new pose from
/// singular.
///
/// # Errors
/// Returns those of [`solve`].
///
/// # Work
/// That of [`solve`] and of `Factorization::measure`; after an assembly also one Jacobian.
///
/// # Panics
/// If a vector does not have the dimension of the equations, which only a dynamic dimension permits.
#[inline]
pub fn solve_measured<T: Real, D: Dim, E: Equations<T, D>>(
    equations: &E,
    last: &Frame<T, D>,
    start: Start,
    branch: &mut Option<Branch>,
    t: T,
    settings: &Settings<T>,
    measure: &mut Measure<T>,
) -> Result<Frame<T, D>, Failure<T>>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    match (start, *branch) {
        (Start::LastFrame, Some(branch)) => advance_watched(
            equations,
            last,
            t,
            settings,
            Measuring::new(branch, measure),
        ),
        _ => assemble_measured(equations, last, branch, t, settings, measure),
    }
}

#[cold]
fn assemble_measured<T: Real, D: Dim, E: Equations<T, D>>(
    equations: &E,
    estimate: &Frame<T, D>,
    branch: &mut Option<Branch>,
    t: T,
    settings: &Settings<T>,
    measure: &mut Measure<T>,
) -> Result<Frame<T, D>, Failure<T>>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let frame = assemble(equations, estimate, branch, t, settings)?;
    let mut jacobian = zero_matrix(equations.dimension());
    equations.jacobian(&frame.q, t, &mut jacobian);
    *measure = factorize(equations, &frame.q, t, settings)?.measure(&jacobian);
    Ok(frame)
}

#[cold]
fn assemble<T: Real, D: Dim, E: Equations<T, D>>(
    equations: &E,
    estimate: &Frame<T, D>,
    branch: &mut Option<Branch>,
    t: T,
    settings: &Settings<T>,
) -> Result<Frame<T, D>, Failure<T>>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let mut frame =
        Frame::assemble_from_rough_estimate(equations, &estimate.q, *branch, t, settings)?;
    unwind(equations, &mut frame.q, &estimate.q, t, settings);
    if branch.is_none() {
        *branch = Some(Frame::branch_of(equations, &frame.q, t, settings)?);
    }
    Ok(frame)
}

/// Removes whole turns from angles that a search from far away has wound up, if the equations hold without them: from
/// all together, otherwise one by one. A rack counts the turns of its wheel.
fn unwind<T: Real, D: Dim, E: Equations<T, D>>(
    equations: &E,
    q: &mut OVector<T, D>,
    near: &OVector<T, D>,
    t: T,
    settings: &Settings<T>,
) where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let turn = T::from_f64(core::f64::consts::TAU);
    let whole = |column: usize, angle: T| match near.as_slice().get(column) {
        Some(near) if equations.is_angle(column) => turn * ((angle - *near) / turn).round(),
        _ => T::ZERO,
    };
    let each = (0..q.len()).map(Some);
    for only in core::iter::once(None).chain(each) {
        let mut trial = q.clone();
        for (column, angle) in trial.as_mut_slice().iter_mut().enumerate() {
            if only.is_none_or(|it| it == column) {
                *angle -= whole(column, *angle);
            }
        }
        if trial == *q {
            // The equations hold without the turns of all angles.
            if only.is_none() {
                return;
            }
            continue;
        }
        let mut phi = zero_vector(equations.dimension());
        equations.residual(&trial, t, &mut phi);
        if Scales::of(equations).residual(&phi).magnitude <= settings.tolerance {
            *q = trial;
        }
    }
}
