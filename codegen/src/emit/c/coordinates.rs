//! Writes the named coordinates.

use super::constants::Constant;
use super::printer::Printer;
use super::words::identifier;
use crate::emit::code::Code;
use crate::emit::module::documentation;

/// Writes the structure with the coordinates.
pub(super) fn structure(printer: &Printer<'_>, text: &mut Code) {
    let (system, name) = (printer.module.system, printer.type_of("Coordinates"));
    text.gap();
    text.line(format!(
        "#define {} {}",
        printer.constant("COORDINATES"),
        system.coordinates.len()
    ));
    text.gap();
    text.comment([documentation::COORDINATES.join(" ")]);
    text.open(format!("typedef struct {name} {{"));
    for coordinate in &system.coordinates {
        text.comment(documentation::of_coordinate(coordinate, system));
        text.line(format!(
            "{} {};",
            printer.real(),
            identifier(&coordinate.name)
        ));
    }
    text.close(format!("}} {name};"));
}

/// Defines the design pose.
pub(super) fn drawn(printer: &Printer<'_>, text: &mut Code) {
    let system = printer.module.system;
    let values = system.coordinates.iter().map(|coordinate| {
        // The estimates were found to be finite constants when they were read.
        let drawn = printer
            .module
            .pool
            .graph
            .constant_value(coordinate.estimate);
        printer.number(drawn.unwrap_or(0.0))
    });
    let values: Vec<String> = values.collect();
    Constant::new(printer.type_of("Coordinates"), printer.constant("DESIGN")).define(&values, text);
}
