//! The values of a function or of a frame → names that are told apart.

use std::collections::{HashMap, HashSet};

use crate::expr::{IdMap, SymbolId};
use crate::program::function::Function;
use crate::system::System;

/// What the values of one function or one frame are called.
#[derive(Clone, Debug, Default)]
pub struct LocalNames {
    // Only looked up.
    names: IdMap<SymbolId, String>,
}

impl LocalNames {
    /// Names for everything that a function defines but what `is_kept` elsewhere, in order of definition.
    pub fn of(
        function: &Function,
        system: &System,
        is_kept: impl Fn(SymbolId) -> bool,
        reserved: &[&str],
        spell: impl Fn(&str) -> String,
    ) -> LocalNames {
        let defined = function.targets().filter(|&symbol| !is_kept(symbol));
        LocalNames::of_symbols(defined, system, reserved, spell)
    }

    /// Names for these symbols: each as it wishes to be called, spelled by `spell`, and numbered where that is taken or reserved.
    pub fn of_symbols(
        symbols: impl Iterator<Item = SymbolId>,
        system: &System,
        reserved: &[&str],
        spell: impl Fn(&str) -> String,
    ) -> LocalNames {
        let mut taken: HashSet<String> = reserved.iter().map(|name| name.to_string()).collect();
        let mut names = IdMap::default();
        // Below its number every name of a base is taken.
        let mut numbers: HashMap<String, usize> = HashMap::new();
        for symbol in symbols {
            if names.contains_key(&symbol) {
                continue;
            }
            let base = spell(&system.symbol_name(symbol));
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

    /// What a symbol is called; `None` for what is none of them.
    pub fn name_of(&self, symbol: SymbolId) -> Option<&str> {
        self.names.get(&symbol).map(String::as_str)
    }
}
