//! Writes the limits of measures as a function of a frame.

use super::comment::quoted;
use super::points::Offered;
use super::printer::Printer;
use crate::emit::code::Code;
use crate::emit::module::limits;

/// Returns the names of the limits; empty if there are none.
pub(super) fn names(printer: &Printer<'_>) -> Vec<String> {
    let ends = limits::ends(printer.module).into_iter();
    ends.map(|it| quoted(&it.name)).collect()
}

/// Returns the function that writes their margins; `None` if there are none.
pub(super) fn offered(printer: &Printer<'_>) -> Option<Offered> {
    let ends = limits::ends(printer.module);
    if ends.is_empty() {
        return None;
    }
    let mut body = Code::default();
    for (place, end) in ends.iter().enumerate() {
        let field = printer.field(end.field, "frame");
        let margin = match (end.is_upper, end.value) {
            (true, value) => format!("{} - {field}", printer.number(value)),
            (false, 0.0) => field,
            (false, value) if value < 0.0 => format!("{field} + {}", printer.number(-value)),
            (false, value) => format!("{field} - {}", printer.number(value)),
        };
        body.line(format!("margins[{place}] = {margin};"));
    }
    let (real, frame) = (printer.real(), printer.type_of("Frame"));
    let function = printer.function("limits");
    Some(Offered {
        lines: vec![limits::MARGINS.to_string()],
        declaration: format!(
            "void {function}(const {frame} *frame, {real} margins[{}])",
            ends.len()
        ),
        body,
    })
}
