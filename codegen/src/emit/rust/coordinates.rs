//! The named coordinates.

use proc_macro2::TokenStream;
use quote::quote;

use super::docs::doc_lines;
use super::layout::Verbatim;
use super::module::derives;
use super::names::identifier;
use crate::emit::module::{Module, documentation};

/// `struct Coordinates` with its names and the drawn pose.
pub(super) fn coordinates(module: &Module<'_>) -> TokenStream {
    let system = module.system;
    let mut text = Verbatim::default();
    text.open("::linkwright::generated::coordinates! {");
    text.docs(documentation::COORDINATES);
    text.tokens(derives(system.coordinates.len()));
    text.open("Coordinates: Scalar {");
    for coordinate in &system.coordinates {
        text.docs(doc_lines(documentation::of_coordinate(coordinate, system)));
        // The estimates were found to be finite constants when they were read.
        let drawn = module.pool.graph.constant_value(coordinate.estimate);
        let (name, value) = (
            identifier(&coordinate.name),
            module.number(drawn.unwrap_or(0.0)),
        );
        text.line(format!("{name} = {value},"));
    }
    text.close("}");
    text.close("}");
    let item = text.item();
    quote!(#item)
}
