//! Relative x and relative y: a point of one body stays beside, or above, a point of another.

use super::{Feature, Kind, Operands, Quantity, Resolved, Row, Value};
use crate::expr::Graph;

/// Returns the row that keeps component `axis` of the vector from the first mark to the second.
fn apart(operands: &Resolved, axis: usize, graph: &mut Graph) -> Vec<Row> {
    let Some(value) = operands.value else {
        return Vec::new();
    };
    let [i, j] = [0, 1].map(|side| operands.marks[side].position(graph)[axis]);
    let gap = graph.subtract(j, i);
    vec![Row::length(graph.subtract(gap, value), "")]
}

/// (r_j + R_j s_j − r_i − R_i s_i)_x − C = 0 (Haug 1989, section 3.3); as a driver with f(t) for C.
pub static RELATIVE_X: Kind = Kind {
    keyword: "relative_x",
    operands: Operands::POINTS,
    value: Value::Required(Quantity::Length),
    example: "`relative_x (1.P, 2.Q) = 0.5;`, or driven `drive relative_x(1.P, 2.Q) = 0.5*sin(t);`",
    feature: |_, _| Some(Feature::Offset(0)),
    is_global: |_| true,
    rows: |operands, graph| apart(operands, 0, graph),
    ..Kind::UNSET
};

/// (r_j + R_j s_j − r_i − R_i s_i)_y − C = 0 (Haug 1989, section 3.3); as a driver with f(t) for C.
pub static RELATIVE_Y: Kind = Kind {
    keyword: "relative_y",
    example: "`relative_y (1.P, 2.Q) = 0.5;`, or driven `drive relative_y(1.P, 2.Q) = 0.5*sin(t);`",
    feature: |_, _| Some(Feature::Offset(1)),
    rows: |operands, graph| apart(operands, 1, graph),
    ..RELATIVE_X
};
