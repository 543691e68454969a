//! Writes the frame: one solved instant.

use super::printer::Printer;
use super::words::identifier;
use crate::emit::code::Code;
use crate::emit::module::drawing::{Estimate, estimates, frame_keeps_parameters};

/// Writes the structure of a frame.
pub(super) fn structure(printer: &Printer<'_>, text: &mut Code) {
    let (module, real, name) = (printer.module, printer.real(), printer.type_of("Frame"));
    let holds_coordinates = module.holds_coordinates();
    text.gap();
    text.comment([match holds_coordinates {
        true => "Solved frame.",
        false => "Solved frame with the requested outputs.",
    }]);
    text.open(format!("typedef struct {name} {{"));
    text.comment(["Time t, in s."]);
    text.line(format!("{real} t;"));
    if holds_coordinates {
        let coordinates = printer.type_of("Coordinates");
        for (what, field) in [
            ("Pose.", "q"),
            ("Rates of the coordinates.", "qd"),
            ("Accelerations of the coordinates.", "qdd"),
        ] {
            text.comment([what]);
            text.line(format!("{coordinates} {field};"));
        }
        if frame_keeps_parameters(module) {
            text.comment(["Parameters of the points of this frame."]);
            text.line(format!("{} parameters;", printer.type_of("Parameters")));
        }
    }
    if !module.program.fields.is_empty() {
        text.comment(["Values that blocks pass to one another; their names may change."]);
    }
    for &symbol in &module.program.fields {
        text.line(format!("{real} {};", printer.field_name(symbol)));
    }
    text.close(format!("}} {name};"));
}

/// Writes `set_estimate`, which sets the frame before the first one to a pose at rest.
pub(super) fn estimate(printer: &Printer<'_>, text: &mut Code) {
    let module = printer.module;
    let (real, frame, coordinates) = (
        printer.real(),
        printer.type_of("Frame"),
        printer.type_of("Coordinates"),
    );
    let mut body = Code::default();
    body.line("(void)memset(at, 0, sizeof(*at));");
    body.line("at->t = t;");
    if module.holds_coordinates() {
        body.line("at->q = *pose;");
        if frame_keeps_parameters(module) {
            body.line("at->parameters = *parameters;");
        }
    }
    let estimates = estimates(module);
    let follows = estimates
        .iter()
        .any(|(_, it)| matches!(it, Estimate::Drawn(_)));
    if let (true, Some(function)) = (follows, &module.program.drawn) {
        body.line(format!("{real} found[{}];", function.results.len()));
        body.line(format!("{}(parameters, found);", printer.own("drawn")));
    }
    for (symbol, estimate) in &estimates {
        let name = printer.field_name(*symbol);
        let value = match estimate {
            Estimate::Coordinate(name) => format!("pose->{}", identifier(name)),
            Estimate::Drawn(place) => format!("found[{place}]"),
            Estimate::Number(value) => printer.number(*value),
        };
        body.line(format!("at->{name} = {value};"));
    }
    let declares = printer.declared().parameters;
    let parameters = match declares {
        true => format!("const {} *parameters, ", printer.type_of("Parameters")),
        false => String::new(),
    };
    text.gap();
    text.comment(["Sets the frame before the first one: a pose at rest."]);
    text.line(format!(
        "LINKWRIGHT_FUNCTION static void {}({frame} *at, const {coordinates} *pose, {parameters}{real} t)",
        printer.own("set_estimate")
    ));
    text.open("{");
    for (name, is_declared) in [("pose", true), ("parameters", declares)] {
        if is_declared && !body.mentions(name) {
            text.line(format!("(void){name};"));
        }
    }
    text.append(body);
    text.close("}");
}
