//! The frame: one solved instant, and what it offers.

use proc_macro2::TokenStream;
use quote::{ToTokens, quote};

use super::code::Code;
use super::forces::forces;
use super::layout::Verbatim;
use super::lints;
use super::module::{derives, only};
use super::names::{identifier, identifier_text};
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
        Some(outputs) => {
            let mut code = Code::default();
            for output in outputs {
                method(output, module, &mut code);
            }
            code.to_token_stream()
        }
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
    text.open("::linkwright::generated::frame! {");
    text.docs([title]);
    text.tokens(derives(numbers));
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
fn method(output: &Output, module: &Module<'_>, code: &mut Code) {
    let own = |symbol: SymbolId| format!("self.{}", module.field_name(symbol));
    let pair = |fields: &[SymbolId; 2]| format!("[{}, {}]", own(fields[0]), own(fields[1]));
    let (prefix, kind, values) = match output {
        Output::Point { name, fields } => match fields.as_slice() {
            [position, velocity, acceleration] => {
                let [position, velocity, acceleration] =
                    [position, velocity, acceleration].map(pair);
                let motion = points::motion(&position, &velocity, &acceleration);
                (format!("point_{name}"), "PointMotion", vec![motion])
            }
            fields => {
                let values = fields.iter().map(pair).collect();
                (format!("point_{name}"), "[Scalar; 2]", values)
            }
        },
        Output::Coordinate { name, fields, .. } => {
            let values = fields.iter().map(|&field| own(field)).collect();
            (name.clone(), "Scalar", values)
        }
    };
    let functions = documentation::of_output(output).into_iter().zip(values);
    for ((suffix, text), value) in functions {
        let name = identifier_text(&format!("{prefix}{suffix}"));
        let head = format!("pub fn {name}(&self) -> {kind}");
        let mut statements = Code::default();
        statements.lines(&value);
        code.function([text], [], &head, statements);
    }
}
