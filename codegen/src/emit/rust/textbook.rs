//! Φ, Φ_q, Φ_t and γ as functions, and all equations as one dense system.

use proc_macro2::TokenStream;
use quote::quote;

use super::code::comment;
use super::docs::docs;
use super::layout::Verbatim;
use super::lints;
use super::literal::count;
use super::module::only;
use super::names::identifier;
use super::names::type_name;
use crate::emit::module::scope::{Place, Reads, Scope};
use crate::emit::module::{Module, documentation};
use crate::expr::ExprId;
use crate::joint::Quantity;
use crate::program::{Function, Lengths};
use crate::system::Row;

/// The functions of the textbook view, and what is monitored besides.
pub(super) fn functions(module: &Module<'_>) -> TokenStream {
    let Some(textbook) = &module.program.textbook else {
        return TokenStream::new();
    };
    let phi = vector(
        module,
        &textbook.residual,
        "phi",
        documentation::PHI,
        |row| row.residual,
    );
    let phi_t = vector(
        module,
        &textbook.time_derivative,
        "phi_t",
        documentation::PHI_T,
        |row| row.time_derivative,
    );
    let gamma = vector(
        module,
        &textbook.gamma,
        "gamma",
        documentation::GAMMA,
        |row| row.gamma,
    );
    let phi_q = matrix(module, &textbook.jacobian);
    let monitored = textbook
        .monitored
        .as_ref()
        .map(|function| monitored(module, function));
    quote! { #phi #phi_q #phi_t #gamma #monitored }
}

/// The arguments of a function; one that is not read begins with an underscore.
fn arguments(module: &Module<'_>, reads: Reads, with_rates: bool) -> TokenStream {
    let name = |name: &str, is_read: bool| match is_read {
        true => identifier(name),
        false => identifier(&format!("_{name}")),
    };
    let (q, qd, t) = (
        name("q", reads.position),
        name("qd", reads.rate),
        name("t", reads.time),
    );
    let rates = only(with_rates, quote!(#qd: &Coordinates,));
    let given = module.declared().arguments(reads.parameters, reads.inputs);
    quote!(#q: &Coordinates, #rates #given #t: Scalar)
}

fn vector(
    module: &Module<'_>,
    function: &Function,
    name: &str,
    title: &str,
    of: fn(&Row) -> ExprId,
) -> TokenStream {
    let system = module.system;
    let scope = Scope::new(module, function, Place::Coordinates);
    let (statements, results) = (scope.plain_statements(), scope.results());
    let zero = module.pool.graph.zero();
    let mut lines = vec![title.to_string()];
    if name == "phi" {
        lines.push(String::new());
        lines.extend(documentation::of_rows(module.pool, system, &system.rows));
    }
    let text = docs(lines);
    let reads = scope.reads();
    let arguments = arguments(module, reads, name == "gamma");
    let size = count(system.rows.len());
    let is_shown = |row: &Row| of(row) != zero;
    let rows = system.rows.iter().zip(&results).enumerate();
    let shown = rows.filter(|(_, (row, _))| is_shown(row));
    let bindings = shown.map(|(index, (row, value))| {
        let name = identifier(&row.name);
        let label = documentation::before_row(system, index, is_shown);
        let label = label.map_or(TokenStream::new(), comment);
        quote!(#label let #name = #value;)
    });
    let bindings: Vec<TokenStream> = bindings.collect();
    let entries = system.rows.iter().map(|row| match of(row) == zero {
        true => quote!(0.0),
        false => {
            let name = identifier(&row.name);
            quote!(#name)
        }
    });
    let name = identifier(name);
    let function = quote! {
        pub fn #name(#arguments) -> Vector<#size> {
            #statements
            #(#bindings)*
            Vector::from([#(#entries),*])
        }
    };
    let allow = lints::unused_item(&function);
    quote!(#text #allow #function)
}

/// The residuals of the rows that are not solved.
fn monitored(module: &Module<'_>, function: &Function) -> TokenStream {
    let system = module.system;
    let scope = Scope::new(module, function, Place::Coordinates);
    let (statements, results) = (scope.plain_statements(), scope.results());
    let size = count(system.monitored.len());
    let mut lines = vec![documentation::MONITORED.to_string(), String::new()];
    lines.extend(documentation::of_rows(
        module.pool,
        system,
        &system.monitored,
    ));
    let text = docs(lines);
    let arguments = arguments(module, scope.reads(), false);
    let function = quote! {
        pub fn monitored(#arguments) -> [Scalar; #size] {
            #statements
            [#(#results),*]
        }
    };
    let allow = lints::unused_item(&function);
    quote!(#text #allow #function)
}

fn matrix(module: &Module<'_>, function: &Function) -> TokenStream {
    let system = module.system;
    let scope = Scope::new(module, function, Place::Coordinates);
    let (statements, results) = (scope.plain_statements(), scope.results());
    let size = count(system.rows.len());
    let mut values = results.iter();
    let mut entries = Vec::with_capacity(results.len());
    for (index, row) in system.rows.iter().enumerate() {
        let label = documentation::before_row(system, index, |_| true);
        entries.push(label.map_or(TokenStream::new(), comment));
        let row_number = count(index);
        for (entry, value) in row.jacobian.iter().zip(values.by_ref()) {
            let column = count(entry.coordinate);
            entries.push(quote!(phi_q[(#row_number, #column)] = #value;));
        }
    }
    let text = docs(documentation::of_jacobian(system));
    let arguments = arguments(module, scope.reads(), false);
    let function = quote! {
        pub fn phi_q(#arguments) -> Matrix<#size, #size> {
            #statements
            let mut phi_q = Matrix::zeros();
            #(#entries)*
            phi_q
        }
    };
    let allow = lints::unused_item(&function);
    quote!(#text #allow #function)
}

/// `struct Textbook`: the dense system as the runtime solves it.
pub(super) fn dense(module: &Module<'_>) -> TokenStream {
    let Some(textbook) = &module.program.textbook else {
        return TokenStream::new();
    };
    let system = module.system;
    let rows: Vec<Quantity> = system.rows.iter().map(|row| row.quantity).collect();
    let columns: Vec<Quantity> = system.coordinates.iter().map(|it| it.quantity).collect();
    let mut text = Verbatim::default();
    text.open("::linkwright::generated::textbook! {");
    let mechanism = type_name(&system.mechanism.name);
    text.line(format!("{mechanism}, {};", rows.len()));
    for line in module.declared().lines() {
        text.line(line);
    }
    let length = length(module, &textbook.scaled_by);
    if !length.statement.is_empty() {
        text.line("lengths: length = characteristic_length(parameters);");
    }
    for (title, quantities) in [("rows", rows), ("columns", columns)] {
        let scales = scales(&quantities, &length.name).to_string();
        let elements = scales.strip_prefix('[').and_then(|it| it.strip_suffix(']'));
        // What is in brackets has no commas in it.
        match elements.filter(|it| !it.contains(';')) {
            Some(elements) if scales.len() > 80 => {
                text.open(&format!("{title}: ["));
                text.list(elements.split(',').map(str::trim));
                text.close("];");
            }
            _ => {
                let scales = scales.replace(" ;", ";").replace(" ,", ",");
                text.line(format!("{title}: {scales};"));
            }
        }
    }
    text.close("}");
    text.item()
}

/// `fn characteristic_length`: the largest length, where parameters change one.
pub(super) fn characteristic_length(module: &Module<'_>) -> TokenStream {
    let textbook = module.program.textbook.as_ref();
    let Some((lengths, function)) = textbook.and_then(|it| {
        let lengths = &it.scaled_by;
        Some((lengths, lengths.following.as_ref()?))
    }) else {
        return TokenStream::new();
    };
    let scope = Scope::new(module, function, Place::Coordinates);
    let (statements, results) = (scope.plain_statements(), scope.results());
    let otherwise = module.float(lengths.nominal);
    let function = quote! {
        fn characteristic_length(parameters: &Parameters) -> Scalar {
            #statements
            largest_length(&[#(#results),*], #otherwise)
        }
    };
    let allow = lints::unused_item(&function);
    quote! {
        /// By what lengths are scaled.
        #allow
        #function
    }
}

/// By what lengths are scaled: a statement that finds it, and what it is called then.
pub(super) struct Length {
    pub statement: TokenStream,
    pub name: TokenStream,
}

/// The largest of some lengths, or a number where no parameter changes them.
pub(super) fn length(module: &Module<'_>, lengths: &Lengths) -> Length {
    let otherwise = module.float(lengths.nominal);
    let Some(function) = &lengths.following else {
        return Length {
            statement: TokenStream::new(),
            name: otherwise,
        };
    };
    let scope = Scope::new(module, function, Place::Coordinates);
    let (statements, results) = (scope.plain_statements(), scope.results());
    Length {
        statement: quote! {
            let parameters = &self.parameters;
            #statements
            let length = largest_length(&[#(#results),*], #otherwise);
        },
        name: quote!(length),
    }
}

/// By what rows or columns with these quantities are scaled.
pub(super) fn scales(quantities: &[Quantity], length: &TokenStream) -> TokenStream {
    let scales = quantities.iter().map(|it| scale(*it, length));
    let scales: Vec<TokenStream> = scales.collect();
    let size = count(scales.len());
    match scales.split_first() {
        Some((first, others)) if others.iter().all(|it| it.to_string() == first.to_string()) => {
            quote!([#first; #size])
        }
        _ => quote!([#(#scales),*]),
    }
}

/// What values of a quantity are scaled by.
fn scale(quantity: Quantity, length: &TokenStream) -> TokenStream {
    let power = quantity.power_of_length();
    let mut product = length.clone();
    for _ in 1..power.unsigned_abs() {
        product = quote!(#product * #length);
    }
    match power {
        0 => quote!(1.0),
        1.. => product,
        _ => quote!(1.0 / (#product)),
    }
}
