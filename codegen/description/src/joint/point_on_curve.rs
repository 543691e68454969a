//! Point on curve: a point of one body stays on a curve of another.

use super::geometry::subtract;
use super::{Contact, Feature, Follower, Kind, Operands, Resolved, Row};
use crate::expr::Graph;

/// r_j + R_j s_j − r_i − R_i p(s) = 0, with s as a separate coordinate (Nikravesh 1988, section 4.2.4).
pub static POINT_ON_CURVE: Kind = Kind {
    keyword: "point_on_curve",
    operands: Operands::POINT_AND_CURVE,
    example: "`point_on_curve (2.P, rim);` with `curve rim(s) on 1 = (X, Y);`",
    feature: |_, _| Some(Feature::Contact(Follower::Point)),
    rows,
    contact,
    ..Kind::UNSET
};

fn rows(operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
    let Some(curve) = operands.curve else {
        return Vec::new();
    };
    let follower = operands.marks[0].position(graph);
    let touched = curve.position(curve.point, graph);
    let gap = subtract(follower, touched, graph);
    Row::gap(gap)
}

fn contact(operands: &Resolved, graph: &mut Graph) -> Option<Contact> {
    let curve = operands.curve?;
    let normal = curve.normal(graph);
    Some(Contact {
        normal: curve.rotate(normal, graph),
        follower: operands.marks[0].frame,
        place: operands.marks[0].position(graph),
        fit: None,
    })
}
