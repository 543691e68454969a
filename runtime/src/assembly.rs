//! Assembles a mechanism from a poor estimate of its pose, on a given branch if any.
//!
//! Newton-Raphson finds the pose next to a good estimate. From a poor one it may end at any pose, also at one of the
//! same branch that is not the nearest. [`Frame::assemble_from_rough_estimate`] therefore first lowers the residuals by least
//! squares, which moves the estimate no farther than needed; Newton-Raphson continues from there. This may end at
//! another branch, or at a pose that is not a root, although the residuals cannot be lowered. Plain and damped
//! Newton-Raphson then start from the given estimate.

use nalgebra::allocator::Allocator;
use nalgebra::{DefaultAllocator, Dim, OVector};

use crate::closed_form::Branch;
use crate::damped::solve_damped;
use crate::equations::Equations;
use crate::failure::{Failure, FailureKind};
use crate::kinematics::{Frame, assemble_watched};
use crate::least_squares;
use crate::math::Real;
use crate::settings::Settings;
use crate::vector::require_dimension;
use crate::watch::EndsOn;

impl<T: Real, D: Dim> Frame<T, D>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    /// Assembles the mechanism at time `t` from an `estimate` (n) of its pose that may be poor, on the given branch if any.
    ///
    /// It usually evaluates the equations little more often than [`Frame::assemble`], but every step of the least squares also
    /// multiplies two matrices. Near the pose [`Frame::assemble`] is enough.
    ///
    /// # Errors
    /// Returns every [`FailureKind`]. After [`FailureKind::WrongBranch`], only poses of the other branch were found; any
    /// other kind is that of the solve after the least squares.
    ///
    /// # Work
    /// With N for [`Settings::iterations`] at most 13 N + 74 evaluations of the residual, 5 N + 79 of the Jacobian, and 3 each of
    /// Φ_t and γ.
    ///
    /// # Panics
    /// If the estimate does not have the dimension of the equations, which only a dynamic dimension permits.
    pub fn assemble_from_rough_estimate<E: Equations<T, D>>(
        equations: &E,
        estimate: &OVector<T, D>,
        branch: Option<Branch>,
        t: T,
        settings: &Settings<T>,
    ) -> Result<Self, Failure<T>> {
        require_dimension(estimate, equations.dimension());
        let finish = |start: &OVector<T, D>| match branch {
            None => Self::assemble(equations, start, t, settings),
            Some(branch) => assemble_watched(equations, start, t, settings, EndsOn::new(branch)),
        };
        let mut nearer = estimate.clone();
        least_squares::approach(equations, &mut nearer, t);
        let first = match finish(&nearer) {
            Ok(frame) => return Ok(frame),
            Err(failure) => failure,
        };
        let second = match finish(estimate) {
            Ok(frame) => return Ok(frame),
            Err(failure) => failure,
        };
        let mut pose = estimate.clone();
        let third =
            match solve_damped(equations, &mut pose, t, settings).and_then(|_| finish(&pose)) {
                Ok(frame) => return Ok(frame),
                Err(failure) => failure,
            };
        // A pose of the other branch says more than an iteration that found none.
        let other = [first, second, third]
            .into_iter()
            .find(|failure| failure.kind == FailureKind::WrongBranch);
        Err(other.unwrap_or(first))
    }
}
