//! Solves for a [`Frame`]: pose, velocity and acceleration at a time.
//!
//! A frame in an `Ok` is finite throughout, and its pose meets the tolerance of the settings. The pose can be told from
//! a singular one within its residual. Velocity and acceleration solve Φ_q q̇ = -Φ_t and Φ_q q̈ = γ with one
//! factorization of the Jacobian at the returned pose (Haug 1989, section 3.6). On failure the caller's frame is
//! unchanged.

use nalgebra::allocator::Allocator;
use nalgebra::{DefaultAllocator, Dim, OVector};

use crate::equations::Equations;
use crate::failure::{Failure, FailureKind};
use crate::linear::Factorization;
use crate::math::Real;
use crate::newton;
use crate::regularity;
use crate::scale::Scales;
use crate::settings::Settings;
use crate::vector::{all_finite, negate, require_dimension, zero_matrix, zero_vector};
use crate::watch::{Unwatched, Watch};

/// Motion of all coordinates at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame<T: Real, D: Dim>
where
    DefaultAllocator: Allocator<D>,
{
    /// Time (s).
    pub t: T,
    /// Pose q (n): lengths and angles (m, rad).
    pub q: OVector<T, D>,
    /// Velocity q̇ (n).
    pub qd: OVector<T, D>,
    /// Acceleration q̈ (n).
    pub qdd: OVector<T, D>,
}

impl<T: Real, D: Dim> Copy for Frame<T, D>
where
    DefaultAllocator: Allocator<D>,
    OVector<T, D>: Copy,
{
}

impl<T: Real, D: Dim> Frame<T, D>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    /// Assembles the mechanism at time `t`, starting from the `estimate` (n) of its pose.
    ///
    /// [`Frame::assemble_from_rough_estimate`] is for poor estimates, and for a given branch.
    ///
    /// # Work
    /// That of [`Frame::advance`].
    ///
    /// # Errors
    /// Returns every [`FailureKind`].
    ///
    /// # Panics
    /// If a vector does not have the dimension of the equations, which only a dynamic dimension permits.
    pub fn assemble<E: Equations<T, D>>(
        equations: &E,
        estimate: &OVector<T, D>,
        t: T,
        settings: &Settings<T>,
    ) -> Result<Self, Failure<T>> {
        assemble_watched(equations, estimate, t, settings, Unwatched)
    }

    /// Moves the mechanism from this frame to time `t`, which may lie before or after it.
    ///
    /// The estimate is the Taylor polynomial q + h q̇ + h²/2 q̈ with h = `t` - `self.t`. The number of Newton-Raphson
    /// steps therefore grows with h. For large h the result may lie in another assembly mode. [`Frame::follow`] excludes
    /// that, at the price of a check of every step.
    ///
    /// # Work
    /// With N for [`Settings::iterations`] at most N + 3 evaluations of the residual, N + 5 of the Jacobian, and one each of Φ_t
    /// and γ.
    ///
    /// # Errors
    /// Returns every [`FailureKind`].
    ///
    /// # Panics
    /// If a vector does not have the dimension of the equations, which only a dynamic dimension permits.
    pub fn advance<E: Equations<T, D>>(
        &self,
        equations: &E,
        t: T,
        settings: &Settings<T>,
    ) -> Result<Self, Failure<T>> {
        advance_watched(equations, self, t, settings, Unwatched)
    }
}

/// Calls the solver of [`Frame::assemble`], abandoned if `watch` requires it.
pub(crate) fn assemble_watched<T: Real, D: Dim, E: Equations<T, D>, W: Watch<T, D>>(
    equations: &E,
    estimate: &OVector<T, D>,
    t: T,
    settings: &Settings<T>,
    mut watch: W,
) -> Result<Frame<T, D>, Failure<T>>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    complete(equations, estimate.clone(), t, settings, &mut watch)
}

/// Calls the solver of [`Frame::advance`], abandoned if `watch` requires it.
pub(crate) fn advance_watched<T: Real, D: Dim, E: Equations<T, D>, W: Watch<T, D>>(
    equations: &E,
    frame: &Frame<T, D>,
    t: T,
    settings: &Settings<T>,
    mut watch: W,
) -> Result<Frame<T, D>, Failure<T>>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    for vector in [&frame.q, &frame.qd, &frame.qdd] {
        require_dimension(vector, equations.dimension());
    }
    let h = t - frame.t;
    let mut q = frame.q.clone();
    let derivatives = frame.qd.as_slice().iter().zip(frame.qdd.as_slice());
    for (coordinate, (velocity, acceleration)) in q.as_mut_slice().iter_mut().zip(derivatives) {
        *coordinate += h * (*velocity + T::HALF * h * *acceleration);
    }
    complete(equations, q, t, settings, &mut watch)
}

/// Factorizes the Jacobian at the pose `q` (n), which is solved already, for derivatives of the pose other than that in
/// time: Φ_q ∂q/∂p = −Φ_p.
///
/// # Errors
/// Returns [`FailureKind::Singular`] or [`FailureKind::NotFinite`].
///
/// # Panics
/// If the vector does not have the dimension of the equations, which only a dynamic dimension permits.
pub fn factorize<T: Real, D: Dim, E: Equations<T, D>>(
    equations: &E,
    q: &OVector<T, D>,
    t: T,
    settings: &Settings<T>,
) -> Result<Factorization<T, D>, Failure<T>>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let dimension = equations.dimension();
    require_dimension(q, dimension);
    let mut jacobian = zero_matrix(dimension);
    equations.jacobian(q, t, &mut jacobian);
    Factorization::new(&jacobian, &Scales::of(equations), settings.pivot_ratio).map_err(|kind| {
        Failure {
            kind,
            time: t,
            block: 0,
            iterations: 0,
            residual: T::ZERO,
            row: 0,
            input: None,
        }
    })
}

/// Solves for the pose from the estimate `q`, then for velocity and acceleration at that pose.
fn complete<T: Real, D: Dim, E: Equations<T, D>, W: Watch<T, D>>(
    equations: &E,
    mut q: OVector<T, D>,
    t: T,
    settings: &Settings<T>,
    watch: &mut W,
) -> Result<Frame<T, D>, Failure<T>>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let convergence = newton::solve_watched(equations, &mut q, t, settings, watch)?;
    let fail = |kind| Failure {
        kind,
        time: t,
        block: 0,
        iterations: convergence.iterations,
        residual: convergence.residual,
        row: convergence.row,
        input: None,
    };
    let dimension = equations.dimension();
    let mut jacobian = zero_matrix(dimension);
    equations.jacobian(&q, t, &mut jacobian);
    let factorization = Factorization::new(&jacobian, &Scales::of(equations), settings.pivot_ratio)
        .map_err(fail)?;
    watch.arrival(&factorization).map_err(fail)?;
    if W::MEASURES {
        watch.measure(&factorization, &jacobian);
    }
    if regularity::is_doubtful(&factorization, convergence.residual) {
        let residual = convergence.residual;
        regularity::require(equations, &q, t, residual, &jacobian, &factorization).map_err(fail)?;
    }
    let mut qd = zero_vector(dimension);
    equations.time_derivative(&q, t, &mut qd);
    negate(&mut qd);
    factorization.solve(&mut qd);
    let mut qdd = zero_vector(dimension);
    equations.gamma(&q, &qd, t, &mut qdd);
    factorization.solve(&mut qdd);
    if !(all_finite(qd.as_slice()) && all_finite(qdd.as_slice())) {
        return Err(fail(FailureKind::NotFinite));
    }
    Ok(Frame { t, q, qd, qdd })
}
