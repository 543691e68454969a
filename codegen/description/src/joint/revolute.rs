//! Revolute joint: a point of one body stays on a point of another.

use super::geometry::subtract;
use super::pin_on_arm::PinOnArm;
use super::{Feature, Kind, Operands, Quantity, Resolved, Row, Value};
use crate::expr::Graph;

/// r_i + R_i s_i − r_j − R_j s_j = 0 (Haug 1989, section 3.3).
pub struct Revolute;

impl Kind for Revolute {
    fn keyword(&self) -> &'static str {
        "revolute"
    }

    fn operands(&self) -> Operands {
        Operands::PINS
    }

    fn value(&self) -> Value {
        Value::None
    }

    fn example(&self) -> &'static str {
        "`revolute P(1, 2);` or `revolute (1.P, 2.Q);`"
    }

    fn feature(&self, _operands: &Resolved, _graph: &mut Graph) -> Option<Feature> {
        Some(Feature::Pin)
    }

    fn joins_points(&self) -> bool {
        true
    }

    fn without(&self, component: &str) -> Option<&'static str> {
        match component {
            "x" => Some("`relative_y(1.P, 2.P) = 0;`"),
            "y" => Some("`relative_x(1.P, 2.P) = 0;`"),
            _ => None,
        }
    }

    fn on_arm(&self) -> Option<&'static dyn Kind> {
        Some(&PinOnArm)
    }

    fn rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
        let positions = [
            operands.marks[0].position(graph),
            operands.marks[1].position(graph),
        ];
        let gap = subtract(positions[0], positions[1], graph);
        let row = |residual, component| Row {
            residual,
            quantity: Quantity::Length,
            component,
        };
        vec![row(gap[0], "x"), row(gap[1], "y")]
    }
}
