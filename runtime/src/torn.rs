//! Advances a block whose unknowns follow explicitly from a few tearing variables, by Newton-Raphson on these alone.
//!
//! For given tearing variables, closed forms yield all other unknowns, and one equation remains per tearing variable.
//! The residuals of these equations, and exact derivatives of the closed forms, are all that an iteration needs
//! (Elmqvist and Otter, *Methods for tearing systems of equations in object-oriented modeling*, 1994).
//!
//! Tearing only saves work; the full block decides. All equations are solved at once, as in [`crate::block`], in these
//! cases:
//! - a closed form is out of reach or nearly singular, although the block need not be;
//! - the steps do not contract;
//! - the determinant changes its sign;
//! - rounding is amplified, so that the residuals do not become as small as rounding.
//!
//! All equations are evaluated at the pose that is returned. A frame therefore has the accuracy of the whole system,
//! and a failure is that of the whole system.
//!
//! Closed forms have signs. They are those of the last frame, since a form is singular where its sign changes. The
//! frame keeps them; after a solve of all equations they are read off its pose.

use nalgebra::allocator::Allocator;
use nalgebra::{DefaultAllocator, Dim, OVector};

use crate::block::{self, Start};
use crate::closed_form::Branch;
use crate::equations::Equations;
use crate::failure::Failure;
use crate::kinematics::Frame;
use crate::math::Real;
use crate::newton::ROUNDING;
use crate::settings::Settings;
use crate::vector::{all_finite, zero_vector};
use crate::watch::LARGEST_CONTRACTION;

/// Largest number of evaluations of a torn block; from the last frame two or three suffice.
pub const EVALUATIONS: usize = 6;

/// Multiple of ε below which the residual of a tearing variable is rounding of its terms, once no step makes it
/// smaller. A larger residual has been amplified by the closed forms, and all equations together leave less. Each
/// unknown beyond that number adds an ε, because closed forms pass their rounding on along a chain.
pub const AMPLIFIED: f64 = 16.0;

/// Largest derivative of an unknown by a tearing variable, in their scales, with which rates are as accurate as those
/// of the whole system.
pub const LARGEST_RESPONSE: f64 = 64.0;

/// Equations of a block with K tearing variables.
pub trait Torn<T: Real, D: Dim, const K: usize>: Equations<T, D>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    /// Signs of the closed forms.
    type Signs: Clone;
    /// Intermediate values of the residuals that [`Torn::complete`] needs.
    type Carried;

    /// Indices of the tearing variables.
    fn tears(&self) -> [usize; K];

    /// Positive magnitudes by which the residuals are scaled.
    fn scales(&self, t: T) -> [T; K];

    /// Magnitudes of the residuals' terms in these scales, at least 1; rounding is relative to them.
    fn terms(&self) -> [T; K];

    /// Computes the other unknowns and the residuals; `None` if a closed form is out of reach or nearly singular.
    fn evaluate(
        &self,
        tears: &[T; K],
        signs: &Self::Signs,
        t: T,
    ) -> Option<Evaluation<T, K, Self::Carried>>;

    /// Computes all unknowns and their rates at tearing variables with vanishing residuals.
    fn complete(
        &self,
        tears: &[T; K],
        signs: &Self::Signs,
        carried: &Self::Carried,
        t: T,
    ) -> Completion<T, D>;

    /// Signs of the closed forms at a pose (n).
    fn signs(&self, q: &OVector<T, D>, t: T) -> Self::Signs;
}

/// Residuals of a torn block at given tearing variables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evaluation<T, const K: usize, C> {
    /// Tearing residuals.
    pub residual: [T; K],
    /// Inverse of their Jacobian in the tearing variables, row by row.
    pub inverse: [[T; K]; K],
    /// Determinant of this Jacobian.
    pub determinant: T,
    /// Intermediate values for [`Torn::complete`].
    pub carried: C,
}

/// All unknowns of a block.
#[derive(Clone, Debug, PartialEq)]
pub struct Completion<T: Real, D: Dim>
where
    DefaultAllocator: Allocator<D>,
{
    /// Cosine of an angle; a length itself (n).
    pub cosines: OVector<T, D>,
    /// Sine of an angle (n).
    pub sines: OVector<T, D>,
    /// Rates (n).
    pub rates: OVector<T, D>,
    /// Accelerations (n).
    pub accelerations: OVector<T, D>,
    /// Residuals of all equations (n).
    pub residual: OVector<T, D>,
    /// Largest derivative of an unknown by a tearing variable, in their scales.
    pub response: T,
}

