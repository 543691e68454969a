//! Chooses among equations that say the same those with the fewest moving symbols.
//!
//! The loops that a plan closes depend on the order of statements, and bounds of an equation add up what its symbols do. Equations are
//! therefore added to one another or subtracted. Names decide between alike ones, so that no order of statements has a part in it.

use std::collections::BTreeSet;

use super::isolation::Loops;
use crate::expr::{ExprId, SymbolId};
use crate::program::builder::Builder;

/// The symbols of an equation that move, and what it is compared by.
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
    /// Puts the shortest equations in the place of those of loops. Returns whether there are others now.
    pub(super) fn shorten_loops(&mut self, loops: &mut Loops) -> bool {
        let mut has_changed = false;
        let count = loops.residuals.len();
        let mut own: Vec<Moving> = loops
            .residuals
            .iter()
            .map(|&it| self.moving_in(it))
            .collect();
        let mut waiting: BTreeSet<usize> = (0..count).collect();
        while let Some(at) = waiting.pop_first() {
            for other in 0..count {
                let shared = own[at].symbols.intersection(&own[other].symbols).count();
                // What both mention is all that can vanish.
                if other == at || 2 * shared < own[other].symbols.len() {
                    continue;
                }
                let [first, second] = [at, other].map(|it| loops.residuals[it]);
                let sum = self.graph().add(first, second);
                let difference = self.graph().subtract(first, second);
                for residual in [sum, difference] {
                    let moving = self.moving_in(residual);
                    if moving.key() < own[at].key() && !moving.symbols.is_empty() {
                        (loops.residuals[at], own[at]) = (residual, moving);
                        has_changed = true;
                        // It may shorten others now, and be shortened again.
                        waiting = (0..count).collect();
                    }
                }
            }
        }
        has_changed
    }

    /// The positions and arms of an expression.
    fn moving_in(&mut self, expr: ExprId) -> Moving {
        let symbols = self.system.mechanism.graph.symbols(expr).to_vec();
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
