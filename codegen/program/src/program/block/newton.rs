//! Represents the equations that Newton-Raphson solves in one block.

use crate::joint::Quantity;
use crate::program::forms::DrawnMode;
use crate::program::function::Function;
use crate::program::lengths::Lengths;
use crate::program::tearing::Tearing;

/// Equations that Newton-Raphson solves in one block, as functions of its unknowns and of earlier results.
#[derive(Clone, Debug)]
pub struct NewtonBlock {
    /// Unknowns: indices into the vector form.
    pub unknowns: Vec<usize>,
    /// Sign of the determinant in the design configuration.
    pub drawn: DrawnMode,
    /// Quantities of the residuals.
    pub quantities: Vec<Quantity>,
    /// Lengths that scale the residuals, and the unknowns.
    pub scaled_by: [Lengths; 2],
    /// Residuals, one per row.
    pub residual: Function,
    /// Jacobian, row by row.
    pub jacobian: Function,
    /// Rates of the residuals at constant unknowns.
    pub time_derivative: Function,
    /// Negative second rates of the residuals at zero accelerations of the unknowns.
    pub gamma: Function,
    /// Tearing of the block; `None` if it is not torn.
    pub tearing: Option<Tearing>,
}

impl NewtonBlock {
    /// Returns residual, Jacobian, time derivative and gamma.
    pub fn equations(&self) -> [&Function; 4] {
        [
            &self.residual,
            &self.jacobian,
            &self.time_derivative,
            &self.gamma,
        ]
    }

    /// Returns the functions of the equations and of the tearing.
    pub fn functions(&self) -> impl Iterator<Item = &Function> {
        let torn = self.tearing.iter().flat_map(Tearing::functions);
        self.equations().into_iter().chain(torn)
    }

    /// Returns these functions for changes.
    pub(in crate::program) fn functions_mut(&mut self) -> impl Iterator<Item = &mut Function> {
        let torn = self.tearing.iter_mut().flat_map(Tearing::functions_mut);
        let equations = [
            &mut self.residual,
            &mut self.jacobian,
            &mut self.time_derivative,
            &mut self.gamma,
        ];
        equations.into_iter().chain(torn)
    }
}
