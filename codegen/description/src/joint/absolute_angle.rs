//! Absolute angle: the angle of a body is constant.

use super::{Feature, Kind, Operands, Quantity, Resolved, Row, Value};
use crate::expr::Graph;

/// φ_i − C = 0 (Haug 1989, section 3.2).
pub struct AbsoluteAngle;

/// Returns the row φ_i − value, also used by the angle driver.
pub(super) fn angle_row(operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
    let Some(value) = operands.value else {
        return Vec::new();
    };
    let residual = graph.subtract(operands.marks[0].frame.angle, value);
    vec![Row {
        residual,
        quantity: Quantity::Angle,
        component: "",
    }]
}

impl Kind for AbsoluteAngle {
    fn keyword(&self) -> &'static str {
        "absolute_angle"
    }

    fn operands(&self) -> Operands {
        Operands::ANGLE
    }

    fn value(&self) -> Value {
        Value::Required(Quantity::Angle)
    }

    fn example(&self) -> &'static str {
        "`absolute_angle(1) = 30deg;`"
    }

    fn feature(&self, _operands: &Resolved, _graph: &mut Graph) -> Option<Feature> {
        Some(Feature::Orientation)
    }

    fn is_global(&self, _on_ground: bool) -> bool {
        true
    }

    fn rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
        angle_row(operands, graph)
    }
}
