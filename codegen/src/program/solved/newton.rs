//! What has no closed form → the equations of its Newton-Raphson.
//!
//! The tears are found with their rates and accelerations by the runtime, from the residuals g of the block, their Jacobian,
//! and their first and second rates with the tears held; all four are straight-line code of the tears and of what is known.

use super::builder::Builder;
use super::{Action, NewtonBlock};
use crate::expr::{ExprId, SymbolId};
use crate::joint::Quantity;

impl Builder<'_> {
    /// The equations of the block, and the action that solves them.
    pub(super) fn newton(
        &mut self,
        unknowns: &[usize],
        residuals: &[ExprId],
        quantities: &[Quantity],
    ) -> NewtonBlock {
        let rates: Vec<(SymbolId, SymbolId)> = unknowns
            .iter()
            .map(|&unknown| self.rates_of(unknown))
            .collect();
        let (held, steady): (Vec<SymbolId>, Vec<SymbolId>) = rates.iter().copied().unzip();
        let (mut jacobian, mut time_derivative, mut gamma) = (Vec::new(), Vec::new(), Vec::new());
        for &residual in residuals {
            let first = self.rate(residual);
            let second = self.rate(first);
            // The residual's rate is linear in the rates of the tears; its coefficients are the Jacobian's row.
            jacobian.extend(
                held.iter()
                    .map(|&rate| self.system.mechanism.graph.derivative(first, rate)),
            );
            time_derivative.push(self.without(first, &held));
            let drift = self.without(second, &steady);
            gamma.push(self.graph().negate(drift));
        }
        let before = std::mem::take(&mut self.actions);
        let defined = self.defined.clone();
        for &unknown in unknowns {
            self.explicit_angle(unknown);
        }
        let geometry = std::mem::replace(&mut self.actions, before);
        // The arms are found anew from the converged tears, now for everyone.
        self.defined = defined;
        self.actions.push(Action::Newton);
        for &unknown in unknowns {
            self.explicit_angle(unknown);
        }
        NewtonBlock {
            unknowns: unknowns.to_vec(),
            geometry,
            residuals: residuals.to_vec(),
            quantities: quantities.to_vec(),
            jacobian,
            time_derivative,
            gamma,
            measure: None,
            shared: None,
        }
    }
}
