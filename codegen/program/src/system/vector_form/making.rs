//! Makes the rows and the unknowns of the vector form from the joints of a mechanism.

use std::collections::HashMap;
use std::f64::consts::TAU;

use super::{VectorForm, VectorRow};
use crate::diagnostic::internal::work_at;
use crate::expr::{ExprId, Graph, SymbolId};
use crate::joint::{Kind, Quantity, Resolved, Row};
use crate::model::{Body, Joint, Mechanism, Role};
use crate::pool::Pool;
use crate::system::Unknown;
use crate::system::mark_names::MarkNames;
use crate::system::orientation::Orientations;

/// Largest distance between a driven angle and its design value at which the assembly mode is sure, in rad.
const DESIGN_TOLERANCE: f64 = 1e-3;

/// True if the design angles satisfy a row except for whole turns, or if the row has other unknowns.
fn is_drawn(row: &Row, bodies: &[Body], graph: &mut Graph) -> bool {
    let angles = bodies.iter().filter_map(|body| {
        let [_, _, angle] = body.coordinates;
        Some((angle?.symbol, body.drawn.angle))
    });
    let angles: Vec<(SymbolId, ExprId)> = angles.collect();
    let missed = graph.substitute(row.residual, &angles);
    graph.constant_value(missed).is_none_or(|missed| {
        let turns = missed / TAU;
        (turns - turns.round()).abs() * TAU <= DESIGN_TOLERANCE
    })
}

impl VectorForm {
    /// Makes the vector form of every joint, with the design values of auxiliary unknowns. `dropped` is true for each textbook
    /// row of a joint that is not solved.
    pub(in crate::system) fn new(
        mechanism: &Mechanism,
        coordinates: &[Unknown],
        dropped: &[Vec<bool>],
        pool: &mut Pool,
    ) -> VectorForm {
        let mut form = VectorForm {
            unknowns: coordinates.to_vec(),
            rows: Vec::new(),
            orientations: Orientations::new(mechanism.bodies.len(), &pool.graph),
            points: Vec::new(),
            dropped: dropped.to_vec(),
            angles: mechanism
                .bodies
                .iter()
                .map(|body| body.coordinates[2].map(|it| it.place))
                .collect(),
            mark_names: MarkNames::new(&mechanism.bodies, &mechanism.points),
        };
        for (symbol, rate) in mechanism.explicit_rates(&mut pool.graph) {
            pool.set_rate(symbol, rate);
        }
        // Ties of angles must be known before the first arm is made.
        form.tie_angles(mechanism, dropped, &mut pool.graph);
        let Mechanism {
            joints,
            bodies,
            points,
            parameters,
            ..
        } = mechanism;
        for parameter in parameters {
            pool.set_rate(parameter.symbol, pool.graph.zero());
        }
        for (index, (joint, dropped)) in joints.iter().zip(dropped).enumerate() {
            let _work = work_at(joint.span);
            if joint.kind.keeps_vector_rows(dropped) {
                form.add_auxiliaries(joint, bodies, pool);
            }
            let operands = form.with_arms(&joint.operands, bodies, pool);
            let rows = kept_rows(joint.kind, &operands, dropped, &mut pool.graph);
            form.rows.extend(rows.iter().map(|row| VectorRow {
                joint: index,
                residual: row.residual,
                quantity: row.quantity,
                component: row.component,
            }));
            if pool.is_beyond(joint.span) {
                break;
            }
        }
        for point in points.iter() {
            let mark = form.mark_with_arm(&point.mark, bodies, pool);
            let position = mark.position(&mut pool.graph);
            form.points.push(position);
        }
        pool.set_rates_of_unknowns();
        form
    }

    /// Ties the angles of bodies that joints keep at a constant difference.
    fn tie_angles(&mut self, mechanism: &Mechanism, dropped: &[Vec<bool>], graph: &mut Graph) {
        let moved = !mechanism.transmissions.is_empty() || mechanism.forces.need_multipliers();
        let Mechanism { joints, bodies, .. } = mechanism;
        let angles = bodies.iter().enumerate().filter_map(|(body, own)| {
            let [_, _, angle] = own.coordinates;
            Some((angle?.symbol, body))
        });
        let angles: HashMap<SymbolId, usize> = angles.collect();
        for (joint, dropped) in joints.iter().zip(dropped) {
            // A driver that keeps an angle at its design value ties the angle, unless the driver's value is to be shifted.
            let is_driver = joint.role == Role::Driver;
            if moved && is_driver {
                continue;
            }
            for row in kept_rows(joint.kind, &joint.operands, dropped, graph) {
                let is_tied = !is_driver || is_drawn(&row, bodies, graph);
                if row.quantity == Quantity::Angle && is_tied {
                    self.orientations.tie(&row, &angles, graph);
                }
            }
        }
        self.orientations.settle(graph);
    }

    /// Adds a constant symbol to the value of a driver in these rows of the vector form. The driver is given by its joint.
    pub(in crate::system) fn shift_driver(
        &self,
        joint: usize,
        shift: SymbolId,
        mechanism: &Mechanism,
        rows: &mut [VectorRow],
        pool: &mut Pool,
    ) {
        let Mechanism { joints, bodies, .. } = mechanism;
        let Joint { kind, operands, .. } = &joints[joint];
        let Some(value) = operands.value else {
            return;
        };
        pool.set_rate(shift, pool.graph.zero());
        let delta = pool.graph.variable(shift);
        let shifted = Resolved {
            value: Some(pool.graph.add(value, delta)),
            ..self.with_arms(operands, bodies, pool)
        };
        let rows = rows.iter_mut().filter(|row| row.joint == joint);
        for (row, shifted) in rows.zip(kind.vector_rows(&shifted, &mut pool.graph)) {
            row.residual = shifted.residual;
        }
    }
}

/// Returns a joint's rows of the vector form. If a textbook row of the joint is not solved, returns its other textbook rows:
/// those need no auxiliary unknowns, whose number would not match.
pub(in crate::system) fn kept_rows(
    kind: &dyn Kind,
    operands: &Resolved,
    dropped: &[bool],
    graph: &mut Graph,
) -> Vec<Row> {
    if kind.keeps_vector_rows(dropped) {
        return kind.vector_rows(operands, graph);
    }
    let rows = kind.rows(operands, graph).into_iter().zip(dropped);
    rows.filter(|(_, dropped)| !**dropped)
        .map(|(row, _)| row)
        .collect()
}
