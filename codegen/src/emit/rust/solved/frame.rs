//! The values that blocks share, and the assembly modes.

use proc_macro2::TokenStream;
use quote::quote;

use super::names::plain_name;
use crate::emit::rust::docs::docs;
use crate::emit::rust::expression::identifier;
use crate::emit::rust::literal::float;
use crate::program::solved::SolvedProgram;
use crate::system::{SymbolRole, System};

/// The private fields of the frame, with a comma after each.
pub(in crate::emit::rust) fn frame_fields(system: &System, solved: &SolvedProgram) -> TokenStream {
    let fields = solved.fields.iter().map(|&symbol| {
        let name = plain_name(symbol, system);
        quote!(#name: f64,)
    });
    quote!(#(#fields)*)
}

/// The values of these fields in the drawing, where Newton-Raphson starts from them.
pub(in crate::emit::rust) fn frame_values(system: &System, solved: &SolvedProgram) -> TokenStream {
    let graph = &system.mechanism.graph;
    let values = solved.fields.iter().map(|&symbol| {
        let name = plain_name(symbol, system);
        let drawn = match system.roles[symbol.index()] {
            SymbolRole::Position(unknown) => graph
                .constant_value(system.vector_form.unknowns[unknown].estimate)
                .unwrap_or(0.0),
            _ => 0.0,
        };
        let drawn = float(drawn);
        quote!(#name: #drawn,)
    });
    quote!(#(#values)*)
}

/// `struct Branches` with the drawing's choice.
pub(in crate::emit::rust) fn branches(solved: &SolvedProgram) -> TokenStream {
    let names: Vec<_> = solved
        .branches
        .iter()
        .map(|branch| identifier(&branch.name))
        .collect();
    let texts = solved
        .branches
        .iter()
        .map(|branch| docs([sentence(&branch.meaning)]));
    let drawn = solved.branches.iter().map(|branch| {
        if branch.positive {
            quote!(Branch::Positive)
        } else {
            quote!(Branch::Negative)
        }
    });
    quote! {
        /// The assembly mode of every loop that is solved in closed form.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub struct Branches {
            #(#texts pub #names: Branch,)*
        }

        #[allow(dead_code)]
        impl Branches {
            /// The modes of the drawing.
            pub const DRAWN: Self = Self { #(#names: #drawn),* };
        }
    }
}

fn sentence(text: &str) -> String {
    let mut characters = text.chars();
    let first = characters.next().map(char::to_uppercase);
    first.map_or(String::new(), |first| {
        first.chain(characters).chain(['.']).collect()
    })
}
