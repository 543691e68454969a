//! Numbers symbols by their names, and stores the nominal values of fixed ones.
//!
//! Each name has one symbol, and symbols are numbered in order of first use.

use std::collections::HashMap;

use super::node::SymbolId;

/// Symbols of one graph.
#[derive(Clone, Debug, Default)]
pub(super) struct SymbolTable {
    names: Vec<String>,
    /// Symbols by name; never iterated.
    by_name: HashMap<String, SymbolId>,
    /// Nominal values by symbol, up to the last symbol with one.
    nominal_values: Vec<Option<f64>>,
}

impl SymbolTable {
    /// Returns the symbol of this name; `None` if it does not exist.
    pub fn find(&self, name: &str) -> Option<SymbolId> {
        self.by_name.get(name).copied()
    }

    /// Adds a symbol of a new name.
    pub fn add(&mut self, name: &str) -> SymbolId {
        assert!(
            self.names.len() < u32::MAX as usize,
            "symbols are numbered with 32 bits"
        );
        let symbol = SymbolId(self.names.len() as u32);
        self.names.push(name.to_owned());
        self.by_name.insert(name.to_owned(), symbol);
        symbol
    }

    /// Returns the name of a symbol.
    pub fn name(&self, symbol: SymbolId) -> &str {
        &self.names[symbol.index()]
    }

    /// Returns the number of symbols.
    pub fn len(&self) -> usize {
        self.names.len()
    }

    /// Sets the nominal value of a symbol.
    pub fn set_nominal(&mut self, symbol: SymbolId, value: f64) {
        if self.nominal_values.len() <= symbol.index() {
            self.nominal_values.resize(symbol.index() + 1, None);
        }
        self.nominal_values[symbol.index()] = Some(value);
    }

    /// Returns the nominal value of a symbol; `None` if it has none.
    pub fn nominal(&self, symbol: SymbolId) -> Option<f64> {
        self.nominal_values.get(symbol.index()).copied().flatten()
    }

    /// Returns the nominal values by symbol, up to the last symbol with one.
    pub fn nominal_values(&self) -> &[Option<f64>] {
        &self.nominal_values
    }
}
