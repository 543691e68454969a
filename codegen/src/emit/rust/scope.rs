//! Where a value stands → how Rust reads it.

use proc_macro2::TokenStream;

use super::code::tokens;
use super::names::identifier_text;
use crate::emit::module::scope::{Location, Scope};
use crate::expr::SymbolId;

impl Scope<'_> {
    /// How a variable is read.
    pub(super) fn symbol(&self, symbol: SymbolId) -> TokenStream {
        tokens(&self.read(symbol))
    }

    /// The same as text.
    pub(super) fn read(&self, symbol: SymbolId) -> String {
        match self.locate(symbol) {
            Location::Local(name) => identifier_text(&name),
            Location::Sign(branch) => {
                format!("branches.{}.sign::<Scalar>()", identifier_text(branch))
            }
            Location::TimeWindow(part) => format!("window.{}", identifier_text(part)),
            Location::Field(symbol) => self.module.field_text(symbol, "at"),
            Location::Last(symbol) => self.module.field_text(symbol, "last"),
            Location::LastTime => "last.t".to_string(),
            Location::Coordinate(component) => {
                format!("{}.{}", component.vector, identifier_text(component.name))
            }
            Location::Parameter(name) => format!("parameters.{}", identifier_text(&name)),
            Location::Input {
                name,
                level,
                before,
            } => {
                let inputs = if before { "before" } else { "inputs" };
                format!("{inputs}.{}.{level}", identifier_text(&name))
            }
        }
    }
}
