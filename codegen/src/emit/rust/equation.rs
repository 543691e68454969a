//! A function that the runtime calls with vectors and the time → what it takes out of them, its statements and its results.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::code::Code;
use super::names::identifier;
use crate::emit::module::scope::Scope;
use crate::expr::SymbolId;

/// The statements of a function, and what they read.
pub(super) struct Equation {
    /// What it reads of its type.
    pub given: TokenStream,
    pub statements: Code,
    pub results: Vec<TokenStream>,
    code: String,
}

impl Equation {
    pub fn new(scope: &Scope<'_>) -> Equation {
        let reads = scope.reads();
        let mut statements = scope.plain_statements();
        let results = scope.results();
        let own = [
            (reads.frame, quote!(let at = self.at;)),
            (reads.parameters, quote!(let parameters = self.parameters;)),
            (reads.inputs, quote!(let inputs = self.inputs;)),
        ];
        let given = own.into_iter().filter(|(is_read, _)| *is_read);
        let given: TokenStream = given.map(|(_, taken)| taken).collect();
        let code = quote!(#statements #(#results)*).to_string();
        let is_alone = |symbol: &SymbolId| {
            let name = scope.symbol(*symbol).to_string();
            words(&code).filter(|word| *word == name).count() == 1
        };
        let idle: Vec<SymbolId> = scope.sines_and_cosines().filter(is_alone).collect();
        if !idle.is_empty() {
            scope.leave_unnamed(idle);
            statements = scope.plain_statements();
        }
        Equation {
            given,
            statements,
            results,
            code,
        }
    }

    /// An argument that is taken apart into values, as far as they are read.
    pub fn pattern(&self, symbols: &[SymbolId], whole: &str, scope: &Scope<'_>) -> TokenStream {
        let names: Vec<TokenStream> = symbols.iter().map(|&it| scope.symbol(it)).collect();
        let is_read = |name: &TokenStream| mentions(&self.code, &name.to_string());
        if !names.iter().any(is_read) {
            let unused = identifier(&format!("_{whole}"));
            return quote!(#unused);
        }
        let names = names.iter().map(|name| match is_read(name) {
            true => name.clone(),
            false => quote!(_),
        });
        quote!(&[#(#names),*])
    }

    pub fn time(&self) -> Ident {
        let is_read = mentions(&self.code, "t");
        identifier(if is_read { "t" } else { "_t" })
    }
}

/// Whether code mentions a name.
fn mentions(code: &str, name: &str) -> bool {
    words(code).any(|word| word == name)
}

pub(super) fn words(code: &str) -> impl Iterator<Item = &str> {
    code.split(|character: char| !(character.is_alphanumeric() || character == '_'))
}
