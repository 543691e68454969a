//! Assigns nominal values to symbols that are constant during a motion.
//!
//! A symbol with a nominal value stands for a number that may be chosen later, but then keeps its value. Expressions of such
//! symbols alone are *fixed*. They remain symbolic, have zero rate, and are evaluated at the nominal values wherever a number
//! is required.

use super::graph::Graph;
use super::node::{ExprId, Node, SymbolId};

impl Graph {
    /// Declares a symbol fixed, with its nominal value.
    ///
    /// # Panics
    /// Panics if the symbol belongs to another graph and has no name in this one.
    pub fn set_nominal(&mut self, symbol: SymbolId, value: f64) {
        assert!(
            symbol.index() < self.symbol_count(),
            "a symbol belongs to the graph that named it"
        );
        self.symbol_table.set_nominal(symbol, value);
        if self.find(&Node::Symbol(symbol)).is_some() {
            self.revalue();
        }
    }

    /// Returns the nominal value of a symbol; `None` if it has none.
    pub fn nominal(&self, symbol: SymbolId) -> Option<f64> {
        self.symbol_table.nominal(symbol)
    }

    /// Writes the nominal values into a table of all symbols, and leaves the other entries unchanged.
    pub fn fill_nominal(&self, symbols: &mut [f64]) {
        for (place, nominal) in symbols.iter_mut().zip(self.symbol_table.nominal_values()) {
            if let Some(nominal) = nominal {
                *place = *nominal;
            }
        }
    }

    /// True if every symbol of the expression has a nominal value, as in a constant.
    pub fn is_fixed(&self, expr: ExprId) -> bool {
        self.worth(expr).is_fixed
    }

    /// Returns the value of a fixed expression at the nominal values of its symbols, which may be non-finite; `None` if another
    /// symbol occurs.
    pub fn constant_value(&self, expr: ExprId) -> Option<f64> {
        let worth = self.worth(expr);
        worth.is_fixed.then_some(worth.value)
    }
}
