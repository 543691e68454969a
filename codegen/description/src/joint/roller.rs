//! Roller follower: a disc whose center is a point of one body rolls along a curve of another.

use super::geometry::{Vector, add, subtract};
use super::{
    Contact, Curve, Feature, Follower, Kind, Operands, Quantity, Refusal, Resolved, Row, Value,
};
use crate::expr::{ExprId, Graph};

/// Returns the pitch curve p + ρ n, in the frame of the curve.
fn pitch(curve: &Curve, radius: ExprId, graph: &mut Graph) -> Vector {
    let normal = curve.normal(graph);
    let reach = normal.map(|component| graph.multiply(radius, component));
    add(curve.point, reach, graph)
}

/// r_j + R_j s_j − r_i − R_i (p(s) + ρ n(s)) = 0 with the radius ρ (Norton 2009, Cam Design and Manufacturing Handbook: the
/// pitch curve of a cam).
///
/// The unit normal n points to the side of the roller in the design configuration. The rotation of the roller about its center
/// is not computed, so the roller needs no body.
pub static ROLLER: Kind = Kind {
    keyword: "roller",
    operands: Operands::POINT_AND_CURVE,
    value: Value::Required(Quantity::Length),
    example: "`roller (2.P, rim) = 10mm;` with `curve rim(a) on 1 = polar RADIUS;`",
    feature,
    refusal,
    positive: |operands, _| Some((operands.value?, "the radius of the roller")),
    rows,
    contact,
    ..Kind::UNSET
};

fn feature(operands: &Resolved, _graph: &mut Graph) -> Option<Feature> {
    let radius = operands.value?;
    Some(Feature::Contact(Follower::Roller(radius)))
}

fn refusal(operands: &Resolved, graph: &mut Graph) -> Option<Refusal> {
    let radius = graph.constant_value(operands.value?)?;
    (radius <= 0.0).then(|| Refusal {
        problem: "the radius of a roller must be positive".to_string(),
        help: "write `point_on_curve` for a point; the side of the roller follows from the design configuration"
            .to_string(),
    })
}

fn rows(operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
    let (Some(curve), Some(radius)) = (operands.curve, operands.value) else {
        return Vec::new();
    };
    let center = operands.marks[0].position(graph);
    let pitch = pitch(&curve, radius, graph);
    let held = curve.position(pitch, graph);
    let gap = subtract(center, held, graph);
    Row::gap(gap)
}

/// Returns the contact. The pitch curve has a cusp where 1 + ρ κ = 0: the roller is larger than the concave radius there.
fn contact(operands: &Resolved, graph: &mut Graph) -> Option<Contact> {
    let (curve, radius) = (operands.curve?, operands.value?);
    let normal = curve.normal(graph);
    let curvature = curve.curvature(graph);
    let turn = graph.multiply(radius, curvature);
    let one = graph.one();
    Some(Contact {
        normal: curve.rotate(normal, graph),
        follower: operands.marks[0].frame,
        place: operands.marks[0].position(graph),
        fit: Some((
            graph.add(one, turn),
            "the roller does not fit into the curve",
        )),
    })
}
