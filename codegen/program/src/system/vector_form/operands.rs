//! Replaces the vectors of operands by the rotated local vectors of the leaders of their bodies.

use super::VectorForm;
use crate::joint::Resolved;
use crate::joint::geometry::{BodyFrame, Mark, Vector};
use crate::model::Body;
use crate::pool::Pool;

impl VectorForm {
    /// Returns the operands with symbols for all rotated vectors.
    pub(in crate::system) fn with_arms(
        &self,
        operands: &Resolved,
        bodies: &[Body],
        pool: &mut Pool,
    ) -> Resolved {
        let marks = operands
            .marks
            .iter()
            .map(|mark| self.mark_with_arm(mark, bodies, pool))
            .collect();
        let axis = operands.axis.map(|axis| {
            let frame = operands.marks[axis.owner].frame;
            let body = frame.body.0;
            let name = format!("axis_{}", bodies[body].name.to_lowercase());
            let turned = self.turned(&frame, axis.direction, &name, pool);
            crate::joint::Axis { turned, ..axis }
        });
        let curve = operands.curve.map(|curve| {
            let body = curve.frame.body.0;
            let name = format!("axis_{}", bodies[body].name.to_lowercase());
            let along = [pool.graph.one(), pool.graph.zero()];
            let axis = self.turned(&curve.frame, along, &name, pool);
            crate::joint::Curve { axis, ..curve }
        });
        let auxiliaries = operands
            .auxiliaries
            .iter()
            .map(|auxiliary| self.auxiliary_with_arm(auxiliary, pool))
            .collect();
        Resolved {
            marks,
            drawn: operands.drawn.clone(),
            axis,
            curve,
            value: operands.value,
            auxiliaries,
            formula: operands.formula.clone(),
        }
    }

    pub(in crate::system) fn mark_with_arm(
        &self,
        mark: &Mark,
        bodies: &[Body],
        pool: &mut Pool,
    ) -> Mark {
        let body = &bodies[mark.frame.body.0];
        let point = self.mark_names.on_body(mark).map_or("arm", String::as_str);
        let name = format!("{point}_{}", body.name).to_lowercase();
        let arm = self.turned(&mark.frame, mark.local, &name, pool);
        Mark { arm, ..*mark }
    }

    /// Returns R s as an arm of the leader, or a constant vector on a body that does not rotate.
    pub(super) fn turned(
        &self,
        frame: &BodyFrame,
        local: Vector,
        name: &str,
        pool: &mut Pool,
    ) -> Vector {
        let (leader, offset) = self.orientations.leader(frame.body);
        let toward_leader = BodyFrame {
            angle: offset,
            ..*frame
        };
        let local = toward_leader.rotate(local, &mut pool.graph);
        if leader.0 == 0 {
            local
        } else {
            pool.arm(self.angle_of(leader.0), local, name)
        }
    }
}
