//! Joints that let bodies press on one another → how the follower moves there against the normal.

use std::collections::HashMap;

use super::Unknown;
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
pub(super) fn pressures(
    mechanism: &mut Mechanism,
    coordinates: &[Unknown],
    contacts: &HashMap<usize, usize>,
) -> Vec<Pressure> {
    let Mechanism {
        graph,
        joints,
        bodies,
        ..
    } = mechanism;
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
        let Some(&contact_at) = contacts.get(&index) else {
            continue;
        };
        let [Some(x), Some(y), Some(phi)] = bodies[body].coordinates else {
            continue;
        };
        let [x, y, phi, s] = [x.place, y.place, phi.place, contact_at]
            .map(|at| graph.variable(coordinates[at].rate));
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
