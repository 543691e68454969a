//! Relative angle: one body keeps its angle to another.

use super::{Feature, Kind, Operands, Quantity, Resolved, Row, Value};
use crate::expr::{ExprId, Graph};

/// φ_j − φ_i − C = 0 (Haug 1989, section 3.3); as a driver with f(t) for C (section 3.5).
pub struct RelativeAngle;

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

impl Kind for RelativeAngle {
    fn keyword(&self) -> &'static str {
        "relative_angle"
    }

    fn operands(&self) -> Operands {
        Operands::ANGLES
    }

    fn value(&self) -> Value {
        Value::Required(Quantity::Angle)
    }

    fn example(&self) -> &'static str {
        "`relative_angle (1, 2) = 30deg;`, or driven `drive relative_angle(1, 2) = 2*t;`"
    }

    fn feature(&self, _operands: &Resolved, _graph: &mut Graph) -> Option<Feature> {
        Some(Feature::RelativeOrientation)
    }

    fn is_global(&self, on_ground: bool) -> bool {
        on_ground
    }

    fn rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
        let value = operands.value.iter();
        value
            .map(|&value| relative_angle_row(operands, value, "", graph))
            .collect()
    }
}
