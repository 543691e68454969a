//! Roller follower: a disc whose center is a point of one body rolls along a curve of another.

use super::geometry::{Vector, add, subtract};
use super::{
    Contact, Curve, Feature, Follower, Kind, Operands, Quantity, Refusal, Resolved, Row, Value,
};
use crate::expr::{ExprId, Graph};

/// r_j + R_j s_j − r_i − R_i (p(s) + ρ n(s)) = 0 with the radius ρ (Norton 2009, Cam Design and Manufacturing Handbook: the
/// pitch curve of a cam).
///
/// The unit normal n points to the side of the roller in the design configuration. The rotation of the roller about its center
/// is not computed, so the roller needs no body.
pub struct Roller;

/// Returns the pitch curve p + ρ n, in the frame of the curve.
fn pitch(curve: &Curve, radius: ExprId, graph: &mut Graph) -> Vector {
    let normal = curve.normal(graph);
    let reach = normal.map(|component| graph.multiply(radius, component));
    add(curve.point, reach, graph)
}

impl Kind for Roller {
    fn keyword(&self) -> &'static str {
        "roller"
    }

    fn operands(&self) -> Operands {
        Operands::POINT_AND_CURVE
    }

    fn value(&self) -> Value {
        Value::Required(Quantity::Length)
    }

    fn example(&self) -> &'static str {
        "`roller (2.P, rim) = 10mm;` with `curve rim(a) on 1 = polar RADIUS;`"
    }

    fn feature(&self, operands: &Resolved, _graph: &mut Graph) -> Option<Feature> {
        let radius = operands.value?;
        Some(Feature::Contact(Follower::Roller(radius)))
    }

    fn refusal(&self, operands: &Resolved, graph: &mut Graph) -> Option<Refusal> {
        let radius = graph.constant_value(operands.value?)?;
        (radius <= 0.0).then(|| Refusal {
            problem: "the radius of a roller must be positive".to_string(),
            help: "write `point_on_curve` for a point; the side of the roller follows from the design configuration"
                .to_string(),
        })
    }

    fn positive(&self, operands: &Resolved, _graph: &mut Graph) -> Option<(ExprId, &'static str)> {
        Some((operands.value?, "the radius of the roller"))
    }

    fn rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
        let (Some(curve), Some(radius)) = (operands.curve, operands.value) else {
            return Vec::new();
        };
        let center = operands.marks[0].position(graph);
        let pitch = pitch(&curve, radius, graph);
        let held = curve.position(pitch, graph);
        let gap = subtract(center, held, graph);
        let row = |residual, component| Row {
            residual,
            quantity: Quantity::Length,
            component,
        };
        vec![row(gap[0], "x"), row(gap[1], "y")]
    }

    /// Returns the contact. The pitch curve has a cusp where 1 + ρ κ = 0: the roller is larger than the concave radius there.
    fn contact(&self, operands: &Resolved, graph: &mut Graph) -> Option<Contact> {
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
}
