//! Absolute angle driver: a body's angle is a function of time.

use super::absolute_angle::angle_row;
use super::{Feature, Kind, Operands, Quantity, Resolved, Row, Value};
use crate::expr::Graph;

/// φ_i − f(t) = 0 (Haug 1989, section 3.5).
pub struct AngleDriver;

impl Kind for AngleDriver {
    fn keyword(&self) -> &'static str {
        "phi"
    }

    fn operands(&self) -> Operands {
        Operands::ANGLE
    }

    fn value(&self) -> Value {
        Value::Required(Quantity::Angle)
    }

    fn example(&self) -> &'static str {
        "`drive phi(1) = pi/6 + sin(2*t);`"
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
