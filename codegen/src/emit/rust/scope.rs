//! Where a value stands → how Rust reads it.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::names::identifier;
use crate::emit::module::scope::{Location, Scope};
use crate::expr::SymbolId;

impl Scope<'_> {
    /// How a variable is read.
    pub(super) fn symbol(&self, symbol: SymbolId) -> TokenStream {
        match self.locate(symbol) {
            Location::Local(name) => {
                let name = identifier(&name);
                quote!(#name)
            }
            Location::Sign(branch) => {
                let branch = identifier(branch);
                quote!(branches.#branch.sign::<Scalar>())
            }
            Location::Span(part) => {
                let part = identifier(part);
                quote!(span.#part)
            }
            Location::Field(symbol) => self.module.field(symbol, &format_ident!("at")),
            Location::Last(symbol) => self.module.field(symbol, &format_ident!("last")),
            Location::LastTime => quote!(last.t),
            Location::Coordinate(component) => {
                let (vector, name) = (format_ident!("{}", component.vector), component.name);
                let name = identifier(name);
                quote!(#vector.#name)
            }
            Location::Parameter(name) => {
                let field = identifier(&name);
                quote!(parameters.#field)
            }
            Location::Input {
                name,
                level,
                before,
            } => {
                let (field, level) = (identifier(&name), format_ident!("{level}"));
                let inputs = format_ident!("{}", if before { "before" } else { "inputs" });
                quote!(#inputs.#field.#level)
            }
        }
    }
}
