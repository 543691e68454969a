//! What values are called inside a block's function.

use std::collections::HashSet;

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use crate::emit::rust::expression::{Names, identifier};
use crate::emit::rust::given;
use crate::expr::{ExprId, SymbolId};
use crate::program::Straight;
use crate::program::solved::SolvedProgram;
use crate::system::{SymbolRole, System};

/// Coordinates and shared values are fields of the frame `at`; everything else is local.
pub(super) struct BlockNames<'a> {
    pub system: &'a System,
    pub solved: &'a SolvedProgram,
    /// What has a name of its own: functions of time, and what is shared.
    pub named: &'a Straight,
    /// Unknowns that are local here although they are coordinates: the tears while Newton-Raphson looks for them.
    pub local: HashSet<SymbolId>,
}

impl BlockNames<'_> {
    /// Whether a symbol is a field of the frame.
    pub(super) fn is_field(&self, symbol: SymbolId) -> bool {
        if self.local.contains(&symbol) {
            return false;
        }
        self.coordinate(symbol).is_some() || self.solved.is_field(symbol)
    }

    /// `q`, `qd` or `qdd` and the coordinate, where the frame holds all of them.
    fn coordinate(&self, symbol: SymbolId) -> Option<(&'static str, usize)> {
        if self.solved.outputs.is_some() {
            return None;
        }
        let (vector, unknown) = match self.system.roles[symbol.index()] {
            SymbolRole::Position(unknown) => ("q", unknown),
            SymbolRole::Rate(unknown) => ("qd", unknown),
            SymbolRole::Acceleration(unknown) => ("qdd", unknown),
            _ => return None,
        };
        (unknown < self.system.coordinates.len()).then_some((vector, unknown))
    }

    /// A field of a frame.
    pub(super) fn field(&self, symbol: SymbolId, frame: &str) -> TokenStream {
        let frame = format_ident!("{frame}");
        match self.coordinate(symbol) {
            Some((vector, unknown)) => {
                let (vector, field) = (
                    format_ident!("{vector}"),
                    identifier(self.system.unknown_name(unknown)),
                );
                quote!(#frame.#vector.#field)
            }
            None => {
                let name = plain_name(symbol, self.system);
                quote!(#frame.#name)
            }
        }
    }
}

/// The plain name of a symbol: `phi_c3`, `phi_c3_rate`, `l_c3_x`.
pub(super) fn plain_name(symbol: SymbolId, system: &System) -> Ident {
    let name = match system.roles[symbol.index()] {
        SymbolRole::Position(unknown) => system.unknown_name(unknown).to_string(),
        SymbolRole::Rate(unknown) => format!("{}_rate", system.unknown_name(unknown)),
        SymbolRole::Acceleration(unknown) => {
            format!("{}_acceleration", system.unknown_name(unknown))
        }
        SymbolRole::Time => "t".to_string(),
        SymbolRole::Arm(_)
        | SymbolRole::Intermediate
        | SymbolRole::Parameter(_)
        | SymbolRole::Input { .. } => system.local_name(symbol).to_string(),
    };
    identifier(&name)
}

impl Names for BlockNames<'_> {
    fn value(&self, expr: ExprId) -> Option<Ident> {
        self.named.name_of(expr).map(identifier)
    }

    fn symbol(&self, symbol: SymbolId) -> TokenStream {
        if let Some(branch) = self.solved.branch_of(symbol) {
            let name = identifier(&branch.name);
            return quote!(branches.#name.sign::<f64>());
        }
        if let Some(given) = given::read(symbol, self.system) {
            return given;
        }
        if !self.is_field(symbol) {
            let name = plain_name(symbol, self.system);
            return quote!(#name);
        }
        self.field(symbol, "at")
    }
}
