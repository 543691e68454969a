//! Position drivers: the x or the y of a point is a function of time.

use super::absolute_position::held;
use super::{Feature, Kind, Operands, Quantity, Resolved, Row, Value};
use crate::expr::Graph;

/// (r_i + R_i s_i)_x − f(t) = 0 (Haug 1989, section 3.5).
pub struct XDriver;

/// (r_i + R_i s_i)_y − f(t) = 0 (Haug 1989, section 3.5).
pub struct YDriver;

impl Kind for XDriver {
    fn keyword(&self) -> &'static str {
        "x"
    }

    fn operands(&self) -> Operands {
        Operands::POINT
    }

    fn value(&self) -> Value {
        Value::Required(Quantity::Length)
    }

    fn example(&self) -> &'static str {
        "`drive x(1.P) = 0.1*sin(t);` or `drive P.x = 0.1*sin(t);`"
    }

    fn feature(&self, _operands: &Resolved, _graph: &mut Graph) -> Option<Feature> {
        Some(Feature::Coordinate(0))
    }

    fn is_global(&self, _on_ground: bool) -> bool {
        true
    }

    fn rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
        held(operands, 0, graph)
    }
}

impl Kind for YDriver {
    fn keyword(&self) -> &'static str {
        "y"
    }

    fn operands(&self) -> Operands {
        Operands::POINT
    }

    fn value(&self) -> Value {
        Value::Required(Quantity::Length)
    }

    fn example(&self) -> &'static str {
        "`drive y(1.P) = 0.1*sin(t);` or `drive P.y = 0.1*sin(t);`"
    }

    fn feature(&self, _operands: &Resolved, _graph: &mut Graph) -> Option<Feature> {
        Some(Feature::Coordinate(1))
    }

    fn is_global(&self, _on_ground: bool) -> bool {
        true
    }

    fn rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
        held(operands, 1, graph)
    }
}
