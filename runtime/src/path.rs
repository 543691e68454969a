//! Follows the path of a frame to another time, or to the end of the path.
//!
//! [`Frame::advance`] takes the pose to which Newton-Raphson happens to converge. [`Frame::follow`] takes only poses
//! that are certain to lie on the path. The determinant of the Jacobian must keep its sign from the estimate to the
//! pose. Every Newton-Raphson step must be at most half the length of the one before; otherwise the estimate may lie in
//! the basin of another root. The motion must also fit both ends. By Hermite's rule the change is h (q̇₀ + q̇₁) / 2 -
//! h² (q̈₁ - q̈₀) / 12, up to an error of the fifth order in h; for an end on another path it is off by the distance of
//! the two paths. If one of these conditions fails, [`Frame::follow`] takes intermediate times ([`crate::substeps`]).
//!
//! A path ends where its Jacobian becomes singular. Most of these poses are folds, dead points of the driver. With τ
//! the remaining time, the distance to the singular pose and the determinant shrink like √τ, and the velocity grows
//! like 1/√τ. So q̇ / (2 q̈) is τ, and the square of the determinant falls on a straight line to zero. If the two
//! agree, the end is known much more exactly than by trying (Seydel, *Practical Bifurcation and Stability Analysis*,
//! 2010, chapter 5).

use nalgebra::allocator::Allocator;
use nalgebra::{DefaultAllocator, Dim, OVector};

use crate::closed_form::Branch;
use crate::equations::Equations;
use crate::failure::{Failure, FailureKind, index};
use crate::kinematics::{Frame, advance_watched};
use crate::linear::Factorization;
use crate::math::Real;
use crate::scale::Scales;
use crate::settings::Settings;
use crate::substeps::in_steps;
use crate::vector::zero_matrix;
use crate::watch::OnBranch;

/// Largest part of its scale by which a coordinate may miss Hermite's rule. At steps of 1.8 rad of a harmonic motion
/// the rule misses by this part of the amplitude.
pub const LARGEST_MISS: f64 = 1.0 / 32.0;

/// Largest difference of the two estimates of the remaining time, relative to it, at an end that counts as a fold.
const AGREEMENT: f64 = 1.0 / 16.0;

/// Largest remaining part of the starting determinant at an end that counts as a fold: the remaining distance has then
/// become 16 times shorter.
const SHRUNK: f64 = 0.25;

impl<T: Real, D: Dim> Frame<T, D>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    /// Branch of the pose `q` (n) at time `t`: the sign of the determinant of Φ_q.
    ///
    /// # Errors
    /// Returns [`FailureKind::Singular`] or [`FailureKind::NotFinite`].
    ///
    /// # Work
    /// One evaluation of the Jacobian.
    ///
    /// # Panics
    /// If `q` does not have the dimension of the equations, which only a dynamic dimension permits.
    pub fn branch_of<E: Equations<T, D>>(
        equations: &E,
        q: &OVector<T, D>,
        t: T,
        settings: &Settings<T>,
    ) -> Result<Branch, Failure<T>> {
        let factorization =
            factorize(equations, q, t, settings).map_err(|kind| no_verdict(kind, t))?;
        Ok(factorization.branch())
    }

    /// Moves the mechanism from this frame to time `t`, before or after it, along its path and on its `branch`, in as
    /// many steps as needed.
    ///
    /// # Errors
    /// Returns a [`Failure`] of any [`FailureKind`]. The time of the failure is the end of the path, or the last
    /// time that could be followed:
    /// - [`FailureKind::Singular`] at a dead point, at the time at which the two estimates of the fold put it. Its pivot ratio
    ///   is that of the last pose before it, and its column the coordinate that is fastest there.
    /// - [`FailureKind::WrongBranch`] if every attempt to continue ends with the other sign of the determinant: the path
    ///   passes a singular pose, at which another path crosses it. The time lies behind the singular pose by less than the
    ///   last step that was tried.
    /// - [`FailureKind::StepTooLarge`] if the budget [`Settings::substeps`] ended before any of this was clear.
    ///
    /// # Work
    /// With S for [`Settings::substeps`] and N for [`Settings::iterations`] at most S (N + 3) evaluations of the residual,
    /// S (N + 5) + 3 of the Jacobian, S of Φ_t and S of γ.
    ///
    /// # Panics
    /// If a vector does not have the dimension of the equations, which only a dynamic dimension permits.
    pub fn follow<E: Equations<T, D>>(
        &self,
        equations: &E,
        branch: Branch,
        t: T,
        settings: &Settings<T>,
    ) -> Result<Self, Failure<T>> {
        let mut current = self.clone();
        // Frame before the last one, from which the end of the path is extrapolated.
        let mut before = None;
        let moved = in_steps(self.t, t, settings.substeps, |target| {
            let next = step(equations, &current, branch, target, settings)?;
            before = Some(core::mem::replace(&mut current, next));
            Ok(())
        });
        match moved {
            Ok(_) => Ok(current),
            Err(broken) => Err(match before {
                Some(before) => {
                    let frames = [self, &before, &current];
                    end_of_path(equations, frames, t, broken.failure, settings)
                }
                None => broken.failure,
            }),
        }
    }
}

