//! Decides if an iteration still makes progress, from its steps and their residuals.
//!
//! Everything is compared in the scales of the equations. For cycles the pose is compared with one earlier pose, the
//! checkpoint, which is replaced after 1, 2, 4, 8 … steps (Brent, *BIT* 20 (1980), 176-184): any cycle is found at the
//! price of one stored pose.

use nalgebra::allocator::Allocator;
use nalgebra::{DefaultAllocator, Dim, OVector};

use crate::failure::FailureKind;
use crate::math::Real;
use crate::newton::{GROWING_STEPS, LARGEST_GROWTH, LONGEST_STEP, ROUNDING};
use crate::scale::Scales;

/// Record of earlier steps.
pub(crate) struct Progress<T: Real, D: Dim>
where
    DefaultAllocator: Allocator<D>,
{
    /// Earlier pose that new ones are compared with.
    checkpoint: OVector<T, D>,
    /// Number of steps since the checkpoint, and number after which it is replaced.
    age: u32,
    lifetime: u32,
    /// Largest residual that is not divergence.
    bound: T,
    last: T,
    growing: u16,
}

impl<T: Real, D: Dim> Progress<T, D>
where
    DefaultAllocator: Allocator<D>,
{
    pub(crate) fn new(pose: &OVector<T, D>, residual: T) -> Self {
        Self {
            checkpoint: pose.clone(),
            age: 0,
            lifetime: 1,
            bound: T::from_f64(LARGEST_GROWTH) * residual.max(T::ONE),
            last: residual,
            growing: 0,
        }
    }

    /// Judges the step `update` that led to `pose`, while the residual is above the tolerance.
    pub(crate) fn judge(
        &mut self,
        scales: &Scales<T, D>,
        pose: &OVector<T, D>,
        update: &OVector<T, D>,
        residual: T,
    ) -> Option<FailureKind<T>> {
        let rounding = T::from_f64(ROUNDING) * T::EPSILON;
        if scales.negligible(update, pose, rounding) {
            return Some(FailureKind::Stalled);
        }
        self.growing = if residual > self.last {
            self.growing + 1
        } else {
            0
        };
        self.last = residual;
        if scales.step_length(update) > T::from_f64(LONGEST_STEP)
            || residual > self.bound
            || self.growing >= GROWING_STEPS
        {
            return Some(FailureKind::Diverged);
        }
        if scales.coincide(pose, &self.checkpoint, rounding) {
            return Some(FailureKind::Cycling);
        }
        self.age += 1;
        if self.age >= self.lifetime {
            self.checkpoint.clone_from(pose);
            self.age = 0;
            self.lifetime = self.lifetime.saturating_mul(2);
        }
        None
    }
}
