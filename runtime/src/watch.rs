//! The steps of a solve → whether they still lead to the pose that is wanted, and not to another one.
//!
//! A plain solve is not watched, and nothing of this is compiled into it. The module does not know where the estimate came
//! from, nor what is done when a solve is given up.

use nalgebra::allocator::Allocator;
use nalgebra::{DefaultAllocator, Dim, OMatrix, OVector};

use crate::closed_form::Branch;
use crate::failure::FailureKind;
use crate::linear::{Factorization, Measure};
use crate::math::Real;
use crate::scale::Scales;

/// The largest ratio of the lengths of two consecutive steps on a path that is being followed. An estimate within the
/// region in which Newton-Raphson is known to converge to the pose of the path has a ratio of at most 1/2 (Deuflhard,
/// *Newton Methods for Nonlinear Problems*, 2004, theorem 2.1 with h ≤ 1).
pub const LARGEST_CONTRACTION: f64 = 0.5;

/// What is asked of the Jacobians and steps of a solve.
pub(crate) trait Watch<T: Real, D: Dim>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    /// Judges a Jacobian on the way.
    fn jacobian(&mut self, factorization: &Factorization<T, D>) -> Result<(), FailureKind<T>>;

    /// Judges the Jacobian at the pose that was found.
    fn arrival(&mut self, factorization: &Factorization<T, D>) -> Result<(), FailureKind<T>> {
        self.jacobian(factorization)
    }

    /// Whether it wants to see that Jacobian.
    const MEASURES: bool = false;

    /// Takes note of that Jacobian (n × n), which passed.
    #[inline]
    fn measure(&mut self, _: &Factorization<T, D>, _: &OMatrix<T, D, D>) {}

    /// Judges a step, which has not been taken yet.
    fn step(&mut self, scales: &Scales<T, D>, update: &OVector<T, D>)
    -> Result<(), FailureKind<T>>;
}

/// Asks nothing.
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

/// Asks that every Jacobian has the sign of the branch, and that every step is at most half as long as the one before.
pub(crate) struct OnBranch<T> {
    branch: Branch,
    /// The length of the last step, in coordinate scales.
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

/// Asks the same, and measures how far the Jacobian at the pose that is found is from singular.
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

/// Asks that the pose that is found has the branch; the way to it may lead anywhere.
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