/// Moves the mechanism from `frame` to time `t` in one step, if it is certain to stay on the path and on its branch.
///
/// # Errors
/// Returns every [`FailureKind`]. After [`FailureKind::WrongBranch`] and [`FailureKind::StepTooLarge`], the computed
/// frame, if any, may belong to another path.
///
/// # Work
/// That of [`Frame::advance`], and the comparison of the two frames.
///
/// # Panics
/// If a vector does not have the dimension of the equations, which only a dynamic dimension permits.
pub fn step<T: Real, D: Dim, E: Equations<T, D>>(
    equations: &E,
    frame: &Frame<T, D>,
    branch: Branch,
    t: T,
    settings: &Settings<T>,
) -> Result<Frame<T, D>, Failure<T>>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let watch = OnBranch::new(branch);
    let next = advance_watched(equations, frame, t, settings, watch)?;
    if !fits(&Scales::of(equations), frame, &next) {
        return Err(no_verdict(FailureKind::StepTooLarge, t));
    }
    Ok(next)
}

/// True if two frames can belong to one path: every coordinate moves according to the rates and accelerations at both
/// ends.
pub fn fits<T: Real, D: Dim>(scales: &Scales<T, D>, first: &Frame<T, D>, last: &Frame<T, D>) -> bool
where
    DefaultAllocator: Allocator<D>,
{
    let h = last.t - first.t;
    let twelfth = h * h / T::from_f64(12.0);
    let q = first.q.as_slice().iter().zip(last.q.as_slice());
    let qd = first.qd.as_slice().iter().zip(last.qd.as_slice());
    let qdd = first.qdd.as_slice().iter().zip(last.qdd.as_slice());
    q.zip(qd)
        .zip(qdd)
        .zip(scales.columns.as_slice())
        .all(|(((q, qd), qdd), scale)| {
            let way = T::HALF * h * (*qd.0 + *qd.1) - twelfth * (*qdd.1 - *qdd.0);
            (*q.1 - *q.0 - way).abs() <= T::from_f64(LARGEST_MISS) * *scale
        })
}

/// Failure that does not come from a solve.
fn no_verdict<T: Real>(kind: FailureKind<T>, time: T) -> Failure<T> {
    Failure {
        kind,
        time,
        block: 0,
        iterations: 0,
        residual: T::ZERO,
        row: 0,
        input: None,
    }
}

/// Names the end of a path from its first and its last two frames: the fold that they predict, or the failure of the
/// last attempt.
#[cold]
fn end_of_path<T: Real, D: Dim, E: Equations<T, D>>(
    equations: &E,
    [first, before, last]: [&Frame<T, D>; 3],
    t: T,
    failure: Failure<T>,
    settings: &Settings<T>,
) -> Failure<T>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let scales = Scales::of(equations);
    let (left, column) = time_to_fold(&scales, last);
    let factorize = |frame: &Frame<T, D>| factorize(equations, &frame.q, frame.t, settings);
    let (Ok(at_first), Ok(at_before), Ok(at_last)) =
        (factorize(first), factorize(before), factorize(last))
    else {
        return failure;
    };
    let shrunk = (at_last.determinant() / at_first.determinant()).abs() <= T::from_f64(SHRUNK);
    // (det at last / det before)²: for a fold, the part of the time to it that the last step has left.
    let ratio = at_last.determinant() / at_before.determinant();
    let part = ratio * ratio;
    let by_determinant = (last.t - before.t) * (part / (T::ONE - part));
    let agree = (left - by_determinant).abs() <= T::from_f64(AGREEMENT) * left.abs();
    // The fold must lie on the path, and near: not far beyond the refused time, or beyond the last step.
    let on_way = left * (t - last.t) > T::ZERO && left.abs() <= (t - last.t).abs();
    let gap = (failure.time - last.t).abs().max((last.t - before.t).abs());
    if !(shrunk && agree && on_way && left.abs() <= gap + gap) {
        return failure;
    }
    Failure {
        kind: FailureKind::Singular {
            pivot_ratio: at_last.pivot_ratio(),
            column: index(column),
        },
        time: last.t + left,
        ..failure
    }
}

/// Time from `frame` to a nearby fold of its path, negative if the fold lies behind, as q̇ / (2 q̈) in the direction of
/// the velocity; and the fastest coordinate. The error is of the order of the time's power 3/2.
fn time_to_fold<T: Real, D: Dim>(scales: &Scales<T, D>, frame: &Frame<T, D>) -> (T, usize)
where
    DefaultAllocator: Allocator<D>,
{
    let mut square = T::ZERO;
    let mut product = T::ZERO;
    let mut fastest = (0, T::ZERO);
    let rates = frame.qd.as_slice().iter().zip(frame.qdd.as_slice());
    for (column, ((rate, change), scale)) in rates.zip(scales.columns.as_slice()).enumerate() {
        let (rate, change) = (*rate / *scale, *change / *scale);
        square += rate * rate;
        product += rate * change;
        if rate.abs() > fastest.1 {
            fastest = (column, rate.abs());
        }
    }
    (T::HALF * square / product, fastest.0)
}

fn factorize<T: Real, D: Dim, E: Equations<T, D>>(
    equations: &E,
    q: &OVector<T, D>,
    t: T,
    settings: &Settings<T>,
) -> Result<Factorization<T, D>, FailureKind<T>>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let mut jacobian = zero_matrix(equations.dimension());
    equations.jacobian(q, t, &mut jacobian);
    Factorization::new(&jacobian, &Scales::of(equations), settings.pivot_ratio)
}
