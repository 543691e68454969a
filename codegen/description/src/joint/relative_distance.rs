//! Relative distance: a point of one body keeps its distance from a point of another. Also defines the massless link and the
//! distance driver.

use super::link::{drawn_length, link_rows, refuse_length, squared_row};
use super::{Auxiliary, Feature, Kind, Operands, Quantity, Resolved, Row, Value};
use crate::expr::{ExprId, Graph};

/// Joint of two points at zero distance.
const PIN: &str = "`revolute (1.P, 2.Q);`";

/// Returns the length as written, or else from the design configuration.
fn length(operands: &Resolved, graph: &mut Graph) -> ExprId {
    match operands.value {
        Some(length) => length,
        None => drawn_length(operands, graph),
    }
}

/// dᵀd − L² = 0 with d = r_j + R_j s_j − r_i − R_i s_i (Haug 1989, section 3.3).
pub static RELATIVE_DISTANCE: Kind = Kind {
    keyword: "relative_distance",
    operands: Operands::POINTS,
    value: Value::Required(Quantity::Length),
    example: "`relative_distance (1.P, 2.Q) = 2;`",
    feature: |_, _| Some(Feature::Link),
    auxiliaries: &[Auxiliary::LinkAngle],
    refusal: |operands, graph| refuse_length(length(operands, graph), PIN, graph),
    positive: |operands, graph| Some((length(operands, graph), "the distance")),
    rows: |operands, graph| squared_row(operands, length(operands, graph), graph),
    vector_rows: Some(|operands, graph| link_rows(operands, length(operands, graph), graph)),
    ..Kind::UNSET
};

/// dᵀd − L² = 0: a link without a body and with a revolute joint at each end; L defaults to the design configuration (Haug
/// 1989, section 3.3).
pub static REVOLUTE_REVOLUTE: Kind = Kind {
    keyword: "revolute_revolute",
    value: Value::OrAsDrawn(Quantity::Length),
    example: "`revolute_revolute (1.P, 2.Q);` or `revolute_revolute (1.P, 2.Q) = 2;`",
    ..RELATIVE_DISTANCE
};

/// dᵀd − f(t)² = 0 (Haug 1989, section 3.5).
pub static DISTANCE_DRIVER: Kind = Kind {
    keyword: "distance",
    example: "`drive distance(1.P, 2.Q) = 2 + 0.1*sin(t);`",
    auxiliaries: &[Auxiliary::LinkAngle, Auxiliary::Distance],
    vector_rows: Some(driven_rows),
    ..RELATIVE_DISTANCE
};

/// Returns the rows of the link with its length ℓ as an unknown, and ℓ − f(t).
fn driven_rows(operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
    let (Some(value), [_, distance]) = (operands.value, &operands.auxiliaries[..]) else {
        return Vec::new();
    };
    let mut rows = link_rows(operands, distance.value, graph);
    rows.push(Row::length(graph.subtract(distance.value, value), "length"));
    rows
}
