//! Derives the terms of pressure angles: velocities of the follower along and across the contact normal.

use std::collections::HashMap;

use super::Unknown;
use crate::expr::{ExprId, Graph};
use crate::joint::geometry::{Vector, dot, perpendicular};
use crate::model::Mechanism;

/// Terms of the pressure angle of one joint, as expressions of q and q̇.
///
/// The velocity is that of the follower's point at the contact: the center of a roller, or the touching point of a face.
#[derive(Clone, Debug)]
pub struct Pressure {
    /// Index into the mechanism's joints.
    pub joint: usize,
    /// Velocity along the common normal, in m/s.
    pub along: ExprId,
    /// Velocity across the common normal, in m/s.
    pub across: ExprId,
    /// Square of the speed of the contact along the curve, in m²/s².
    pub sliding: ExprId,
}

/// Returns the terms of every contact between two moving bodies. A curve on the ground pushes nothing, and a follower on the
/// ground is not pushed.
pub(super) fn pressures(
    mechanism: &Mechanism,
    coordinates: &[Unknown],
    contacts: &HashMap<usize, usize>,
    graph: &mut Graph,
) -> Vec<Pressure> {
    let Mechanism { joints, bodies, .. } = mechanism;
    let mut pressures = Vec::new();
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
        pressures.push(Pressure {
            joint: index,
            along: dot(velocity, contact.normal, graph),
            across: dot(velocity, left, graph),
            sliding: square_of_speed(tangent, s, graph),
        });
    }
    pressures
}

/// (p' ṡ)².
fn square_of_speed(tangent: Vector, rate: ExprId, graph: &mut Graph) -> ExprId {
    let velocity = tangent.map(|component| graph.multiply(component, rate));
    dot(velocity, velocity, graph)
}
