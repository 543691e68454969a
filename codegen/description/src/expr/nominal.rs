//! Symbols that do not move: *a symbol with a nominal value* → *questions about numbers answered at that value*.
//!
//! A symbol with a nominal value stands for a number that may be chosen later but keeps its value from then on. Expressions of
//! such symbols alone are *fixed*: they stay symbolic, have no rate, and are evaluated at the nominal values wherever a number
//! is wanted. This file does not know what the symbols stand for.

use super::graph::Graph;
use super::node::{ExprId, Node, SymbolId};

impl Graph {
    /// States that a symbol keeps its value, and which one it has where a number is wanted.
    ///
    /// # Panics
    /// Where the symbol belongs to another graph and has no name in this one.
    pub fn set_nominal(&mut self, symbol: SymbolId, value: f64) {
        assert!(
            symbol.index() < self.symbol_count(),
            "a symbol belongs to the graph that named it"
        );
        if self.nominal_values.len() <= symbol.index() {
            self.nominal_values.resize(symbol.index() + 1, None);
        }
        self.nominal_values[symbol.index()] = Some(value);
        if self.find(&Node::Symbol(symbol)).is_some() {
            self.revalue();
        }
    }

    /// The nominal value of a symbol, if it has one.
    pub fn nominal(&self, symbol: SymbolId) -> Option<f64> {
        self.nominal_values.get(symbol.index()).copied().flatten()
    }

    /// Puts the nominal values into a table of all symbols, and leaves the other entries as they are.
    pub fn fill_nominal(&self, symbols: &mut [f64]) {
        for (place, nominal) in symbols.iter_mut().zip(&self.nominal_values) {
            if let Some(nominal) = nominal {
                *place = *nominal;
            }
        }
    }

    /// Whether every symbol of the expression has a nominal value, so that the expression does not move. Constants are fixed.
    pub fn is_fixed(&self, expr: ExprId) -> bool {
        self.worth(expr).is_fixed
    }

    /// The value of a fixed expression, at the nominal values of its symbols; it may be non-finite. `None` where another symbol
    /// occurs.
    pub fn constant_value(&self, expr: ExprId) -> Option<f64> {
        let worth = self.worth(expr);
        worth.is_fixed.then_some(worth.value)
    }
}
