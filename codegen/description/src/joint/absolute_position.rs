//! Absolute x and absolute y: a point of a body stays on a vertical or horizontal line.

use super::{Feature, Kind, Operands, Quantity, Resolved, Row, Value};
use crate::expr::Graph;

/// x_i + (R_i s_i)_x − C = 0 (Haug 1989, section 3.2).
pub struct AbsoluteX;

/// y_i + (R_i s_i)_y − C = 0 (Haug 1989, section 3.2).
pub struct AbsoluteY;

/// Returns the row that keeps component `axis` of the mark at the value.
pub(super) fn held(operands: &Resolved, axis: usize, graph: &mut Graph) -> Vec<Row> {
    let Some(value) = operands.value else {
        return Vec::new();
    };
    let position = operands.marks[0].position(graph);
    let residual = graph.subtract(position[axis], value);
    vec![Row {
        residual,
        quantity: Quantity::Length,
        component: "",
    }]
}

impl Kind for AbsoluteX {
    fn keyword(&self) -> &'static str {
        "absolute_x"
    }

    fn operands(&self) -> Operands {
        Operands::POINT
    }

    fn value(&self) -> Value {
        Value::Required(Quantity::Length)
    }

    fn example(&self) -> &'static str {
        "`absolute_x(1) = 0;` or `absolute_x(1.P) = sqrt(3);`"
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

impl Kind for AbsoluteY {
    fn keyword(&self) -> &'static str {
        "absolute_y"
    }

    fn operands(&self) -> Operands {
        Operands::POINT
    }

    fn value(&self) -> Value {
        Value::Required(Quantity::Length)
    }

    fn example(&self) -> &'static str {
        "`absolute_y(1) = 0;` or `absolute_y(1.P) = 20mm;`"
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
