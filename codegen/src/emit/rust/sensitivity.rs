//! Writes the structures in which sensitivities are returned.

use super::module::derives;
use crate::emit::code::Code;
use crate::emit::module::Module;
use crate::program::SensitiveQuantity;

/// Writes `struct Sensitivity` and `struct PointSensitivity` if some method returns them.
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

/// True if the quantity is a point with position and velocity.
fn returns_pair(quantity: &SensitiveQuantity) -> bool {
    quantity.components.len() == 2 && quantity.levels.len() == 2
}
