//! Translational joint: two bodies slide along a common line and keep their relative angle.

use super::geometry::{offset_along, perpendicular, subtract};
use super::{Auxiliary, Feature, Kind, Operands, Quantity, Resolved, Row};
use crate::expr::{ExprId, Graph};

/// φ_i − φ_j − φ⁰ = 0 and (R_i v)ᵀ (r_j + R_j s_j − r_i − R_i s_i) = 0, with v across the line, fixed in body i
/// (Nikravesh 1988, section 4.2.2, with the angle instead of a second cross product).
pub static TRANSLATIONAL: Kind = Kind {
    keyword: "translational",
    operands: Operands::BODIES_ALONG,
    example: "`translational (1, 2) along P -> Q;` with P on body 1 and Q on body 2",
    feature: |_, _| Some(Feature::Slide),
    remainders: &[
        (
            "angle",
            "`point_on_line (2.Q, 1) along P -> R;` with P and R on body 1",
        ),
        ("lateral", "`relative_angle(1, 2);`"),
    ],
    auxiliaries: &[Auxiliary::Displacement],
    rows,
    vector_rows: Some(vector_rows),
    ..Kind::UNSET
};

fn rows(operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
    let Some((axis, i, j)) = operands.along() else {
        return Vec::new();
    };
    let [across, turned] = [axis.direction, axis.turned].map(|along| perpendicular(along, graph));
    let lateral = offset_along(across, turned, &i, &j, graph);
    vec![
        relative_angle(operands, axis.relative_angle, graph),
        Row::length(lateral, "lateral"),
    ]
}

/// Returns the rows φ_i − φ_j − φ⁰ and r_j + R_j s_j − r_i − R_i s_i − ℓ R_i u.
fn vector_rows(operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
    let (Some(axis), [displacement]) = (operands.axis, &operands.auxiliaries[..]) else {
        return Vec::new();
    };
    let [i, j] = [0, 1].map(|side| operands.marks[side].position(graph));
    let gap = subtract(j, i, graph);
    let slide = axis
        .turned
        .map(|component| graph.multiply(displacement.value, component));
    let open = subtract(gap, slide, graph);
    let mut rows = vec![relative_angle(operands, axis.relative_angle, graph)];
    rows.extend(Row::gap(open));
    rows
}

/// Returns the row φ_i − φ_j − φ⁰.
fn relative_angle(operands: &Resolved, drawn: ExprId, graph: &mut Graph) -> Row {
    let [i, j] = [0, 1].map(|side| operands.marks[side].frame.angle);
    let difference = graph.subtract(i, j);
    Row {
        residual: graph.subtract(difference, drawn),
        quantity: Quantity::Angle,
        component: "angle",
    }
}
