//! How the motion depends on parameters, as functions of the frame.

use super::module::derives;
use super::names::identifier;
use crate::emit::code::Code;
use crate::emit::module::{Module, documentation};
use crate::program::{Found, SensitiveQuantity, Sensitivity};

/// Writes `struct Sensitivity` and `struct PointSensitivity`, as far as something returns them.
pub(super) fn structures(module: &Module<'_>, code: &mut Code) {
    let sensitivities = &module.program.sensitivities;
    let mut coordinates = sensitivities
        .iter()
        .filter_map(|it| it.coordinates.as_ref());
    if let Some(coordinates) = coordinates.next() {
        code.gap();
        code.docs(["Derivatives of all coordinates and of their rates with respect to a parameter, at the time of the frame."]);
        code.line(derives(coordinates.len()));
        code.open("pub struct Sensitivity {");
        code.docs(["∂q/∂p: of the coordinates, in m or rad per unit of the parameter."]);
        code.line("pub position: Coordinates,");
        code.docs(["∂q̇/∂p: of their rates, in m/s or rad/s per unit of the parameter."]);
        code.line("pub velocity: Coordinates,");
        code.close("}");
    }
    let mut quantities = sensitivities.iter().flat_map(|it| &it.quantities);
    if quantities.any(returns_pair) {
        code.gap();
        code.docs(["Derivatives of the position and velocity of a point with respect to a parameter, at the time of the frame."]);
        code.line(derives(4));
        code.open("pub struct PointSensitivity {");
        code.docs(["Of x and y, in m per unit of the parameter."]);
        code.line("pub position: [Scalar; 2],");
        code.docs(["Of their rates, in m/s per unit of the parameter."]);
        code.line("pub velocity: [Scalar; 2],");
        code.close("}");
    }
}

/// Writes the functions of all sensitivities; nothing if there are none.
pub(super) fn sensitivities(module: &Module<'_>, code: &mut Code) {
    for sensitivity in &module.program.sensitivities {
        if let Some(coordinates) = &sensitivity.coordinates {
            of_coordinates(sensitivity, coordinates, module, code);
        }
        for quantity in &sensitivity.quantities {
            of_quantity(sensitivity, quantity, module, code);
        }
    }
}

/// Whether a quantity is a point with position and velocity.
fn returns_pair(quantity: &SensitiveQuantity) -> bool {
    quantity.components.len() == 2 && quantity.levels.len() == 2
}

fn value(found: &Found, module: &Module<'_>) -> String {
    match found {
        Found::Field(symbol) => module.field(*symbol, "self"),
        Found::Constant(value) => module.number(*value),
    }
}

fn of_coordinates(
    sensitivity: &Sensitivity,
    coordinates: &[[Found; 2]],
    module: &Module<'_>,
    code: &mut Code,
) {
    let level = |level: usize| {
        let fields = coordinates.iter().zip(&module.system.coordinates);
        let fields = fields.map(|(found, own)| {
            format!(
                "{}: {}",
                identifier(&own.name),
                value(&found[level], module)
            )
        });
        let fields: Vec<String> = fields.collect();
        format!("Coordinates {{ {} }}", fields.join(", "))
    };
    code.getter(
        documentation::of_sensitivity(sensitivity, module),
        &identifier(&format!("sensitivity_{}", sensitivity.name)),
        "Sensitivity",
        format!(
            "Sensitivity {{ position: {}, velocity: {} }}",
            level(0),
            level(1)
        ),
    );
}

fn of_quantity(
    sensitivity: &Sensitivity,
    quantity: &SensitiveQuantity,
    module: &Module<'_>,
    code: &mut Code,
) {
    let is_point = quantity.components.len() == 2;
    let levels = quantity.levels.iter().map(|level| {
        let values: Vec<String> = level.iter().map(|found| value(found, module)).collect();
        match is_point {
            true => format!("[{}]", values.join(", ")),
            false => values.concat(),
        }
    });
    let mut levels: Vec<String> = levels.collect();
    let mut kind = if is_point { "[Scalar; 2]" } else { "Scalar" };
    if returns_pair(quantity) {
        kind = "PointSensitivity";
        levels = vec![format!(
            "PointSensitivity {{ position: {}, velocity: {} }}",
            levels[0], levels[1]
        )];
    }
    let functions = documentation::of_quantity(sensitivity, quantity, module);
    for ((name, text), value) in functions.into_iter().zip(levels) {
        code.getter([text], &identifier(&name), kind, value);
    }
}
