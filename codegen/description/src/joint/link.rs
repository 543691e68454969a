//! Shares the rows of kinds that keep a distance between two marks.
//!
//! The textbook formulation states the square of the distance. The vector form closes the loop with a link without a body. The
//! vector from the first mark to the second is ℓ (cos φ, sin φ), with the link angle φ as an unknown.

use super::geometry::{dot, subtract};
use super::{Quantity, Refusal, Resolved, Row};
use crate::expr::{ExprId, Graph};

/// Returns the row dᵀd − ℓ² in m², with d from the first mark to the second.
pub(super) fn squared_row(operands: &Resolved, length: ExprId, graph: &mut Graph) -> Vec<Row> {
    let [i, j] = [0, 1].map(|side| operands.marks[side].position(graph));
    let gap = subtract(j, i, graph);
    let squares = [dot(gap, gap, graph), graph.multiply(length, length)];
    vec![Row {
        residual: graph.subtract(squares[0], squares[1]),
        quantity: Quantity::Power(2),
        component: "",
    }]
}

/// Returns the rows r_j + R_j s_j − r_i − R_i s_i − ℓ (cos φ, sin φ), with φ as the first auxiliary unknown.
pub(super) fn link_rows(operands: &Resolved, length: ExprId, graph: &mut Graph) -> Vec<Row> {
    let [link, ..] = &operands.auxiliaries[..] else {
        return Vec::new();
    };
    let [i, j] = [0, 1].map(|side| operands.marks[side].position(graph));
    let gap = subtract(j, i, graph);
    let reach = link.turned.map(|part| graph.multiply(length, part));
    let open = subtract(gap, reach, graph);
    let row = |residual, component| Row {
        residual,
        quantity: Quantity::Length,
        component,
    };
    vec![row(open[0], "x"), row(open[1], "y")]
}

/// Rejects a length that is not positive: the squared distance is singular at zero, and has no sign.
pub(super) fn refuse_length(length: ExprId, instead: &str, graph: &Graph) -> Option<Refusal> {
    let length = graph.constant_value(length)?;
    // The equation uses the square, which must not underflow.
    if length > 0.0 && length * length >= f64::MIN_POSITIVE {
        return None;
    }
    let (problem, help) = if length > 0.0 {
        (
            format!("a distance of {length:e} m is too small for its square"),
            "check the unit and the exponent".to_string(),
        )
    } else if length < 0.0 {
        (
            "a distance cannot be negative".to_string(),
            "write it without the sign".to_string(),
        )
    } else {
        (
            "a distance of zero is singular: its equation has no slope there".to_string(),
            format!("two points that stay together are joined by {instead}"),
        )
    };
    Some(Refusal { problem, help })
}
/// Returns the distance of the marks in the design configuration.
pub(super) fn drawn_length(operands: &Resolved, graph: &mut Graph) -> ExprId {
    let gap = operands.drawn_gap(graph);
    super::geometry::length(gap, graph)
}
