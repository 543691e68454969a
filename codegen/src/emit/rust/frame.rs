//! The frame: one solved instant, and what it offers.

use proc_macro2::TokenStream;
use quote::quote;

use super::docs::docs;
use super::forces::forces;
use super::layout::Verbatim;
use super::lints;
use super::module::{derives, only};
use super::names::identifier;
use super::normalized_determinant::smallest_determinant;
use super::points;
use super::sensitivity::{sensitivities, structures};
use super::transmission::transmissions;
use crate::emit::module::drawing::{Estimate, estimates, frame_keeps_parameters};
use crate::emit::module::{Module, documentation};
use crate::expr::SymbolId;
use crate::program::Output;

/// `struct Frame`, with methods for everything that it offers.
pub(super) fn frame(module: &Module<'_>) -> TokenStream {
    let methods = match &module.program.outputs {
        Some(outputs) => outputs
            .iter()
            .map(|output| method(output, module))
            .collect(),
        None => points::methods(module),
    };
    let offered = [
        methods,
        transmissions(module),
        sensitivities(module),
        forces(module),
        smallest_determinant(module),
    ];
    let structure = structure(module);
    let implementation = quote!(impl Frame { #(#offered)* });
    let allow = lints::unused_item(&implementation);
    let implementation = only(
        !offered.iter().all(TokenStream::is_empty),
        quote!(#allow #implementation),
    );
    let (structures, table) = (structures(module), points::table(module));
    quote! {
        #structure
        #implementation
        #structures
        #table
    }
}

/// What a frame holds.
fn structure(module: &Module<'_>) -> TokenStream {
    let own = module.program.fields.iter();
    let names: Vec<String> = own
        .map(|&symbol| module.field_name(symbol).to_string())
        .collect();
    let (title, held, numbers) = match (module.holds_coordinates(), frame_keeps_parameters(module))
    {
        (true, true) => (
            "One solved instant.",
            "q, qd, qdd, parameters",
            module.system.coordinates.len(),
        ),
        (true, false) => (
            "One solved instant.",
            "q, qd, qdd",
            module.system.coordinates.len(),
        ),
        (false, _) => (
            "One solved instant: what the description asks for.",
            "",
            names.len(),
        ),
    };
    let mut text = Verbatim::default();
    text.open("::linkwright::frame! {");
    text.docs([title]);
    text.tokens(derives(numbers));
    if names.iter().any(|name| lints::has_capitals(name)) {
        text.line("#[allow(non_snake_case)]");
    }
    text.open(&format!("Frame({held}) from (pose, parameters) {{"));
    text.list(names);
    text.close("}");
    let drawn = drawn(module);
    if !drawn.is_empty() {
        text.open("drawn {");
        text.list(drawn);
        text.close("}");
    }
    text.close("}");
    text.item()
}

/// The fields in which the frame before the first one differs from one at rest in the origin.
fn drawn(module: &Module<'_>) -> Vec<String> {
    let fields = estimates(module).into_iter().map(|(symbol, estimate)| {
        let name = module.field_name(symbol);
        let value = match estimate {
            Estimate::Coordinate(name) => format!("pose.{}", identifier(name)),
            Estimate::Drawn(place) => format!("drawn(parameters)[{place}]"),
            Estimate::Number(value) => module.number(value),
        };
        format!("{name} = {value}")
    });
    fields.collect()
}

/// The functions of one output.
fn method(output: &Output, module: &Module<'_>) -> TokenStream {
    let own = |symbol: SymbolId| {
        let name = module.field_name(symbol);
        quote!(self.#name)
    };
    let pair = |fields: &[SymbolId; 2]| {
        let [x, y] = fields.map(own);
        quote!([#x, #y])
    };
    let prefix = match output {
        Output::Point { name, .. } => format!("point_{name}"),
        Output::Coordinate { name, .. } => name.clone(),
    };
    let functions = documentation::of_output(output).into_iter();
    let functions = functions.map(|(suffix, text)| {
        let function = identifier(&format!("{prefix}{suffix}"));
        (function, docs([text]))
    });
    match output {
        Output::Point { fields, .. } => match fields.as_slice() {
            [position, velocity, acceleration] => {
                let [position, velocity, acceleration] =
                    [position, velocity, acceleration].map(pair);
                let methods = functions.map(|(function, text)| quote! {
                    #text
                    pub fn #function(&self) -> PointMotion {
                        PointMotion { position: #position, velocity: #velocity, acceleration: #acceleration }
                    }
                });
                methods.collect()
            }
            fields => {
                let methods = fields
                    .iter()
                    .zip(functions)
                    .map(|(field, (function, text))| {
                        let value = pair(field);
                        quote!(#text pub fn #function(&self) -> [Scalar; 2] { #value })
                    });
                methods.collect()
            }
        },
        Output::Coordinate { fields, .. } => {
            let methods = fields
                .iter()
                .zip(functions)
                .map(|(&field, (function, text))| {
                    let value = own(field);
                    quote!(#text pub fn #function(&self) -> Scalar { #value })
                });
            methods.collect()
        }
    }
}
