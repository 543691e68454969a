//! Writes the limits of measures as a method of a frame.

use crate::emit::code::Code;
use crate::emit::module::{Module, limits};

/// Writes the names of the limits, and the method that returns their margins; nothing if there are none.
pub(super) fn limits(module: &Module<'_>, code: &mut Code) {
    let ends = limits::ends(module);
    if ends.is_empty() {
        return;
    }
    let count = ends.len();
    let names: Vec<String> = ends.iter().map(|it| format!("{:?}", it.name)).collect();
    code.gap();
    code.docs([limits::NAMES]);
    code.line(format!(
        "pub const LIMITS: [&'static str; {count}] = [{}];",
        names.join(", ")
    ));
    let margins = ends.iter().map(|end| {
        let (field, value) = (module.field(end.field, "self"), module.number(end.value));
        match (end.is_upper, end.value) {
            (true, _) => format!("{value} - {field}"),
            (false, 0.0) => field,
            (false, lower) if lower < 0.0 => format!("{field} + {}", module.number(-lower)),
            (false, _) => format!("{field} - {value}"),
        }
    });
    let margins: Vec<String> = margins.collect();
    code.getter(
        vec![limits::MARGINS.to_string()],
        "limits",
        &format!("[Scalar; {count}]"),
        format!("[{}]", margins.join(", ")),
    );
}
