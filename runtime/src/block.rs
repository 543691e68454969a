//! The equations of one block, its last frame and its assembly mode → its next frame.
//!
//! A block without a closed form knows its equations at one time only, because the blocks before it have just been solved for
//! that time. So it makes one step, and refuses it where the determinant changes its sign or Newton-Raphson does not
//! contract. The mechanism as a whole then goes in shorter steps ([`crate::in_steps`]); whether a frame lies on the path of the last
//! one is shown for all blocks together ([`crate::guard`]).
//!
//! The module does not know the other blocks.

use nalgebra::allocator::Allocator;
use nalgebra::{DefaultAllocator, Dim, OVector};

use crate::assembly::assemble_from_rough_estimate;
use crate::closed_form::Branch;
use crate::equations::Equations;
use crate::failure::Failure;
use crate::kinematics::{Frame, advance_watched, factorize};
use crate::linear::Measure;
use crate::math::Real;
use crate::path::branch_of;
use crate::scale::Scales;
use crate::settings::Settings;
use crate::vector::{zero_matrix, zero_vector};
use crate::watch::{Measuring, OnBranch};

/// What the frame is from which a block is solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// An estimate of the pose, which may be poor.
    Estimate,
    /// The last frame of a motion, which goes on from there.
    LastFrame,
}

/// Solves a block at time `t`.
///
/// From an estimate it is assembled in the mode `branch`, or near the estimate where that is `None`, with angles near those of the
/// estimate where the equations leave it open how often they have gone round; afterwards `branch` is its mode. From the last frame it moves on in this mode.
///
/// # Errors
/// Those of [`assemble_from_rough_estimate`], or those of [`advance`](crate::advance) and [`WrongBranch`](crate::FailureKind::WrongBranch).
///
/// # Work
/// That of the same; where the mode was `None` also one Jacobian; and of an assembly at most n + 1 evaluations of the residual.
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

/// [`solve`]; afterwards `measure` says how far the Jacobian of the block at the new pose is from singular.
///
/// # Errors
/// Those of [`solve`].
///
/// # Work
/// That of [`solve`] and of [`Factorization::measure`](crate::Factorization::measure); after an assembly also one Jacobian.
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
    let mut frame = assemble_from_rough_estimate(equations, &estimate.q, *branch, t, settings)?;
    unwind(equations, &mut frame.q, &estimate.q, t, settings);
    if branch.is_none() {
        *branch = Some(branch_of(equations, &frame.q, t, settings)?);
    }
    Ok(frame)
}

/// Takes whole turns off the angles that a search from afar has wound up, as far as the equations hold without them: of all together, or
/// else one by one. A rack counts the turns of its wheel.
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
            // Of all together: nothing is wound up.
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
