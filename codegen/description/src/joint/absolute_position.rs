//! Absolute x and absolute y: a point of a body stays on a vertical or horizontal line, or follows a function of time.

use super::{Feature, Kind, Operands, Quantity, Resolved, Row, Value};
use crate::expr::Graph;

/// Returns the row that keeps component `axis` of the mark at the value.
fn held(operands: &Resolved, axis: usize, graph: &mut Graph) -> Vec<Row> {
    let Some(value) = operands.value else {
        return Vec::new();
    };
    let position = operands.marks[0].position(graph);
    let residual = graph.subtract(position[axis], value);
    vec![Row::length(residual, "")]
}

/// x_i + (R_i s_i)_x − C = 0 (Haug 1989, section 3.2).
pub static ABSOLUTE_X: Kind = Kind {
    keyword: "absolute_x",
    operands: Operands::POINT,
    value: Value::Required(Quantity::Length),
    example: "`absolute_x(1) = 0;` or `absolute_x(1.P) = sqrt(3);`",
    feature: |_, _| Some(Feature::Coordinate(0)),
    is_global: |_| true,
    rows: |operands, graph| held(operands, 0, graph),
    ..Kind::UNSET
};

/// y_i + (R_i s_i)_y − C = 0 (Haug 1989, section 3.2).
pub static ABSOLUTE_Y: Kind = Kind {
    keyword: "absolute_y",
    example: "`absolute_y(1) = 0;` or `absolute_y(1.P) = 20mm;`",
    feature: |_, _| Some(Feature::Coordinate(1)),
    rows: |operands, graph| held(operands, 1, graph),
    ..ABSOLUTE_X
};

/// (r_i + R_i s_i)_x − f(t) = 0 (Haug 1989, section 3.5).
pub static X_DRIVER: Kind = Kind {
    keyword: "x",
    example: "`drive x(1.P) = 0.1*sin(t);` or `drive P.x = 0.1*sin(t);`",
    ..ABSOLUTE_X
};

/// (r_i + R_i s_i)_y − f(t) = 0 (Haug 1989, section 3.5).
pub static Y_DRIVER: Kind = Kind {
    keyword: "y",
    example: "`drive y(1.P) = 0.1*sin(t);` or `drive P.y = 0.1*sin(t);`",
    ..ABSOLUTE_Y
};
