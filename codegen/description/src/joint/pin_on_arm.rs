//! Revolute joint of a body that rotates about another of its points, stated along and across the line from that point to the
//! pin.
//!
//! Across this line, the derivative of the gap by the body's angle is the length in every pose. This row alone therefore
//! determines the angle.

use super::geometry::{dot, offset_along, perpendicular, subtract};
use super::point_on_line::slot_rows;
use super::{Auxiliary, Feature, Kind, Operands, Resolved, Row};
use crate::expr::Graph;

/// (R_i v)ᵀ (r_j + R_j s_j − r_i − R_i s_C) = 0, with v normal to the unit vector u from C to the pin, both fixed in body i.
/// The second row has u for v, minus the distance from C to the pin. The third mark is C.
pub static PIN_ON_ARM: Kind = Kind {
    keyword: "revolute",
    operands: Operands::PINS,
    example: "`redundant revolute P(1, 2);`",
    feature: |_, _| Some(Feature::Pin),
    joins_points: true,
    auxiliaries: &[Auxiliary::Displacement],
    keeps_vector_rows: |dropped| *dropped == [false, true],
    vector_rows: Some(vector_rows),
    rows,
    ..Kind::UNSET
};

fn vector_rows(operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
    let zero = graph.zero();
    slot_rows(operands, zero, graph)
}

fn rows(operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
    let Some((axis, pivot, pin)) = operands.along() else {
        return Vec::new();
    };
    let pin_on_body = operands.marks[1 - axis.other];
    let [across, turned] = [axis.direction, axis.turned].map(|along| perpendicular(along, graph));
    let lateral = offset_along(across, turned, &pivot, &pin, graph);
    let reached = offset_along(axis.direction, axis.turned, &pivot, &pin, graph);
    let arm = subtract(pin_on_body.local, pivot.local, graph);
    let length = dot(axis.direction, arm, graph);
    let length = graph.tidied(length);
    let beyond = graph.subtract(reached, length);
    // As in a revolute joint, the gap is the first point minus the second.
    let gap = match axis.other {
        0 => [lateral, beyond],
        _ => [lateral, beyond].map(|component| graph.negate(component)),
    };
    vec![Row::length(gap[0], "across"), Row::length(gap[1], "along")]
}
