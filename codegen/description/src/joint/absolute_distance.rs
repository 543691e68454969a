//! Absolute distance: a point of a body stays on a circle about a point of the ground.

use super::link::{link_rows, refuse_length, squared_row};
use super::{Auxiliary, Feature, Kind, Operands, Quantity, Resolved, Row, Slot, Value};
use crate::expr::Graph;

/// (r_i + R_i s_i − A)ᵀ (r_i + R_i s_i − A) − L² = 0 (Haug 1989, section 3.2).
pub static ABSOLUTE_DISTANCE: Kind = Kind {
    keyword: "absolute_distance",
    operands: Operands::of(&[Slot::Point, Slot::GroundPoint]),
    value: Value::Required(Quantity::Length),
    example: "`absolute_distance (1.P, A) = 2;` with A a point on the ground",
    feature: |_, _| Some(Feature::Link),
    auxiliaries: &[Auxiliary::LinkAngle],
    refusal: |operands, graph| refuse_length(operands.value?, "`revolute (1.P, ground.A);`", graph),
    positive: |operands, _| Some((operands.value?, "the distance")),
    rows,
    vector_rows: Some(vector_rows),
    ..Kind::UNSET
};

fn rows(operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
    operands
        .value
        .map_or(Vec::new(), |length| squared_row(operands, length, graph))
}

fn vector_rows(operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
    operands
        .value
        .map_or(Vec::new(), |length| link_rows(operands, length, graph))
}
