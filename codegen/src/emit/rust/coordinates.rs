//! Writes the named coordinates.

use super::module::derives;
use super::names::identifier;
use crate::emit::code::Code;
use crate::emit::module::{Module, documentation};

/// Writes `struct Coordinates` with its names and the design pose.
pub(super) fn coordinates(module: &Module<'_>, code: &mut Code) {
    let system = module.system;
    code.gap();
    code.open("::linkwright::generated::coordinates! {");
    code.docs(documentation::COORDINATES);
    code.line(derives(system.coordinates.len()));
    code.open("Coordinates: Scalar {");
    for coordinate in &system.coordinates {
        code.docs(documentation::of_coordinate(coordinate, system));
        // The estimates were found to be finite constants when they were read.
        let drawn = module.pool.graph.constant_value(coordinate.estimate);
        let (name, value) = (
            identifier(&coordinate.name),
            module.number(drawn.unwrap_or(0.0)),
        );
        code.line(format!("{name} = {value},"));
    }
    code.close("}");
    code.close("}");
}
