//! Writes the frame: the structure of one solved instant, and its methods.

use super::limits::limits;
use super::lints;
use super::module::derives;
use super::names::identifier;
use super::normalized_determinant::smallest_determinant;
use super::points;
use super::sensitivity::structures;
use super::transmission::transmissions;
use crate::emit::code::Code;
use crate::emit::module::drawing::{Estimate, estimates, frame_keeps_parameters};
use crate::emit::module::forces::force_functions;
use crate::emit::module::{Module, accessors};

/// Writes `struct Frame` with its methods.
pub(super) fn frame(module: &Module<'_>, code: &mut Code) {
    structure(module, code);
    let mut methods = Code::default();
    match &module.program.outputs {
        Some(outputs) => methods.accessors(outputs.iter().flat_map(accessors::of_output), module),
        None => points::methods(module, &mut methods),
    }
    transmissions(module, &mut methods);
    methods.accessors(accessors::sensitivities(module), module);
    methods.accessors(force_functions(module), module);
    methods.accessors(accessors::measures(module), module);
    limits(module, &mut methods);
    smallest_determinant(module, &mut methods);
    if !methods.is_empty() {
        let allow = lints::unused_item(&methods);
        let mut implementation = Code::default();
        implementation.block("impl Frame", methods);
        code.item([""; 0], allow, implementation);
    }
    structures(module, code);
    points::table(module, code);
}

/// Writes the fields of the frame, and their values before the first frame.
fn structure(module: &Module<'_>, code: &mut Code) {
    let fields = module.program.fields.iter();
    let names: Vec<String> = fields.map(|&symbol| module.field_name(symbol)).collect();
    let (title, held, numbers) = match (module.holds_coordinates(), frame_keeps_parameters(module))
    {
        (true, true) => (
            "Solved frame.",
            "q, qd, qdd, parameters",
            module.system.coordinates.len(),
        ),
        (true, false) => (
            "Solved frame.",
            "q, qd, qdd",
            module.system.coordinates.len(),
        ),
        (false, _) => ("Solved frame with the requested outputs.", "", names.len()),
    };
    code.gap();
    code.open("::linkwright::generated::frame! {");
    code.docs([title]);
    code.line(derives(numbers));
    code.open(format!("Frame({held}) from (pose, parameters) {{"));
    code.list(&names);
    code.close("}");
    let drawn = drawn(module);
    if !drawn.is_empty() {
        code.open("drawn {");
        code.list(&drawn);
        code.close("}");
    }
    code.close("}");
}

/// Returns the fields of the frame before the first one that are not zero, with their values.
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
