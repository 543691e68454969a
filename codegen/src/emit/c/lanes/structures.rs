//! Writes structures whose fields are arrays with one element per lane.
//!
//! Their fields are those of the structures of one mechanism, in the same order, so that numbers are copied by their index.

use super::super::printer::Printer;
use super::super::words::identifier;
use crate::emit::code::Code;
use crate::emit::module::drawing::frame_keeps_parameters;
use crate::model::field_name;

/// Writes the number of lanes, and the structures of all lanes.
pub(super) fn structures(printer: &Printer<'_>, text: &mut Code) {
    let (module, declared) = (printer.module, printer.declared());
    let lanes = printer.lanes();
    text.comment([
        "Number of mechanisms that are solved at once, each in a lane with the bits of a mechanism alone.",
    ]);
    text.line(format!("#define {lanes} {}", module.scalar.lanes()));
    let array = |name: &str| format!("{} {name}[{lanes}];", printer.real());
    if module.holds_coordinates() {
        let coordinates = module.system.coordinates.iter();
        let fields = coordinates.map(|it| array(&identifier(&it.name)));
        structure(printer, "LaneCoordinates", "Coordinates", fields, text);
    }
    if declared.parameters {
        let parameters = module.system.mechanism.parameters.iter();
        let fields = parameters.map(|it| array(&identifier(&field_name(&it.name))));
        structure(printer, "LaneParameters", "Parameters", fields, text);
    }
    if declared.inputs {
        let levels = ["value", "rate", "acceleration"].into_iter().map(array);
        structure(printer, "LaneSignal", "Signal", levels, text);
        let inputs = module.system.mechanism.inputs.iter();
        let signal = printer.type_of("LaneSignal");
        let fields = inputs.map(|it| format!("{signal} {};", identifier(&field_name(&it.name))));
        structure(printer, "LaneInputs", "Inputs", fields, text);
    }
    if !module.program.branches.is_empty() {
        let branches = module.program.branches.iter();
        let fields = branches.map(|it| array(&identifier(&it.name)));
        let title = "Signs of the assembly modes";
        structure(printer, "LaneBranches", title, fields, text);
    }
    let mut fields = vec![array("t")];
    if module.holds_coordinates() {
        let coordinates = printer.type_of("LaneCoordinates");
        fields.extend(["q", "qd", "qdd"].map(|it| format!("{coordinates} {it};")));
        if frame_keeps_parameters(module) {
            fields.push(format!("{} parameters;", printer.type_of("LaneParameters")));
        }
    }
    let passed = module.program.fields.iter();
    fields.extend(passed.map(|&symbol| array(&printer.field_name(symbol))));
    structure(printer, "LaneFrames", "Frames", fields.into_iter(), text);
}

fn structure(
    printer: &Printer<'_>,
    kind: &str,
    title: &str,
    fields: impl Iterator<Item = String>,
    text: &mut Code,
) {
    let name = printer.type_of(kind);
    text.gap();
    text.comment([format!("{title} of all lanes.")]);
    text.open(format!("typedef struct {name} {{"));
    fields.for_each(|field| text.line(field));
    text.close(format!("}} {name};"));
}