/// Solution of a block.
#[derive(Clone, Debug, PartialEq)]
pub struct Found<T: Real, D: Dim, S>
where
    DefaultAllocator: Allocator<D>,
{
    /// Frame of the block.
    pub frame: Frame<T, D>,
    /// Cosine of each angle (n).
    pub cosines: OVector<T, D>,
    /// Sine of each angle (n).
    pub sines: OVector<T, D>,
    /// Values with which the next frame is solved.
    pub memory: Memory<T, S>,
}

/// Values that a frame keeps for a torn block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Memory<T, S> {
    /// Number with the sign of the determinant in the tearing variables; zero if the sign is unknown.
    pub determinant: T,
    /// Signs of the closed forms.
    pub signs: S,
}

/// Solves a block at time `t` as [`block::solve`] does, which is the fallback.
///
/// # Errors
/// Returns those of [`block::solve`].
///
/// # Work
/// At most [`EVALUATIONS`] evaluations of the torn block, and then that of [`block::solve`] if they do not suffice.
///
/// # Panics
/// If a vector does not have the dimension of the equations, which only a dynamic dimension permits.
#[inline]
pub fn solve<T: Real, D: Dim, E: Torn<T, D, K>, const K: usize>(
    equations: &E,
    last: &Frame<T, D>,
    memory: &Memory<T, E::Signs>,
    start: Start,
    branch: &mut Option<Branch>,
    t: T,
    settings: &Settings<T>,
) -> Result<Found<T, D, E::Signs>, Failure<T>>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    if start == Start::LastFrame
        && branch.is_some()
        && let Some(found) = advance(equations, last, memory, t, settings)
    {
        return Ok(found);
    }
    whole(equations, last, start, branch, t, settings)
}

/// Advances by the tearing variables if the frame is certain to be as good as that of the whole system.
#[inline]
fn advance<T: Real, D: Dim, E: Torn<T, D, K>, const K: usize>(
    equations: &E,
    last: &Frame<T, D>,
    memory: &Memory<T, E::Signs>,
    t: T,
    settings: &Settings<T>,
) -> Option<Found<T, D, E::Signs>>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let h = t - last.t;
    let mut tears = equations.tears().map(|place| {
        let half = T::HALF * h * last.qdd[place];
        last.q[place] + h * (last.qd[place] + half)
    });
    let (scales, terms) = (equations.scales(t), equations.terms());
    let enough = match settings.polish {
        true => T::from_f64(ROUNDING) * T::EPSILON,
        false => settings.tolerance,
    };
    let amplified = T::from_f64(AMPLIFIED) * handed_on(equations);
    let mut before: Option<T> = None;
    for _ in 0..EVALUATIONS {
        let at = equations.evaluate(&tears, &memory.signs, t)?;
        // Written so that NaN is refused.
        let keeps_sign = at.determinant * memory.determinant > T::ZERO;
        if !keeps_sign {
            return None;
        }
        let mut scaled = at.residual;
        for (value, scale) in scaled.iter_mut().zip(&scales) {
            *value = value.abs() / *scale;
        }
        let level = largest(scaled.iter().copied());
        let noise = largest(
            scaled
                .iter()
                .zip(&terms)
                .map(|(value, size)| *value / *size),
        );
        let step = at.inverse.map(|row| {
            let terms = row.iter().zip(&at.residual);
            terms.fold(T::ZERO, |sum, (entry, value)| sum - *entry * *value)
        });
        let columns = equations
            .tears()
            .map(|place| equations.coordinate_scale(place));
        let length = largest(
            step.iter()
                .zip(&columns)
                .map(|(step, scale)| step.abs() / *scale),
        );
        let contracts =
            before.is_none_or(|before| length <= T::from_f64(LARGEST_CONTRACTION) * before);
        if level <= enough || !contracts && noise <= amplified {
            return completed(equations, last, &tears, memory, &at.carried, (t, settings));
        }
        if !contracts {
            return None;
        }
        before = Some(length);
        for (tear, step) in tears.iter_mut().zip(step) {
            *tear += step;
        }
    }
    None
}

