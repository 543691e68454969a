//! Assigns unique names to the values of a function or of a frame.

use std::collections::{HashMap, HashSet};

use crate::expr::{IdMap, SymbolId};
use crate::pool::Pool;
use crate::program::function::Function;
use crate::system::System;

/// Names of the values of one function or one frame.
#[derive(Clone, Debug, Default)]
pub struct LocalNames {
    // Only looked up.
    names: IdMap<SymbolId, String>,
}

impl LocalNames {
    /// Names the definitions of a function in order, except for those that `is_kept` elsewhere.
    pub fn of(
        function: &Function,
        pool: &Pool,
        system: &System,
        is_kept: impl Fn(SymbolId) -> bool,
        reserved: &[&str],
        spell: impl Fn(&str) -> String,
    ) -> LocalNames {
        let defined = function.targets().filter(|&symbol| !is_kept(symbol));
        LocalNames::of_symbols(defined, pool, system, reserved, spell)
    }

    /// Names these symbols by their preferred names, spelled by `spell`, and numbered if a name is taken or reserved.
    pub fn of_symbols(
        symbols: impl Iterator<Item = SymbolId>,
        pool: &Pool,
        system: &System,
        reserved: &[&str],
        spell: impl Fn(&str) -> String,
    ) -> LocalNames {
        let mut taken: HashSet<String> = reserved.iter().map(|name| name.to_string()).collect();
        let mut names = IdMap::default();
        // Names of a base with smaller numbers are all taken.
        let mut numbers: HashMap<String, usize> = HashMap::new();
        for symbol in symbols {
            if names.contains_key(&symbol) {
                continue;
            }
            let base = spell(&system.symbol_name(symbol, pool));
            let mut name = base.clone();
            while !taken.insert(name.clone()) {
                let number = numbers.entry(base.clone()).or_insert(2);
                name = format!("{base}_{number}");
                *number += 1;
            }
            names.insert(symbol, name);
        }
        LocalNames { names }
    }

    /// Returns the name of a symbol; `None` if the symbol is not among the named ones.
    pub fn name_of(&self, symbol: SymbolId) -> Option<&str> {
        self.names.get(&symbol).map(String::as_str)
    }
}
