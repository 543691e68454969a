//! The equations that Newton-Raphson solves in one block, as functions.

use crate::joint::Quantity;
use crate::program::forms::DrawnMode;
use crate::program::function::Function;
use crate::program::lengths::Lengths;
use crate::program::tearing::Tearing;

/// The equations that Newton-Raphson solves in one block, as functions of the tears and of what is known before.
#[derive(Clone, Debug)]
pub struct NewtonBlock {
    /// The tears.
    pub unknowns: Vec<usize>,
    /// The sign of the determinant in the drawing.
    pub drawn: DrawnMode,
    /// What each residual is measured in.
    pub quantities: Vec<Quantity>,
    /// What lengths are scaled by in the residuals, and in the tears.
    pub scaled_by: [Lengths; 2],
    /// One residual a row.
    pub residual: Function,
    /// Row by row.
    pub jacobian: Function,
    /// The rates of the residuals with the tears held.
    pub time_derivative: Function,
    /// Minus the second rates of the residuals with the tears' accelerations zero.
    pub gamma: Function,
    /// The shortcut by way of fewer unknowns, where there is one.
    pub tearing: Option<Tearing>,
}

impl NewtonBlock {
    /// Its four functions.
    pub fn equations(&self) -> [&Function; 4] {
        [
            &self.residual,
            &self.jacobian,
            &self.time_derivative,
            &self.gamma,
        ]
    }

    /// All its functions: its equations, and those of its tearing.
    pub fn functions(&self) -> impl Iterator<Item = &Function> {
        let torn = self.tearing.iter().flat_map(Tearing::functions);
        self.equations().into_iter().chain(torn)
    }

    /// The same, to be changed.
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
