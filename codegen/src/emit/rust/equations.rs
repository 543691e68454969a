//! Φ, Φ_q, Φ_t and γ as functions.

use proc_macro2::TokenStream;
use quote::quote;

use super::docs::docs;
use super::expression::{identifier, written};
use super::given::Given;
use super::layout::comment;
use super::lints;
use super::literal::count;
use crate::emit::named_parts::NamedParts;
use crate::emit::{Notation, text};
use crate::expr::ExprId;
use crate::program::{Inputs, Program, Straight, Textbook};
use crate::system::{Row, System};

/// The four functions of the textbook view, and what is monitored besides.
pub(super) fn equations(system: &System, program: &Program, textbook: &Textbook) -> TokenStream {
    let phi = vector(
        system,
        program,
        &textbook.residual,
        "phi",
        "Φ(q, t): the residuals of all joints and drivers, zero where the mechanism is assembled.",
        |row| row.residual,
    );
    let phi_t = vector(
        system,
        program,
        &textbook.time_derivative,
        "phi_t",
        "Φ_t(q, t): the partial derivatives of the residuals in t. The rates solve Φ_q q̇ = −Φ_t.",
        |row| row.time_derivative,
    );
    let gamma = vector(
        system,
        program,
        &textbook.gamma,
        "gamma",
        "γ(q, q̇, t) = −((Φ_q q̇)_q q̇ + 2 Φ_qt q̇ + Φ_tt). The accelerations solve Φ_q q̈ = γ.",
        |row| row.gamma,
    );
    let phi_q = matrix(system, program, &textbook.jacobian);
    let monitored = textbook.monitored.as_ref();
    let monitored = monitored.map(|straight| monitored_rows(system, program, straight));
    quote! { #phi #phi_q #phi_t #gamma #monitored }
}

/// The parameters of a function; one that is not read begins with an underscore.
fn parameters(inputs: Inputs, with_rates: bool, given: Given) -> TokenStream {
    let q = if inputs.position {
        quote!(q)
    } else {
        quote!(_q)
    };
    let t = if inputs.time { quote!(t) } else { quote!(_t) };
    let qd = if inputs.rate { quote!(qd) } else { quote!(_qd) };
    let given = given.declared(inputs);
    if with_rates {
        quote!(#q: &Coordinates, #qd: &Coordinates, #given #t: f64)
    } else {
        quote!(#q: &Coordinates, #given #t: f64)
    }
}

/// A list of the rows with their joints and formulas; rows that are zero are not listed. Long choices have the names that the
/// function gives them.
fn row_list(system: &System, straight: &Straight, of: &dyn Fn(&Row) -> ExprId) -> Vec<String> {
    let zero = system.mechanism.graph.zero();
    let parts = NamedParts::of_function(system, straight);
    system
        .rows
        .iter()
        .enumerate()
        .filter(|(_, row)| of(row) != zero)
        .map(|(index, row)| {
            let formula = text::Printer::new(system, &row.bodies, Notation::Ascii)
                .naming(&parts)
                .expression(of(row));
            let joint = &system.mechanism.joints[row.joint];
            let first = index == 0 || system.rows[index - 1].joint != row.joint;
            let remark = if first {
                joint.docs.join(" ")
            } else {
                String::new()
            };
            let line = format!("- {index}, {}: `{formula}`", joint.label);
            if remark.trim().is_empty() {
                line
            } else {
                format!("{line}. {}", remark.trim())
            }
        })
        .collect()
}

fn vector(
    system: &System,
    program: &Program,
    straight: &Straight,
    name: &str,
    meaning: &str,
    of: impl Fn(&Row) -> ExprId,
) -> TokenStream {
    let (statements, results) = written(system, program, straight);
    let size = count(system.rows.len());
    let mut lines = vec![meaning.to_string(), String::new()];
    lines.extend(row_list(system, straight, &of));
    let text = docs(lines);
    let function = identifier(name);
    let parameters = parameters(straight.inputs, name == "gamma", Given::of(system));
    let zero = system.mechanism.graph.zero();
    // Rows that are zero need no name; those that are not are named after their joint.
    let rows: Vec<_> = system
        .rows
        .iter()
        .map(|row| identifier(&row.name))
        .collect();
    let named = system
        .rows
        .iter()
        .zip(&rows)
        .zip(&results)
        .filter(|((row, _), _)| of(row) != zero);
    let bindings = named.map(|((_, name), value)| quote!(let #name = #value;));
    let entries = system.rows.iter().zip(&rows).map(|(row, name)| {
        if of(row) == zero {
            quote!(0.0)
        } else {
            quote!(#name)
        }
    });
    let function = quote! {
        pub fn #function(#parameters) -> SVector<f64, #size> {
            #(#statements)*
            #(#bindings)*
            SVector::from([#(#entries),*])
        }
    };
    let allow = lints::unused_item(&function);
    quote!(#text #allow #function)
}

/// The residuals of the rows that are not solved.
fn monitored_rows(system: &System, program: &Program, straight: &Straight) -> TokenStream {
    let (statements, results) = written(system, program, straight);
    let size = count(system.monitored.len());
    let mut lines = vec![
        "The residuals of the redundant equations, in m or rad: they follow from those that are solved, so they are zero but for rounding wherever Φ is."
            .to_string(),
        String::new(),
    ];
    for (index, row) in system.monitored.iter().enumerate() {
        let formula = text::formula(system, &row.bodies, Notation::Ascii, row.residual);
        let joint = &system.mechanism.joints[row.joint];
        lines.push(format!("- {index}, {}: `{formula}`", joint.label));
    }
    let text = docs(lines);
    let parameters = parameters(straight.inputs, false, Given::of(system));
    let function = quote! {
        pub fn monitored(#parameters) -> [f64; #size] {
            #(#statements)*
            [#(#results),*]
        }
    };
    let allow = lints::unused_item(&function);
    quote!(#text #allow #function)
}

fn matrix(system: &System, program: &Program, straight: &Straight) -> TokenStream {
    let (statements, results) = written(system, program, straight);
    let size = count(system.rows.len());
    let mut values = results.iter();
    let mut entries = Vec::with_capacity(results.len());
    for (index, row) in system.rows.iter().enumerate() {
        entries.push(comment(&format!(
            "{}: {}",
            row.name, system.mechanism.joints[row.joint].label
        )));
        let row_number = count(index);
        for (entry, value) in row.jacobian.iter().zip(values.by_ref()) {
            let column = count(entry.coordinate);
            entries.push(quote!(phi_q[(#row_number, #column)] = #value;));
        }
    }
    let mut lines = vec![
        "Φ_q(q, t): the Jacobian, one row per equation and one column per coordinate. What is not assigned is zero."
            .to_string(),
        String::new(),
        format!("Columns: {}.", numbered(system.coordinates.iter().map(|coordinate| coordinate.name.as_str()))),
        String::new(),
        format!("Rows: {}.", numbered(system.rows.iter().map(|row| row.name.as_str()))),
    ];
    let text = docs(lines.drain(..));
    let parameters = parameters(straight.inputs, false, Given::of(system));
    let function = quote! {
        pub fn phi_q(#parameters) -> SMatrix<f64, #size, #size> {
            #(#statements)*
            let mut phi_q = SMatrix::zeros();
            #(#entries)*
            phi_q
        }
    };
    let allow = lints::unused_item(&function);
    quote!(#text #allow #function)
}

/// `0 x1, 1 y1, …`
fn numbered<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let names: Vec<String> = names
        .enumerate()
        .map(|(index, name)| format!("{index} `{name}`"))
        .collect();
    names.join(", ")
}
