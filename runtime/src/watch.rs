//! Watches the steps of a solve, so that they lead to the required pose and not to another one.
//!
//! A plain solve is not watched, and none of this code is compiled into it.

use nalgebra::allocator::Allocator;
use nalgebra::{DefaultAllocator, Dim, OMatrix, OVector};

use crate::closed_form::Branch;
use crate::failure::FailureKind;
use crate::linear::{Factorization, Measure};
use crate::math::Real;
use crate::scale::Scales;

/// Largest ratio of the lengths of two consecutive steps on a path that is being followed. If the estimate lies in the
/// region of known convergence to the pose of the path, the ratio is at most 1/2 (Deuflhard, *Newton Methods for
/// Nonlinear Problems*, 2004, theorem 2.1 with h ≤ 1).
pub const LARGEST_CONTRACTION: f64 = 0.5;

/// Conditions on the Jacobians and steps of a solve.
pub(crate) trait Watch<T: Real, D: Dim>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    /// Judges an intermediate Jacobian.
    fn jacobian(&mut self, factorization: &Factorization<T, D>) -> Result<(), FailureKind<T>>;

    /// Judges the Jacobian at the returned pose.
    fn arrival(&mut self, factorization: &Factorization<T, D>) -> Result<(), FailureKind<T>> {
        self.jacobian(factorization)
    }

    /// True if the watch measures the Jacobian at the returned pose.
    const MEASURES: bool = false;

    /// Measures that Jacobian (n × n), which passed.
    #[inline]
    fn measure(&mut self, _: &Factorization<T, D>, _: &OMatrix<T, D, D>) {}

    /// Judges a step before it is taken.
    fn step(&mut self, scales: &Scales<T, D>, update: &OVector<T, D>)
    -> Result<(), FailureKind<T>>;
}

/// Watch without conditions.
pub(crate) struct Unwatched;

impl<T: Real, D: Dim> Watch<T, D> for Unwatched
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    #[inline]
    fn jacobian(&mut self, _: &Factorization<T, D>) -> Result<(), FailureKind<T>> {
        Ok(())
    }
    #[inline]
    fn step(&mut self, _: &Scales<T, D>, _: &OVector<T, D>) -> Result<(), FailureKind<T>> {
        Ok(())
    }
}

/// Watch that requires the sign of the branch of every Jacobian, and steps of at most half the length of the one
/// before.
pub(crate) struct OnBranch<T> {
    branch: Branch,
    /// Length of the last step, in coordinate scales.
    last: Option<T>,
}

impl<T: Real> OnBranch<T> {
    pub(crate) fn new(branch: Branch) -> Self {
        Self { branch, last: None }
    }
}

impl<T: Real, D: Dim> Watch<T, D> for OnBranch<T>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    fn jacobian(&mut self, factorization: &Factorization<T, D>) -> Result<(), FailureKind<T>> {
        if factorization.branch() == self.branch {
            Ok(())
        } else {
            Err(FailureKind::WrongBranch)
        }
    }

    fn step(
        &mut self,
        scales: &Scales<T, D>,
        update: &OVector<T, D>,
    ) -> Result<(), FailureKind<T>> {
        let length = scales.step_length(update);
        let bound = self
            .last
            .map(|last| T::from_f64(LARGEST_CONTRACTION) * last);
        self.last = Some(length);
        if bound.is_some_and(|bound| length > bound) {
            return Err(FailureKind::StepTooLarge);
        }
        Ok(())
    }
}

/// Watch of [`OnBranch`] that also measures the distance of the Jacobian at the returned pose from singular.
pub(crate) struct Measuring<'a, T> {
    on_branch: OnBranch<T>,
    found: &'a mut Measure<T>,
}

impl<'a, T: Real> Measuring<'a, T> {
    pub(crate) fn new(branch: Branch, found: &'a mut Measure<T>) -> Self {
        let on_branch = OnBranch::new(branch);
        Self { on_branch, found }
    }
}

impl<T: Real, D: Dim> Watch<T, D> for Measuring<'_, T>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    fn jacobian(&mut self, factorization: &Factorization<T, D>) -> Result<(), FailureKind<T>> {
        self.on_branch.jacobian(factorization)
    }

    fn step(
        &mut self,
        scales: &Scales<T, D>,
        update: &OVector<T, D>,
    ) -> Result<(), FailureKind<T>> {
        self.on_branch.step(scales, update)
    }

    const MEASURES: bool = true;

    fn measure(&mut self, factorization: &Factorization<T, D>, jacobian: &OMatrix<T, D, D>) {
        *self.found = factorization.measure(jacobian);
    }
}

/// Watch that requires the branch of the returned pose; earlier iterates may have any.
pub(crate) struct EndsOn {
    branch: Branch,
}

impl EndsOn {
    pub(crate) fn new(branch: Branch) -> Self {
        Self { branch }
    }
}

impl<T: Real, D: Dim> Watch<T, D> for EndsOn
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    fn jacobian(&mut self, _: &Factorization<T, D>) -> Result<(), FailureKind<T>> {
        Ok(())
    }

    fn step(&mut self, _: &Scales<T, D>, _: &OVector<T, D>) -> Result<(), FailureKind<T>> {
        Ok(())
    }

    fn arrival(&mut self, factorization: &Factorization<T, D>) -> Result<(), FailureKind<T>> {
        OnBranch::<T>::new(self.branch).jacobian(factorization)
    }
}
