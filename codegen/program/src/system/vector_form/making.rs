//! Makes the rows and the unknowns of the vector form from the joints of a mechanism.

use std::collections::HashMap;
use std::f64::consts::TAU;

use super::{VectorForm, VectorRow};
use crate::diagnostic::internal::work_at;
use crate::expr::{ExprId, Graph, SymbolId};
use crate::joint::{Kind, Quantity, Resolved, Row};
use crate::model::{Body, Joint, Mechanism, Role};
use crate::system::assemble::Watch;
use crate::system::mark_names::MarkNames;
use crate::system::orientation::Orientations;
use crate::system::{Settled, SymbolRole, Unknown};

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
        mechanism: &mut Mechanism,
        coordinates: &[Unknown],
        dropped: &[Vec<bool>],
        watch: &mut Watch,
    ) -> VectorForm {
        let mut form = VectorForm {
            unknowns: Settled::new(coordinates.to_vec()),
            rows: Settled::new(Vec::new()),
            arms: Settled::new(Vec::new()),
            orientations: Settled::new(Orientations::new(mechanism.bodies.len(), &mechanism.graph)),
            points: Settled::new(Vec::new()),
            naming: mechanism.naming,
            dropped: dropped.to_vec(),
            angles: mechanism
                .bodies
                .iter()
                .map(|body| body.coordinates[2].map(|it| it.place))
                .collect(),
            rates: HashMap::new(),
            arm_places: HashMap::new(),
            taken_names: coordinates
                .iter()
                .map(|coordinate| coordinate.name.clone())
                .collect(),
            name_numbers: HashMap::new(),
            arms_of: HashMap::new(),
            roles: coordinates
                .iter()
                .enumerate()
                .map(|(place, own)| (own.position, SymbolRole::Position(place)))
                .collect(),
            mark_names: MarkNames::new(&mechanism.bodies, &mechanism.points),
        };
        form.rates.extend(mechanism.explicit_rates());
        // Ties of angles must be known before the first arm is made.
        form.tie_angles(mechanism, dropped);
        let Mechanism {
            graph,
            joints,
            bodies,
            points,
            parameters,
            ..
        } = mechanism;
        let fixed = parameters.iter().map(|own| (own.symbol, graph.zero()));
        form.rates.extend(fixed);
        for (index, (joint, dropped)) in joints.iter().zip(dropped).enumerate() {
            let _work = work_at(joint.span);
            if joint.kind.keeps_vector_rows(dropped) {
                form.add_auxiliaries(joint, bodies, graph);
            }
            let operands = form.with_arms(&joint.operands, bodies, graph);
            let rows = kept_rows(joint.kind, &operands, dropped, graph);
            form.rows.write().extend(rows.iter().map(|row| VectorRow {
                joint: index,
                residual: row.residual,
                quantity: row.quantity,
                component: row.component,
            }));
            if watch.is_beyond(graph, joint.span) {
                break;
            }
        }
        for point in points.iter() {
            let mark = form.mark_with_arm(&point.mark, bodies, graph);
            let position = mark.position(graph);
            form.points.write().push(position);
        }
        form.note_rates(graph);
        form
    }

    /// Ties the angles of bodies that joints keep at a constant difference.
    fn tie_angles(&mut self, mechanism: &mut Mechanism, dropped: &[Vec<bool>]) {
        let moved = !mechanism.transmissions.is_empty() || mechanism.forces.need_multipliers();
        let Mechanism {
            graph,
            joints,
            bodies,
            ..
        } = mechanism;
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
                    self.orientations.write().tie(&row, &angles, graph);
                }
            }
        }
        self.orientations.write().settle(graph);
    }

    /// Records the rates of the unknowns and the rates of these rates.
    fn note_rates(&mut self, graph: &mut Graph) {
        for unknown in &self.unknowns {
            let (rate, acceleration) = (
                graph.variable(unknown.rate),
                graph.variable(unknown.acceleration),
            );
            self.rates.insert(unknown.position, rate);
            self.rates.insert(unknown.rate, acceleration);
        }
    }

    /// Adds a constant symbol to the value of a driver, given by its joint.
    pub(in crate::system) fn shift_driver(
        &mut self,
        joint: usize,
        shift: SymbolId,
        mechanism: &mut Mechanism,
    ) {
        let Mechanism {
            graph,
            joints,
            bodies,
            ..
        } = mechanism;
        let Joint { kind, operands, .. } = &joints[joint];
        let Some(value) = operands.value else {
            return;
        };
        self.rates.insert(shift, graph.zero());
        let delta = graph.variable(shift);
        let shifted = Resolved {
            value: Some(graph.add(value, delta)),
            ..self.with_arms(operands, bodies, graph)
        };
        let rows = self
            .rows
            .write()
            .iter_mut()
            .filter(|row| row.joint == joint);
        for (row, shifted) in rows.zip(kind.vector_rows(&shifted, graph)) {
            row.residual = shifted.residual;
        }
    }
}

/// Returns a joint's rows of the vector form. If a textbook row of the joint is not solved, returns its other textbook rows:
/// those need no auxiliary unknowns, whose number would not match.
pub(in crate::system) fn kept_rows(
    kind: &Kind,
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
