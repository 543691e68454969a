//! What drivers exert, what joints carry and what is stored, as functions of the frame.

use super::names::identifier;
use crate::emit::code::Code;
use crate::emit::module::Module;
use crate::emit::module::forces::force_functions;

/// Writes the functions of all forces; nothing if none is asked for.
pub(super) fn forces(module: &Module<'_>, code: &mut Code) {
    for function in force_functions(module) {
        let fields = function.fields.iter();
        let fields: Vec<String> = fields.map(|&it| module.field(it, "self")).collect();
        let (kind, value) = match &fields[..] {
            [only] => ("Scalar", only.clone()),
            _ => ("[Scalar; 2]", format!("[{}]", fields.join(", "))),
        };
        code.getter(function.lines, &identifier(&function.name), kind, value);
    }
}
