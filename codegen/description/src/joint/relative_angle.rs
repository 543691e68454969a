//! Relative angle: one body keeps its angle to another.

use super::{Feature, Kind, Operands, Quantity, Resolved, Row, Value};
use crate::expr::{ExprId, Graph};

/// Returns the row φ_j − φ_i − value, with the first two operands as i and j; also used by the weld.
pub(super) fn relative_angle_row(
    operands: &Resolved,
    value: ExprId,
    component: &'static str,
    graph: &mut Graph,
) -> Row {
    let [i, j] = [0, 1].map(|side| operands.marks[side].frame.angle);
    let difference = graph.subtract(j, i);
    Row {
        residual: graph.subtract(difference, value),
        quantity: Quantity::Angle,
        component,
    }
}

/// φ_j − φ_i − C = 0 (Haug 1989, section 3.3); as a driver with f(t) for C (section 3.5).
pub static RELATIVE_ANGLE: Kind = Kind {
    keyword: "relative_angle",
    operands: Operands::ANGLES,
    value: Value::Required(Quantity::Angle),
    example: "`relative_angle (1, 2) = 30deg;`, or driven `drive relative_angle(1, 2) = 2*t;`",
    feature: |_, _| Some(Feature::RelativeOrientation),
    is_global: |on_ground| on_ground,
    rows,
    ..Kind::UNSET
};

fn rows(operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
    let value = operands.value.iter();
    value
        .map(|&value| relative_angle_row(operands, value, "", graph))
        .collect()
}
