//! Relative x and relative y: a point of one body stays beside, or above, a point of another.

use super::{Feature, Kind, Operands, Quantity, Resolved, Row, Value};
use crate::expr::Graph;

/// (r_j + R_j s_j − r_i − R_i s_i)_x − C = 0 (Haug 1989, section 3.3); as a driver with f(t) for C.
pub struct RelativeX;

/// (r_j + R_j s_j − r_i − R_i s_i)_y − C = 0 (Haug 1989, section 3.3); as a driver with f(t) for C.
pub struct RelativeY;

/// Returns the row that keeps component `axis` of the vector from the first mark to the second.
fn apart(operands: &Resolved, axis: usize, graph: &mut Graph) -> Vec<Row> {
    let Some(value) = operands.value else {
        return Vec::new();
    };
    let [i, j] = [0, 1].map(|side| operands.marks[side].position(graph)[axis]);
    let gap = graph.subtract(j, i);
    vec![Row {
        residual: graph.subtract(gap, value),
        quantity: Quantity::Length,
        component: "",
    }]
}

impl Kind for RelativeX {
    fn keyword(&self) -> &'static str {
        "relative_x"
    }

    fn operands(&self) -> Operands {
        Operands::POINTS
    }

    fn value(&self) -> Value {
        Value::Required(Quantity::Length)
    }

    fn example(&self) -> &'static str {
        "`relative_x (1.P, 2.Q) = 0.5;`, or driven `drive relative_x(1.P, 2.Q) = 0.5*sin(t);`"
    }

    fn feature(&self, _operands: &Resolved, _graph: &mut Graph) -> Option<Feature> {
        Some(Feature::Offset(0))
    }

    fn is_global(&self, _on_ground: bool) -> bool {
        true
    }

    fn rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
        apart(operands, 0, graph)
    }
}

impl Kind for RelativeY {
    fn keyword(&self) -> &'static str {
        "relative_y"
    }

    fn operands(&self) -> Operands {
        Operands::POINTS
    }

    fn value(&self) -> Value {
        Value::Required(Quantity::Length)
    }

    fn example(&self) -> &'static str {
        "`relative_y (1.P, 2.Q) = 0.5;`, or driven `drive relative_y(1.P, 2.Q) = 0.5*sin(t);`"
    }

    fn feature(&self, _operands: &Resolved, _graph: &mut Graph) -> Option<Feature> {
        Some(Feature::Offset(1))
    }

    fn is_global(&self, _on_ground: bool) -> bool {
        true
    }

    fn rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
        apart(operands, 1, graph)
    }
}
