//! Splines → constants of the runtime's type `Table`.

use std::collections::HashSet;

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::docs::docs;
use super::lints;
use super::literal::count;
use crate::emit::module::Module;
use crate::emit::module::tables::{docs_of, spacing};
use crate::expr::Spline;

/// The constant that holds a table. No other constant begins like this.
pub(super) fn table_name(table: &str) -> Ident {
    format_ident!("TABLE_{}", table.to_uppercase())
}

/// The tables that the code mentions.
pub(super) fn tables(module: &Module<'_>, mentioned: &HashSet<&str>) -> TokenStream {
    let system = module.system;
    let splines = module.pool.graph.splines();
    let constants = splines.map(|(id, spline)| {
        let name = table_name(&spline.name);
        if !mentioned.contains(name.to_string().as_str()) {
            return TokenStream::new();
        }
        constant(module, &name, spline, docs_of(id, module.pool, system))
    });
    constants.collect()
}

fn constant(module: &Module<'_>, name: &Ident, spline: &Spline, lines: Vec<String>) -> TokenStream {
    let (text, length) = (docs(lines), count(spline.starts.len()));
    let starts = spline.starts.iter().map(|&start| module.float(start));
    let pieces = spline.pieces.iter().map(|piece| {
        let coefficients = piece.iter().map(|&coefficient| module.float(coefficient));
        quote!([#(#coefficients),*])
    });
    let optional = |value: Option<f64>| match value {
        Some(value) => {
            let value = module.float(value);
            quote!(Some(#value))
        }
        None => quote!(None),
    };
    let (spacing, period) = (optional(spacing(&spline.starts)), optional(spline.period));
    let table = quote! {
        ::linkwright::generated::Table {
            starts: [#(#starts),*],
            pieces: [#(#pieces),*],
            spacing: #spacing,
            period: #period,
        }
    };
    let allow = lints::approximate(&table);
    quote!(#text #allow const #name: Table<#length> = #table;)
}
