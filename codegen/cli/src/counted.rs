//! *Equations → the same equations, solved and counted.*
//!
//! A solve evaluates the residual once at its estimate and once after every Newton-Raphson step, so its steps are its
//! evaluations less one. The module does not know what is solved.

use std::cell::Cell;

use linkwright::path::{LARGEST_MISS, fits, step};
use linkwright::{Branch, Equations, Failure, Frame, Scales, Settings, branch_of};
use nalgebra::{DMatrix, DVector, Dyn};

/// Equations that count the Newton-Raphson steps taken on them.
pub struct Counted<'a, E> {
    equations: &'a E,
    steps: Cell<u64>,
    /// Whether the solve under way has evaluated its residual.
    begun: Cell<bool>,
}

impl<'a, E: Equations<f64, Dyn>> Counted<'a, E> {
    /// No step has been taken.
    pub fn new(equations: &'a E) -> Self {
        Self {
            equations,
            steps: Cell::new(0),
            begun: Cell::new(false),
        }
    }

    /// The equations themselves.
    pub fn inner(&self) -> &'a E {
        self.equations
    }

    /// How many steps were taken in all, polishing steps and failed solves included.
    pub fn steps(&self) -> u64 {
        self.steps.get()
    }

    /// [`linkwright::assemble`], counted.
    ///
    /// # Errors
    /// Every [`linkwright::FailureKind`].
    pub fn assemble(
        &self,
        estimate: &DVector<f64>,
        t: f64,
        settings: &Settings<f64>,
    ) -> Result<Frame<f64, Dyn>, Failure<f64>> {
        self.begun.set(false);
        linkwright::assemble(self, estimate, t, settings)
    }

    /// [`linkwright::path::step`], counted.
    ///
    /// # Errors
    /// Every [`linkwright::FailureKind`].
    pub fn step(
        &self,
        frame: &Frame<f64, Dyn>,
        branch: Branch,
        t: f64,
        settings: &Settings<f64>,
    ) -> Result<Frame<f64, Dyn>, Failure<f64>> {
        self.begun.set(false);
        step(self, frame, branch, t, settings)
    }

    /// The frame at `t` on the far side of a singular pose through which the motion passes straight: the determinant has
    /// changed its sign from that of `branch`, and poses and velocities on both sides fit one motion. `None` where there is
    /// none: at a dead point the velocity is reversed.
    pub fn pass(
        &self,
        frame: &Frame<f64, Dyn>,
        branch: Branch,
        t: f64,
        settings: &Settings<f64>,
    ) -> Option<Frame<f64, Dyn>> {
        self.begun.set(false);
        let next = linkwright::advance(self, frame, t, settings).ok()?;
        let passed = branch_of(self.equations, &next.q, t, settings).ok()? == branch.opposite();
        let scales = Scales::of(self);
        let h = t - frame.t;
        let rates = || frame.qd.iter().zip(next.qd.iter());
        let change = &frame.qdd + &next.qdd;
        let largest = rates()
            .zip(scales.columns.iter())
            .map(|((one, other), scale)| one.abs().max(other.abs()) / scale)
            .fold(0.0, f64::max);
        let smooth = rates().zip(&change).zip(scales.columns.iter()).all(
            |(((one, other), change), scale)| {
                (other - one - 0.5 * h * change).abs() <= LARGEST_MISS * largest * scale
            },
        );
        (passed && smooth && fits(&scales, frame, &next)).then_some(next)
    }
}

impl<E: Equations<f64, Dyn>> Equations<f64, Dyn> for Counted<'_, E> {
    fn dimension(&self) -> Dyn {
        self.equations.dimension()
    }

    fn residual(&self, q: &DVector<f64>, t: f64, phi: &mut DVector<f64>) {
        if self.begun.replace(true) {
            self.steps.set(self.steps.get() + 1);
        }
        self.equations.residual(q, t, phi);
    }

    fn jacobian(&self, q: &DVector<f64>, t: f64, phi_q: &mut DMatrix<f64>) {
        self.equations.jacobian(q, t, phi_q);
    }

    fn time_derivative(&self, q: &DVector<f64>, t: f64, phi_t: &mut DVector<f64>) {
        self.equations.time_derivative(q, t, phi_t);
    }

    fn gamma(&self, q: &DVector<f64>, qd: &DVector<f64>, t: f64, gamma: &mut DVector<f64>) {
        self.equations.gamma(q, qd, t, gamma);
    }

    fn row_scale(&self, row: usize) -> f64 {
        self.equations.row_scale(row)
    }

    fn coordinate_scale(&self, column: usize) -> f64 {
        self.equations.coordinate_scale(column)
    }
}
