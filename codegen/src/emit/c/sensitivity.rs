//! Writes the structures in which sensitivities are returned.

use super::printer::Printer;
use crate::emit::code::Code;
use crate::program::SensitiveQuantity;

/// Writes the structures that some function returns.
pub(super) fn structures(printer: &Printer<'_>, text: &mut Code) {
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

/// True if the quantity is a point with position and velocity.
fn returns_pair(quantity: &SensitiveQuantity) -> bool {
    quantity.components.len() == 2 && quantity.levels.len() == 2
}