/// Rounding of one equation after many unknowns in sequence: ε, and more for a large number of them.
#[inline]
fn handed_on<T: Real, D: Dim, E: Equations<T, D>>(equations: &E) -> T
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let unknowns = equations.dimension().value() as f64;
    T::EPSILON * T::from_f64((unknowns / AMPLIFIED).max(1.0))
}

/// Largest of some magnitudes, or one that is not finite.
#[inline]
fn largest<T: Real>(magnitudes: impl Iterator<Item = T>) -> T {
    magnitudes.fold(T::ZERO, |largest, value| {
        match largest < value || !value.is_finite() {
            true => value,
            false => largest,
        }
    })
}

/// Largest magnitude of some values, or one that is not finite; zero without values.
#[inline]
pub fn largest_of<T: Real>(values: &[T]) -> T {
    largest(values.iter().map(|value| value.abs()))
}

/// Sign of a value as a factor: +1 or −1.
#[inline]
pub fn sign<T: Real>(value: T) -> T {
    match value < T::ZERO {
        true => -T::ONE,
        false => T::ONE,
    }
}

#[inline]
fn completed<T: Real, D: Dim, E: Torn<T, D, K>, const K: usize>(
    equations: &E,
    last: &Frame<T, D>,
    tears: &[T; K],
    memory: &Memory<T, E::Signs>,
    carried: &E::Carried,
    (t, settings): (T, &Settings<T>),
) -> Option<Found<T, D, E::Signs>>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let Completion {
        cosines,
        sines,
        rates,
        accelerations,
        residual,
        response,
    } = equations.complete(tears, &memory.signs, carried, t);
    let mut q = cosines.clone();
    let parts = sines.as_slice().iter().zip(last.q.as_slice());
    for (place, (value, (sine, near))) in q.as_mut_slice().iter_mut().zip(parts).enumerate() {
        if let Some(which) = equations.tears().iter().position(|tear| *tear == place) {
            *value = tears[which];
        } else if equations.is_angle(place) {
            *value = sine.angle_near(*value, *near);
        }
    }
    // All equations must hold as well as a solve of all together would leave them; this does not depend on the method.
    // Written so that NaN is refused.
    let left = match settings.polish {
        true => T::from_f64(ROUNDING) * handed_on(equations) * largest_of(&equations.terms()),
        false => settings.tolerance,
    };
    let mut rows = residual.as_slice().iter().enumerate();
    let is_met = rows.all(|(row, value)| value.abs() <= left * equations.row_scale(row));
    let finite = all_finite(q.as_slice())
        && all_finite(rates.as_slice())
        && all_finite(accelerations.as_slice());
    (finite && is_met && response <= T::from_f64(LARGEST_RESPONSE)).then(|| Found {
        frame: Frame {
            t,
            q,
            qd: rates,
            qdd: accelerations,
        },
        cosines,
        sines,
        memory: memory.clone(),
    })
}

/// Solves the frame by all equations.
#[cold]
fn whole<T: Real, D: Dim, E: Torn<T, D, K>, const K: usize>(
    equations: &E,
    last: &Frame<T, D>,
    start: Start,
    branch: &mut Option<Branch>,
    t: T,
    settings: &Settings<T>,
) -> Result<Found<T, D, E::Signs>, Failure<T>>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let frame = block::solve(equations, last, start, branch, t, settings)?;
    let dimension = equations.dimension();
    let (mut cosines, mut sines) = (frame.q.clone(), zero_vector(dimension));
    let parts = cosines.as_mut_slice().iter_mut().zip(sines.as_mut_slice());
    for (place, (value, sine)) in parts.enumerate() {
        if equations.is_angle(place) {
            (*sine, *value) = value.sin_cos();
        }
    }
    let signs = equations.signs(&frame.q, t);
    let tears = equations.tears().map(|place| frame.q[place]);
    let scales = equations.scales(t);
    let determinant = match equations.evaluate(&tears, &signs, t) {
        // The closed forms must lead to this pose.
        Some(at)
            if at
                .residual
                .iter()
                .zip(&scales)
                .all(|(value, scale)| value.abs() <= settings.tolerance * *scale) =>
        {
            at.determinant
        }
        _ => T::ZERO,
    };
    Ok(Found {
        frame,
        cosines,
        sines,
        memory: Memory { determinant, signs },
    })
}
