//! Replaces equations of loops by equivalent ones with the fewest moving symbols.
//!
//! The loops of a plan depend on the order of statements, and the bound of an equation is a sum over its symbols. Equations are
//! therefore added to one another or subtracted. Names decide between equal ones, so that the order of statements has no effect.

use std::collections::BTreeSet;

use super::isolation::Loops;
use crate::expr::{ExprId, SymbolId};
use crate::program::builder::Builder;

/// Moving symbols of an equation, and its sort key.
struct Moving {
    symbols: BTreeSet<SymbolId>,
    names: Vec<String>,
}

impl Moving {
    fn key(&self) -> (usize, &[String]) {
        (self.names.len(), &self.names)
    }
}

impl Builder<'_> {
    /// Replaces the equations of loops by the shortest ones. Returns true if any equation has changed.
    pub(super) fn shorten_loops(&mut self, loops: &mut Loops) -> bool {
        let mut has_changed = false;
        let count = loops.residuals.len();
        let mut moving_symbols: Vec<Moving> = loops
            .residuals
            .iter()
            .map(|&it| self.moving_in(it))
            .collect();
        let mut waiting: BTreeSet<usize> = (0..count).collect();
        while let Some(at) = waiting.pop_first() {
            for other in 0..count {
                let shared = moving_symbols[at]
                    .symbols
                    .intersection(&moving_symbols[other].symbols)
                    .count();
                // Only shared symbols can cancel.
                if other == at || 2 * shared < moving_symbols[other].symbols.len() {
                    continue;
                }
                let [first, second] = [at, other].map(|it| loops.residuals[it]);
                let sum = self.graph().add(first, second);
                let difference = self.graph().subtract(first, second);
                for residual in [sum, difference] {
                    let moving = self.moving_in(residual);
                    if moving.key() < moving_symbols[at].key() && !moving.symbols.is_empty() {
                        (loops.residuals[at], moving_symbols[at]) = (residual, moving);
                        has_changed = true;
                        // The new equation may shorten others, and may become shorter itself.
                        waiting = (0..count).collect();
                    }
                }
            }
        }
        has_changed
    }

    /// Returns the positions and rotated vectors of an expression.
    fn moving_in(&mut self, expr: ExprId) -> Moving {
        let symbols = self.pool.graph.symbols(expr).to_vec();
        let symbols: BTreeSet<SymbolId> = symbols
            .into_iter()
            .filter(|it| self.moving(*it).is_some())
            .collect();
        let unknowns = symbols.iter().filter_map(|&it| self.moving(it));
        let mut names: Vec<String> = unknowns
            .map(|it| self.system.unknown_name(it).to_string())
            .collect();
        names.sort_unstable();
        Moving { symbols, names }
    }
}
