//! Flat-faced follower: a straight face of one body stays tangent to a curve of another.

use super::geometry::{dot, perpendicular, subtract};
use super::{Contact, Feature, Follower, Kind, Operands, Quantity, Resolved, Row};
use crate::expr::Graph;

/// (R_j v)ᵀ (r_i + R_i p(s) − r_j − R_j s_A) = 0 and (R_j v)ᵀ R_i p'(s) = 0, with v normal to the face, fixed in body j
/// (Nikravesh 1988, section 4.2.4).
///
/// The contact point lies on the face, and the tangent there is parallel to the face.
pub static FLAT: Kind = Kind {
    keyword: "flat",
    operands: Operands::FACE_AND_CURVE,
    example: "`flat (2, rim) along A -> B;` with A and B on body 2",
    feature: |_, _| Some(Feature::Contact(Follower::Face)),
    rows,
    contact,
    ..Kind::UNSET
};

fn rows(operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
    let (Some(face), Some(curve)) = (operands.axis, operands.curve) else {
        return Vec::new();
    };
    let begin = operands.marks[0];
    let [across, turned] = [face.direction, face.turned].map(|along| perpendicular(along, graph));
    let touched = curve.position(curve.point, graph);
    // The local vector s_A needs no rotation, since s_A and v are fixed in the same frame.
    let reach = subtract(touched, begin.frame.origin, graph);
    let height = dot(turned, reach, graph);
    let start = dot(across, begin.local, graph);
    let tangent = curve.tangent(graph);
    let tangent = curve.rotate(tangent, graph);
    let row = |residual, quantity, component| Row {
        residual,
        quantity,
        component,
    };
    // The tangent is a length per unit of the parameter.
    let slope = match 1 - curve.quantity.power_of_length() {
        1 => Quantity::Length,
        power => Quantity::Power(power),
    };
    vec![
        row(graph.subtract(height, start), Quantity::Length, "face"),
        row(dot(turned, tangent, graph), slope, "tangent"),
    ]
}

/// Returns the contact; a face touches from outside, so the curve must not be concave anywhere.
fn contact(operands: &Resolved, graph: &mut Graph) -> Option<Contact> {
    let (face, curve) = (operands.axis?, operands.curve?);
    Some(Contact {
        normal: perpendicular(face.turned, graph),
        follower: operands.marks[0].frame,
        place: curve.position(curve.point, graph),
        fit: Some((
            curve.curvature(graph),
            "a flat face does not reach into a hollow of the curve",
        )),
    })
}
