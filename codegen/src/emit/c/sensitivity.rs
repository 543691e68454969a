//! How the motion depends on parameters, as functions of the frame.

use super::points::Offered;
use super::printer::Printer;
use super::text::Text;
use super::words::identifier;
use crate::emit::module::documentation;
use crate::program::{Found, SensitiveQuantity, Sensitivity};

/// The structures that sensitivities are returned in, as far as something returns them.
pub(super) fn structures(printer: &Printer<'_>, text: &mut Text) {
    let sensitivities = &printer.module.program.sensitivities;
    let real = printer.real();
    if sensitivities.iter().any(|it| it.coordinates.is_some()) {
        let (name, coordinates) = (
            printer.type_of("Sensitivity"),
            printer.type_of("Coordinates"),
        );
        text.gap();
        text.comment(["Derivatives of all coordinates and of their rates with respect to a parameter, at the time of the frame."]);
        text.open(format!("typedef struct {name} {{"));
        text.comment(["∂q/∂p: of the coordinates, in m or rad per unit of the parameter."]);
        text.line(format!("{coordinates} position;"));
        text.comment(["∂q̇/∂p: of their rates, in m/s or rad/s per unit of the parameter."]);
        text.line(format!("{coordinates} velocity;"));
        text.close(format!("}} {name};"));
    }
    if sensitivities
        .iter()
        .flat_map(|it| &it.quantities)
        .any(returns_pair)
    {
        let name = printer.type_of("PointSensitivity");
        text.gap();
        text.comment(["Derivatives of the position and velocity of a point with respect to a parameter, at the time of the frame."]);
        text.open(format!("typedef struct {name} {{"));
        text.comment(["Of x and y, in m per unit of the parameter."]);
        text.line(format!("{real} position[2];"));
        text.comment(["Of their rates, in m/s per unit of the parameter."]);
        text.line(format!("{real} velocity[2];"));
        text.close(format!("}} {name};"));
    }
}

/// Whether a quantity is a point with position and velocity.
fn returns_pair(quantity: &SensitiveQuantity) -> bool {
    quantity.components.len() == 2 && quantity.levels.len() == 2
}

/// The functions of all sensitivities.
pub(super) fn offered(printer: &Printer<'_>) -> Vec<Offered> {
    let mut offered = Vec::new();
    for sensitivity in &printer.module.program.sensitivities {
        if let Some(coordinates) = &sensitivity.coordinates {
            offered.push(of_coordinates(sensitivity, coordinates, printer));
        }
        for quantity in &sensitivity.quantities {
            offered.extend(of_quantity(sensitivity, quantity, printer));
        }
    }
    offered
}

fn value(found: &Found, printer: &Printer<'_>) -> String {
    match found {
        Found::Field(symbol) => printer.field(*symbol, "frame"),
        Found::Constant(value) => printer.number(*value),
    }
}

/// What reads nothing of the frame says so.
fn reading(mut body: Text, result: &str) -> Text {
    if !body.mentions("frame") {
        let mut unread = Text::default();
        unread.line("(void)frame;");
        unread.append(body);
        body = unread;
    }
    if !result.is_empty() {
        body.line(result);
    }
    body
}

fn of_coordinates(
    sensitivity: &Sensitivity,
    coordinates: &[[Found; 2]],
    printer: &Printer<'_>,
) -> Offered {
    let structure = printer.type_of("Sensitivity");
    let mut body = Text::default();
    for (found, own) in coordinates.iter().zip(&printer.module.system.coordinates) {
        for (level, found) in ["position", "velocity"].iter().zip(found) {
            let name = identifier(&own.name);
            body.line(format!("found.{level}.{name} = {};", value(found, printer)));
        }
    }
    let mut declared = Text::default();
    declared.line(format!("{structure} found;"));
    declared.append(body);
    Offered {
        lines: documentation::of_sensitivity(sensitivity, printer.module),
        declaration: printer.of_frame(&structure, &format!("sensitivity_{}", sensitivity.name)),
        body: reading(declared, "return found;"),
    }
}

fn of_quantity(
    sensitivity: &Sensitivity,
    quantity: &SensitiveQuantity,
    printer: &Printer<'_>,
) -> Vec<Offered> {
    let (real, frame) = (printer.real(), printer.type_of("Frame"));
    let is_point = quantity.components.len() == 2;
    let functions = documentation::of_quantity(sensitivity, quantity, printer.module).into_iter();
    let functions = functions.enumerate().map(|(place, (name, line))| {
        let function = printer.function(&identifier(&name));
        let mut body = Text::default();
        let (declaration, result) = match is_point {
            true if returns_pair(quantity) => {
                let structure = printer.type_of("PointSensitivity");
                body.line(format!("{structure} found;"));
                for (level, values) in ["position", "velocity"].iter().zip(&quantity.levels) {
                    for (axis, found) in values.iter().enumerate() {
                        body.line(format!(
                            "found.{level}[{axis}] = {};",
                            value(found, printer)
                        ));
                    }
                }
                let declaration = format!("{structure} {function}(const {frame} *frame)");
                (declaration, "return found;".to_string())
            }
            true => {
                for (axis, found) in quantity.levels[place].iter().enumerate() {
                    body.line(format!("found[{axis}] = {};", value(found, printer)));
                }
                let declaration = format!("void {function}(const {frame} *frame, {real} found[2])");
                (declaration, String::new())
            }
            false => {
                let found = value(&quantity.levels[place][0], printer);
                if !found.contains("frame") {
                    body.line("(void)frame;");
                }
                body.line(format!("return {found};"));
                (
                    format!("{real} {function}(const {frame} *frame)"),
                    String::new(),
                )
            }
        };
        Offered {
            lines: vec![line],
            declaration,
            body: reading(body, &result),
        }
    });
    functions.collect()
}
