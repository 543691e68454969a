//! Length driver: the distance between the two points of a translational joint, along it, is a function of time.

use super::geometry::offset_along;
use super::{Feature, Kind, Operands, Quantity, Resolved, Row, Value};
use crate::expr::Graph;

/// (R_i u)ᵀ (r_j + R_j s_j − r_i − R_i s_i) − f(t) = 0, with u along the line, fixed in body i (Haug 1989, section 3.5).
///
/// The length is signed: positive while Q lies in the direction of `along P -> Q` in the design configuration.
pub static LENGTH_DRIVER: Kind = Kind {
    keyword: "length",
    operands: Operands::LINE_OF_JOINT,
    value: Value::Required(Quantity::Length),
    example: "`drive length(P, Q) = 0.5 + 0.1*sin(t);` after `translational (1, 2) along P -> Q;`",
    feature: |_, _| Some(Feature::Slide),
    rows,
    vector_rows: Some(vector_rows),
    ..Kind::UNSET
};

fn rows(operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
    let (Some((axis, i, j)), Some(value)) = (operands.along(), operands.value) else {
        return Vec::new();
    };
    let length = offset_along(axis.direction, axis.turned, &i, &j, graph);
    let residual = graph.subtract(length, value);
    vec![Row::length(residual, "")]
}

/// Returns the row ℓ − f(t), with the displacement of the driven joint.
fn vector_rows(operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
    let (Some(displacement), Some(value)) = (operands.auxiliaries.first(), operands.value) else {
        return Vec::new();
    };
    vec![Row::length(graph.subtract(displacement.value, value), "")]
}
