//! Absolute angle: the angle of a body is constant, or a function of time.

use super::{Feature, Kind, Operands, Quantity, Resolved, Row, Value};
use crate::expr::Graph;

/// Returns the row φ_i − value.
fn angle_row(operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
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

/// φ_i − C = 0 (Haug 1989, section 3.2).
pub static ABSOLUTE_ANGLE: Kind = Kind {
    keyword: "absolute_angle",
    operands: Operands::ANGLE,
    value: Value::Required(Quantity::Angle),
    example: "`absolute_angle(1) = 30deg;`",
    feature: |_, _| Some(Feature::Orientation),
    is_global: |_| true,
    rows: angle_row,
    ..Kind::UNSET
};

/// φ_i − f(t) = 0 (Haug 1989, section 3.5).
pub static ANGLE_DRIVER: Kind = Kind {
    keyword: "phi",
    example: "`drive phi(1) = pi/6 + sin(2*t);`",
    ..ABSOLUTE_ANGLE
};
