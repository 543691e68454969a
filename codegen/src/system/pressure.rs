//! Joints that let bodies press on one another → how the follower moves there against the normal.

use super::{Coordinate, Described};
use crate::expr::{ExprId, Graph};
use crate::joint::geometry::{Vector, dot, perpendicular};
use crate::model::Mechanism;

/// What the pressure angle of one joint follows from, as expressions of q and q̇.
///
/// The velocity is that of the follower's point at the contact: of the center of a roller, and of the point of a face that
/// just touches.
#[derive(Clone, Debug)]
pub struct Pressure {
    /// An index into the mechanism's joints.
    pub joint: usize,
    /// The velocity along the common normal, in m/s.
    pub along: ExprId,
    /// The velocity across it, in m/s.
    pub across: ExprId,
    /// The square of the speed with which the contact runs along the curve, in m²/s².
    pub sliding: ExprId,
}

/// Of every joint between two moving bodies that touch. Where the curve or the follower is fixed to the ground, nothing is
/// pushed by the curve.
pub(super) fn pressures(mechanism: &mut Mechanism, coordinates: &[Coordinate]) -> Vec<Pressure> {
    let Mechanism { graph, joints, .. } = mechanism;
    let mut found = Vec::new();
    for (index, joint) in joints.iter().enumerate() {
        let (Some(curve), Some(contact)) = (
            joint.operands.curve,
            joint.kind.contact(&joint.operands, graph),
        ) else {
            continue;
        };
        let body = contact.follower.body.0;
        if body == 0 || curve.frame.body.0 == 0 {
            continue;
        }
        let rate_of = |described: Described| {
            let coordinate = coordinates.iter().find(|it| it.describes == described);
            coordinate.map(|coordinate| coordinate.rate)
        };
        let pose = [0, 1, 2].map(|axis| rate_of(Described::Pose { body, axis }));
        let ([Some(x), Some(y), Some(phi)], Some(s)) =
            (pose, rate_of(Described::Contact { joint: index }))
        else {
            continue;
        };
        let [x, y, phi, s] = [x, y, phi, s].map(|rate| graph.variable(rate));
        let arm = crate::joint::geometry::subtract(contact.place, contact.follower.origin, graph);
        let turning = perpendicular(arm, graph).map(|component| graph.multiply(phi, component));
        let velocity = [graph.add(x, turning[0]), graph.add(y, turning[1])];
        let left = perpendicular(contact.normal, graph);
        let tangent = curve.tangent(graph);
        found.push(Pressure {
            joint: index,
            along: dot(velocity, contact.normal, graph),
            across: dot(velocity, left, graph),
            sliding: square_of_speed(tangent, s, graph),
        });
    }
    found
}

/// (p' ṡ)².
fn square_of_speed(tangent: Vector, rate: ExprId, graph: &mut Graph) -> ExprId {
    let velocity = tangent.map(|component| graph.multiply(component, rate));
    dot(velocity, velocity, graph)
}
