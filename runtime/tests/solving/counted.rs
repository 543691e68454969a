//! Equations that count how often each of their functions is evaluated.

use std::cell::Cell;

use linkwright::Equations;
use linkwright::math::Real;
use linkwright::nalgebra::allocator::Allocator;
use linkwright::nalgebra::{DefaultAllocator, Dim, OMatrix, OVector};

/// The number of evaluations of each function.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Evaluations {
    pub residuals: u32,
    pub jacobians: u32,
    pub time_derivatives: u32,
    pub gammas: u32,
}

/// Equations with a count of their evaluations.
pub struct Counted<E> {
    equations: E,
    evaluations: Cell<Evaluations>,
}

impl<E> Counted<E> {
    /// Returns equations without evaluations.
    pub fn new(equations: E) -> Self {
        Self {
            equations,
            evaluations: Cell::default(),
        }
    }

    /// Returns the evaluations since the last call.
    pub fn take(&self) -> Evaluations {
        self.evaluations.take()
    }

    fn count(&self, add: fn(&mut Evaluations)) {
        let mut evaluations = self.evaluations.get();
        add(&mut evaluations);
        self.evaluations.set(evaluations);
    }
}

impl<T: Real, D: Dim, E: Equations<T, D>> Equations<T, D> for Counted<E>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    fn dimension(&self) -> D {
        self.equations.dimension()
    }
    fn residual(&self, q: &OVector<T, D>, t: T, phi: &mut OVector<T, D>) {
        self.count(|evaluations| evaluations.residuals += 1);
        self.equations.residual(q, t, phi);
    }
    fn jacobian(&self, q: &OVector<T, D>, t: T, phi_q: &mut OMatrix<T, D, D>) {
        self.count(|evaluations| evaluations.jacobians += 1);
        self.equations.jacobian(q, t, phi_q);
    }
    fn time_derivative(&self, q: &OVector<T, D>, t: T, phi_t: &mut OVector<T, D>) {
        self.count(|evaluations| evaluations.time_derivatives += 1);
        self.equations.time_derivative(q, t, phi_t);
    }
    fn gamma(&self, q: &OVector<T, D>, qd: &OVector<T, D>, t: T, gamma: &mut OVector<T, D>) {
        self.count(|evaluations| evaluations.gammas += 1);
        self.equations.gamma(q, qd, t, gamma);
    }
    fn row_scale(&self, row: usize) -> T {
        self.equations.row_scale(row)
    }
    fn coordinate_scale(&self, column: usize) -> T {
        self.equations.coordinate_scale(column)
    }
}
