//! The equations of blocks without a closed form, as the runtime sees them.

use std::collections::HashSet;

use proc_macro2::TokenStream;
use quote::quote;

use super::block::{Needs, equations_name, reads, statement};
use super::names::{BlockNames, plain_name};
use crate::emit::rust::docs::docs;
use crate::emit::rust::expression::Writer;
use crate::emit::rust::given::only;
use crate::emit::rust::literal::count;
use crate::emit::rust::solver::{scale, scales_by_length};
use crate::expr::{ExprId, SymbolId};
use crate::joint::Quantity;
use crate::program::Program;
use crate::program::solved::{Action, BlockProgram, NewtonBlock, SolvedProgram};
use crate::system::{SymbolRole, System};

/// A type with the equations of every Newton block.
pub(in crate::emit::rust) fn newton_blocks(
    system: &System,
    program: &Program,
    solved: &SolvedProgram,
) -> TokenStream {
    let types = solved
        .blocks
        .iter()
        .enumerate()
        .filter_map(|(index, block)| {
            Some(equations(
                index,
                block,
                block.newton.as_ref()?,
                system,
                program,
                solved,
            ))
        });
    quote!(#(#types)*)
}

/// Whether the equations of a block read what was found before it.
pub(super) fn reads_frame(
    block: &BlockProgram,
    newton: &NewtonBlock,
    system: &System,
    solved: &SolvedProgram,
) -> bool {
    let unknowns = newton.unknowns.iter();
    let own = unknowns.flat_map(|&unknown| {
        let unknown = &system.vector_form.unknowns[unknown];
        [unknown.position, unknown.rate]
    });
    let geometry = newton.geometry.iter().flat_map(Action::targets);
    let names = BlockNames {
        system,
        solved,
        named: &block.time,
        local: own.chain(geometry).collect(),
    };
    let results: Vec<ExprId> = newton.expressions().collect();
    let needed = newton.geometry_for(&results, system);
    let mut read = results
        .into_iter()
        .chain(needed.iter().flat_map(Action::values))
        .flat_map(|expr| system.mechanism.graph.symbols(expr));
    read.any(|&symbol| names.is_field(symbol))
}

/// Whether the scales of a block follow the parameters.
pub(super) fn reads_length(newton: &NewtonBlock, system: &System) -> bool {
    let unknowns = newton.unknowns.iter();
    let of_columns = unknowns.map(|&unknown| system.vector_form.unknowns[unknown].quantity);
    let mut quantities = of_columns.chain(newton.quantities.iter().copied());
    !system.lengths.is_empty() && quantities.any(|it| it.power_of_length() != 0)
}

fn equations(
    index: usize,
    block: &BlockProgram,
    newton: &NewtonBlock,
    system: &System,
    program: &Program,
    solved: &SolvedProgram,
) -> TokenStream {
    let name = equations_name(block);
    let size = count(newton.unknowns.len());
    let unknowns: Vec<_> = newton
        .unknowns
        .iter()
        .map(|&unknown| &system.vector_form.unknowns[unknown])
        .collect();
    let positions: HashSet<SymbolId> = unknowns.iter().map(|unknown| unknown.position).collect();
    let rates: HashSet<SymbolId> = unknowns.iter().map(|unknown| unknown.rate).collect();
    let geometry: HashSet<SymbolId> = newton.geometry.iter().flat_map(Action::targets).collect();
    let part = |results: &[ExprId], with_rates: bool| {
        let mut local: HashSet<SymbolId> = positions.union(&geometry).copied().collect();
        if with_rates {
            local.extend(&rates);
        }
        // The geometry comes first and knows functions of time alone; what the results share comes after it.
        let first_names = BlockNames {
            system,
            solved,
            named: &block.time,
            local: local.clone(),
        };
        let names = BlockNames {
            system,
            solved,
            named: newton.shared.as_ref().unwrap_or(&block.time),
            local,
        };
        let writer_of = |names| Writer {
            system,
            constants: &program.constants,
            names,
        };
        let (first_writer, writer) = (writer_of(&first_names), writer_of(&names));
        let needed = newton.geometry_for(results, system);
        let evaluated: Vec<ExprId> = results
            .iter()
            .copied()
            .chain(needed.iter().flat_map(Action::values))
            .collect();
        let time = first_writer.statements(&block.time.for_results(&evaluated, system));
        let shared = newton.shared.as_ref();
        let shared = shared.map(|shared| writer.statements(&shared.for_results(results, system)));
        let shared = shared.unwrap_or_default();
        let actions: Vec<TokenStream> = needed
            .iter()
            .map(|action| statement(action, index, block, &first_writer, &first_names))
            .collect();
        let values: Vec<TokenStream> = results
            .iter()
            .map(|&expr| writer.expression(expr, &[]))
            .collect();
        let read_expressions = results
            .iter()
            .copied()
            .chain(needed.iter().flat_map(Action::values));
        let read: HashSet<SymbolId> = read_expressions
            .clone()
            .flat_map(|expr| system.mechanism.graph.symbols(expr).iter().copied())
            .collect();
        let pattern = |symbol: SymbolId| {
            let name = plain_name(symbol, system);
            if read.contains(&symbol) {
                quote!(#name)
            } else {
                quote!(_)
            }
        };
        let unpack = |from: &str, symbols: Vec<SymbolId>| {
            if !symbols.iter().any(|symbol| read.contains(symbol)) {
                return TokenStream::new();
            }
            let from = proc_macro2::Ident::new(from, proc_macro2::Span::call_site());
            let names = symbols.into_iter().map(pattern);
            quote!(let [#(#names),*] = #from.data.0[0];)
        };
        let unpack_q = unpack(
            "q",
            unknowns.iter().map(|unknown| unknown.position).collect(),
        );
        let unpack_qd = unpack("qd", unknowns.iter().map(|unknown| unknown.rate).collect());
        let reads_frame = read.iter().any(|&symbol| names.is_field(symbol));
        let at = if reads_frame {
            quote!(let at = self.at;)
        } else {
            TokenStream::new()
        };
        let reads_time = read
            .iter()
            .any(|symbol| system.roles[symbol.index()] == SymbolRole::Time);
        let given = reads(read_expressions, system);
        let parameters = only(given.parameters, quote!(let parameters = self.parameters;));
        let inputs = only(given.inputs, quote!(let inputs = self.inputs;));
        let t = if reads_time { quote!(t) } else { quote!(_t) };
        let q = if unpack_q.is_empty() {
            quote!(_q)
        } else {
            quote!(q)
        };
        let qd = if unpack_qd.is_empty() {
            quote!(_qd)
        } else {
            quote!(qd)
        };
        let body =
            quote!(#at #parameters #inputs #unpack_q #unpack_qd #(#time)* #(#actions)* #(#shared)*);
        (body, values, q, qd, t)
    };
    let (residual_body, residual, residual_q, _, residual_t) = part(&newton.residuals, false);
    let (jacobian_body, jacobian, jacobian_q, _, jacobian_t) = part(&newton.jacobian, false);
    let (drift_body, drift, drift_q, _, drift_t) = part(&newton.time_derivative, false);
    let (gamma_body, gamma, gamma_q, gamma_qd, gamma_t) = part(&newton.gamma, true);
    let of_columns: Vec<Quantity> = unknowns.iter().map(|it| it.quantity).collect();
    let judged = if reads_length(newton, system) {
        let rows = scales_by_length("row_scale", "row", &newton.quantities);
        let columns = scales_by_length("coordinate_scale", "column", &of_columns);
        quote!(#rows #columns)
    } else {
        constant_scales(&newton.quantities, &of_columns)
    };
    let given = Needs::given(newton, system);
    let parameters = only(given.parameters, quote!(parameters: &'a Parameters,));
    let inputs = only(given.inputs, quote!(inputs: &'a Inputs,));
    let title = docs([format!(
        "The equations of `{}` for {}.",
        block.name,
        listed(newton, system)
    )]);
    let at = only(
        reads_frame(block, newton, system, solved),
        quote!(at: &'a Frame,),
    );
    let length = only(reads_length(newton, system), quote!(length: f64,));
    let fields = quote!(#at #parameters #inputs #length);
    let borrows = !quote!(#at #parameters #inputs).is_empty();
    let (declaration, lifetime) = if fields.is_empty() {
        (quote!(struct #name;), TokenStream::new())
    } else if !borrows {
        (quote!(struct #name { #fields }), TokenStream::new())
    } else {
        (quote!(struct #name<'a> { #fields }), quote!(<'_>))
    };
    quote! {
        #title
        #declaration

        impl Equations<f64, Const<#size>> for #name #lifetime {
            fn dimension(&self) -> Const<#size> {
                Const
            }

            fn residual(&self, #residual_q: &SVector<f64, #size>, #residual_t: f64, residual: &mut SVector<f64, #size>) {
                #residual_body
                *residual = SVector::from([#(#residual),*]);
            }

            fn jacobian(&self, #jacobian_q: &SVector<f64, #size>, #jacobian_t: f64, jacobian: &mut SMatrix<f64, #size, #size>) {
                #jacobian_body
                *jacobian = SMatrix::from_row_slice(&[#(#jacobian),*]);
            }

            fn time_derivative(&self, #drift_q: &SVector<f64, #size>, #drift_t: f64, derivative: &mut SVector<f64, #size>) {
                #drift_body
                *derivative = SVector::from([#(#drift),*]);
            }

            fn gamma(
                &self,
                #gamma_q: &SVector<f64, #size>,
                #gamma_qd: &SVector<f64, #size>,
                #gamma_t: f64,
                right_hand_side: &mut SVector<f64, #size>,
            ) {
                #gamma_body
                *right_hand_side = SVector::from([#(#gamma),*]);
            }

            #judged
        }
    }
}

/// The scales of rows and columns with these quantities where no parameter changes them.
fn constant_scales(rows: &[Quantity], columns: &[Quantity]) -> TokenStream {
    let size = count(rows.len());
    let length = quote!(CHARACTERISTIC_LENGTH);
    let list = |quantities: &[Quantity]| {
        let scales = quantities.iter().map(|&it| scale(it, &length));
        quote!([#(#scales),*])
    };
    let (row_scales, column_scales) = (list(rows), list(columns));
    let of_rows = if rows.iter().all(|it| *it == Quantity::Length) {
        quote! {
            fn row_scale(&self, _row: usize) -> f64 {
                CHARACTERISTIC_LENGTH
            }
        }
    } else {
        quote! {
            fn row_scale(&self, row: usize) -> f64 {
                const SCALES: [f64; #size] = #row_scales;
                SCALES.get(row).copied().unwrap_or(1.0)
            }
        }
    };
    quote! {
        #of_rows

        fn coordinate_scale(&self, column: usize) -> f64 {
            const SCALES: [f64; #size] = #column_scales;
            SCALES.get(column).copied().unwrap_or(1.0)
        }
    }
}

/// The unknowns that it finds: `` `phi2`, `l1` ``.
pub(super) fn listed(newton: &NewtonBlock, system: &System) -> String {
    let names: Vec<String> = newton
        .unknowns
        .iter()
        .map(|&unknown| format!("`{}`", system.unknown_name(unknown)))
        .collect();
    names.join(", ")
}
