//! What drivers exert, what joints carry and what is stored, as functions of the frame.

use proc_macro2::TokenStream;
use quote::quote;

use super::docs::docs;
use super::names::identifier;
use crate::emit::module::Module;
use crate::emit::module::forces::force_functions;

/// The functions of all forces; nothing where none is asked for.
pub(super) fn forces(module: &Module<'_>) -> TokenStream {
    let functions = force_functions(module).into_iter().map(|function| {
        let (name, text) = (identifier(&function.name), docs(function.lines));
        let fields: Vec<TokenStream> = function
            .fields
            .iter()
            .map(|&field| {
                let field = module.field_name(field);
                quote!(self.#field)
            })
            .collect();
        match &fields[..] {
            [only] => quote!(#text pub fn #name(&self) -> Scalar { #only }),
            _ => quote!(#text pub fn #name(&self) -> [Scalar; 2] { [#(#fields),*] }),
        }
    });
    functions.collect()
}
