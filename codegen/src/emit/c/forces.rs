//! What drivers exert, what joints carry and what is stored, as functions of the frame.

use super::points::Offered;
use super::printer::Printer;
use crate::emit::code::Code;
use crate::emit::module::forces::force_functions;

/// The functions of all forces; nothing where none is asked for.
pub(super) fn offered(printer: &Printer<'_>) -> Vec<Offered> {
    let (real, frame) = (printer.real(), printer.type_of("Frame"));
    let functions = force_functions(printer.module).into_iter();
    let functions = functions.map(|function| {
        let name = printer.function(&function.name);
        let mut body = Code::default();
        let fields: Vec<String> = function
            .fields
            .iter()
            .map(|&field| printer.field(field, "frame"))
            .collect();
        let declaration = match &fields[..] {
            [only] => {
                body.line(format!("return {only};"));
                format!("{real} {name}(const {frame} *frame)")
            }
            _ => {
                for (place, field) in fields.iter().enumerate() {
                    body.line(format!("found[{place}] = {field};"));
                }
                format!("void {name}(const {frame} *frame, {real} found[2])")
            }
        };
        Offered {
            lines: function.lines,
            declaration,
            body,
        }
    });
    functions.collect()
}
