//! Splines → constants of the runtime's type `Table`.

use std::collections::HashSet;

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::docs::docs;
use super::lints;
use super::literal::count;
use crate::emit::module::Module;
use crate::expr::Spline;

/// By how much of their distance starts may be off where they are called equally spaced.
const EVEN: f64 = 1e-6;

/// The constant that holds a table. No other constant begins like this.
pub(super) fn table_name(table: &str) -> Ident {
    format_ident!("TABLE_{}", table.to_uppercase())
}

/// The tables that the code mentions.
pub(super) fn tables(module: &Module<'_>, mentioned: &HashSet<&str>) -> TokenStream {
    let system = module.system;
    let splines = system.mechanism.graph.splines();
    let constants = splines.map(|(id, spline)| {
        let name = table_name(&spline.name);
        if !mentioned.contains(name.to_string().as_str()) {
            return TokenStream::new();
        }
        let declared = system.mechanism.tables.iter();
        let own = declared
            .filter(|table| table.spline == id)
            .flat_map(|table| table.docs.clone());
        let mut lines: Vec<String> = own.collect();
        if lines.is_empty() {
            lines.push(format!("The table `{}`.", spline.name));
        }
        constant(module, &name, spline, lines)
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
        ::linkwright::Table {
            starts: [#(#starts),*],
            pieces: [#(#pieces),*],
            spacing: #spacing,
            period: #period,
        }
    };
    let allow = lints::approximate(&table);
    quote!(#text #allow const #name: Table<#length> = #table;)
}

/// The distance between starts that are equally spaced, but for rounding.
fn spacing(starts: &[f64]) -> Option<f64> {
    let (first, last) = (*starts.first()?, *starts.last()?);
    let spacing = (last - first) / (starts.len() - 1) as f64;
    let even = starts.iter().enumerate().all(|(place, start)| {
        let expected = first + spacing * place as f64;
        (start - expected).abs() <= EVEN * spacing
    });
    // Two starts are found without it.
    (even && starts.len() > 2).then_some(spacing)
}
