//! Point on a line of another body, or at an offset from it: a pin in a slot, and the massless slider.

use super::geometry::{offset_along, perpendicular, subtract};
use super::{Auxiliary, Feature, Kind, Line, Operands, Quantity, Resolved, Row, Slot, Value};
use crate::expr::{ExprId, Graph};

/// Returns the row of the point across the line, along the unit normal in global components.
fn lateral_row(operands: &Resolved, offset: ExprId, graph: &mut Graph) -> Vec<Row> {
    let Some((axis, i, j)) = operands.along() else {
        return Vec::new();
    };
    let [across, turned] = [axis.direction, axis.turned].map(|along| perpendicular(along, graph));
    let lateral = offset_along(across, turned, &i, &j, graph);
    vec![Row::length(graph.subtract(lateral, offset), "")]
}

/// Returns the rows r_j + R_j s_Q − r_i − R_i s_P − R_i (ℓ u + offset v).
pub(super) fn slot_rows(operands: &Resolved, offset: ExprId, graph: &mut Graph) -> Vec<Row> {
    let (Some((axis, i, j)), [displacement, ..]) = (operands.along(), &operands.auxiliaries[..])
    else {
        return Vec::new();
    };
    let [i, j] = [i, j].map(|mark| mark.position(graph));
    let gap = subtract(j, i, graph);
    let across = perpendicular(axis.turned, graph);
    let open = [0, 1].map(|part| {
        let along = graph.multiply(displacement.value, axis.turned[part]);
        let aside = graph.multiply(offset, across[part]);
        let reached = graph.add(along, aside);
        graph.subtract(gap[part], reached)
    });
    Row::gap(open)
}

/// Returns the offset to the left of the line, as written or else from the design configuration.
fn offset(operands: &Resolved, graph: &mut Graph) -> ExprId {
    match (operands.value, operands.across_in_drawing(graph)) {
        (Some(offset), _) | (None, Some(offset)) => offset,
        (None, None) => graph.zero(),
    }
}

/// (R_i v)ᵀ (r_j + R_j s_Q − r_i − R_i s_P) = 0, with v across the line through P, fixed in body i (Haug 1989, section 3.3).
pub static POINT_ON_LINE: Kind = Kind {
    keyword: "point_on_line",
    operands: Operands::POINT_ON_LINE,
    example: "`point_on_line (2.Q, 1) along P -> R;` with P and R on body 1",
    feature: |_, graph| Some(Feature::Slot(graph.zero())),
    auxiliaries: &[Auxiliary::Displacement],
    rows: point_on_line_rows,
    vector_rows: Some(point_on_line_vector_rows),
    ..Kind::UNSET
};

fn point_on_line_rows(operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
    let zero = graph.zero();
    lateral_row(operands, zero, graph)
}

fn point_on_line_vector_rows(operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
    let zero = graph.zero();
    slot_rows(operands, zero, graph)
}

/// (R_i v)ᵀ (r_j + R_j s_Q − r_i − R_i s_P) − offset = 0: a link without a body that slides on body i and rotates about Q (Haug
/// 1989, section 3.3).
pub static REVOLUTE_TRANSLATIONAL: Kind = Kind {
    keyword: "revolute_translational",
    operands: Operands {
        slots: &[Slot::Body, Slot::Point],
        line: Line::On(0),
    },
    value: Value::OrAsDrawn(Quantity::Length),
    example: "`revolute_translational (1, 2.Q) along P -> R = 20mm;` with P and R on body 1",
    feature: revolute_translational_feature,
    auxiliaries: &[Auxiliary::Displacement],
    rows: revolute_translational_rows,
    vector_rows: Some(revolute_translational_vector_rows),
    ..Kind::UNSET
};

fn revolute_translational_feature(operands: &Resolved, graph: &mut Graph) -> Option<Feature> {
    let offset = offset(operands, graph);
    Some(Feature::Slot(offset))
}

fn revolute_translational_rows(operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
    let offset = offset(operands, graph);
    lateral_row(operands, offset, graph)
}

fn revolute_translational_vector_rows(operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
    let offset = offset(operands, graph);
    slot_rows(operands, offset, graph)
}
