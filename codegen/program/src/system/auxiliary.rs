//! Adds the auxiliary unknowns of a joint's vector form: displacements, and angles of links without a body.
//!
//! Each unknown is named after the points between which it lies, and has its design value.

use super::orientation::as_symbol;
use super::{Described, Unknown, VectorForm};
use crate::expr::{ExprId, Graph};
use crate::joint::geometry::{Mark, length, offset_along};
use crate::joint::{Auxiliary, AuxiliaryUnknown, Resolved};
use crate::model::{Body, Joint};
use crate::pool::Pool;

impl VectorForm {
    /// Adds the auxiliary unknowns of one joint, named after the joint's points.
    pub(super) fn add_auxiliaries(&mut self, joint: &Joint, bodies: &[Body], pool: &mut Pool) {
        // A driver on the line of another joint uses that joint's unknowns and has none itself.
        let count = joint.kind.auxiliaries().len();
        for auxiliary in joint.operands.auxiliaries.iter().take(count) {
            let Some(position) = as_symbol(auxiliary.value, &pool.graph) else {
                continue;
            };
            // A length is named from the line's point to the other point.
            let line = joint.operands.axis;
            let ends = line.map_or([0, 1], |axis| [axis.owner, axis.other]);
            let ends = ends.map(|side| {
                let mark = joint.operands.marks.get(side)?;
                let drawn = joint.operands.drawn.get(side)?;
                let name = match self.mark_names.on_body(mark) {
                    Some(name) => Some(name),
                    // A displacement against the ground is named after its joint.
                    None if auxiliary.kind == Auxiliary::Displacement => None,
                    // The ground lists no points: points that only the ground carries are named as points of the mechanism.
                    None => self.mark_names.elsewhere(mark, drawn.position),
                };
                name.map(|name| name.to_lowercase())
            });
            let prefix = match auxiliary.kind {
                Auxiliary::Displacement | Auxiliary::Distance => "length",
                Auxiliary::Offset => "offset",
                Auxiliary::LinkAngle => "psi",
            };
            let name = match ends {
                [Some(from), Some(to)] => format!("{prefix}_{from}_{to}"),
                _ => format!("{prefix}_{}", joint.slug),
            };
            let name = if pool.is_taken(&name) {
                format!("{name}_{}", self.unknowns.len())
            } else {
                name
            };
            pool.take_name(&name);
            let graph = &mut pool.graph;
            let [rate, acceleration] =
                ["'", "''"].map(|dots| graph.symbol(&format!("{name}{dots}")));
            let estimate = in_drawing(auxiliary.kind, &joint.operands, bodies, graph);
            pool.add_unknown([position, rate, acceleration]);
            self.unknowns.push(Unknown {
                name,
                position,
                rate,
                acceleration,
                describes: Described::Auxiliary,
                quantity: auxiliary.kind.quantity(),
                estimate,
            });
        }
    }

    /// Returns an auxiliary unknown with symbols for the vector that it rotates.
    pub(super) fn auxiliary_with_arm(
        &self,
        auxiliary: &AuxiliaryUnknown,
        pool: &mut Pool,
    ) -> AuxiliaryUnknown {
        let place = as_symbol(auxiliary.value, &pool.graph)
            .and_then(|symbol| pool.place_of_unknown(symbol));
        match (auxiliary.kind, place) {
            (Auxiliary::LinkAngle, Some(place)) => {
                let ends = self.unknowns[place].name.replacen("psi", "link", 1);
                let along = [pool.graph.one(), pool.graph.zero()];
                let turned = pool.arm(place, along, &ends);
                AuxiliaryUnknown {
                    turned,
                    ..*auxiliary
                }
            }
            _ => *auxiliary,
        }
    }
}

/// Returns the design value of an auxiliary unknown.
fn in_drawing(
    auxiliary: Auxiliary,
    operands: &Resolved,
    bodies: &[Body],
    graph: &mut Graph,
) -> ExprId {
    let drawn = |mark: &Mark, graph: &mut Graph| {
        Mark::new(bodies[mark.frame.body.0].drawn, mark.local, graph)
    };
    match auxiliary {
        Auxiliary::Displacement => match operands.along() {
            Some((axis, i, j)) => {
                let [i, j] = [i, j].map(|mark| drawn(&mark, graph));
                let turned = i.frame.rotate(axis.direction, graph);
                offset_along(axis.direction, turned, &i, &j, graph)
            }
            None => graph.zero(),
        },
        Auxiliary::Offset => match operands.across_in_drawing(graph) {
            Some(offset) => offset,
            None => graph.zero(),
        },
        Auxiliary::Distance => {
            let gap = operands.drawn_gap(graph);
            length(gap, graph)
        }
        Auxiliary::LinkAngle => {
            let [x, y] = operands.drawn_gap(graph);
            graph.atan2(y, x)
        }
    }
}
