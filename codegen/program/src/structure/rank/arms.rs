//! Finds arms for joints marked `redundant` on bodies that turn about another point.
//!
//! Without the joint such a body rotates freely. The row across the arm then determines its angle equally well in every pose, and
//! the row along the arm repeats other equations. A row along a fixed axis would be singular twice per turn.

use super::functions::Functions;
use super::motion::pivot;
use super::survey::{all_rows, poses, whole};
use crate::expr::Graph;
use crate::joint::geometry::{Mark, Vector, length, subtract};
use crate::joint::{AuxiliaryUnknown, Axis, Drawn, Kind};
use crate::model::Mechanism;
use crate::pool::Pool;
use crate::system::System;

/// Arm of a body from its center of rotation to a pin.
pub(super) struct Arm {
    /// Joint of the pin.
    joint: usize,
    kind: &'static dyn Kind,
    /// Index of the joint's mark that the body carries.
    own: usize,
    /// Center of rotation of the body, in its frame.
    pivot: Vector,
}

/// Returns the arms of all joints that have one.
pub(super) fn arms(pool: &Pool, system: &System) -> Vec<Arm> {
    let joints = system.mechanism.joints.iter().enumerate();
    let marked = joints.filter(|(_, own)| own.redundant.is_some());
    let pinned = marked.filter_map(|(at, own)| Some((at, own.kind.on_arm()?)));
    pinned
        .filter_map(|(at, kind)| arm(pool, system, at, kind))
        .collect()
}

fn arm(pool: &Pool, system: &System, joint: usize, kind: &'static dyn Kind) -> Option<Arm> {
    let marks = &system.mechanism.joints[joint].operands.marks;
    let bodies = [0, 1].map(|side| marks[side].frame.body.0);
    let others = all_rows(system).into_iter();
    let others = others.filter(|&at| system.row(at).joint != joint);
    let functions: Functions<'_> = whole(pool, system, others.collect());
    let consistent = poses(pool, system, &functions);
    (0..2).find_map(|own| {
        let pair = [bodies[own], bodies[1 - own]];
        let pivot = pivot(pool, system, &functions, &consistent, pair)?;
        Some(Arm {
            joint,
            kind,
            own,
            pivot,
        })
    })
}

impl Arm {
    /// Makes the joint's rows lie along and across the arm.
    pub(super) fn state(&self, mechanism: &mut Mechanism, graph: &mut Graph) {
        let Mechanism { joints, bodies, .. } = mechanism;
        let joint = &mut joints[self.joint];
        let operands = &mut joint.operands;
        let pin = operands.marks[self.own];
        let arm = subtract(pin.local, self.pivot, graph);
        let size = length(arm, graph);
        let direction = arm.map(|component| {
            let part = graph.divide(component, size);
            graph.tidied(part)
        });
        let drawn = [self.own, 1 - self.own].map(|side| operands.drawn[side].frame);
        operands.axis = Some(Axis {
            owner: 2,
            other: 1 - self.own,
            direction,
            turned: pin.frame.rotate(direction, graph),
            relative_angle: graph.subtract(drawn[0].angle, drawn[1].angle),
        });
        let frame = bodies[pin.frame.body.0].drawn;
        operands.drawn.push(Drawn {
            frame,
            position: Mark::new(frame, self.pivot, graph).position(graph),
        });
        operands.marks.push(Mark::new(pin.frame, self.pivot, graph));
        joint.kind = self.kind;
        operands.auxiliaries = AuxiliaryUnknown::of(self.kind, self.joint, graph);
    }
}
