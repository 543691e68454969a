//! A joint → the derivatives of its rows of the vector form, every body turning by itself.
//!
//! The vector form lets bodies that keep their angle share the sine and cosine of one of them; what a joint passes to each of them
//! asks how its rows change when that body alone turns. Everything is still in terms of the shared arms.

use std::collections::BTreeMap;

use super::VectorForm;
use crate::expr::{ExprId, SymbolId};
use crate::joint::geometry::{Vector, perpendicular};
use crate::joint::{Auxiliary, AuxiliaryUnknown, Axis, Curve, Resolved};
use crate::model::Mechanism;

/// What turns by itself.
#[derive(Clone, Copy, PartialEq)]
enum Turning {
    /// A body.
    Body(usize),
    /// A link without a body: the place of its angle among the joint's auxiliary unknowns.
    Link(usize),
}

impl VectorForm {
    /// The rows of a joint by their places among all, and their derivatives in unknowns that are not identically zero.
    pub(super) fn own_columns(
        &mut self,
        joint: usize,
        mechanism: &mut Mechanism,
    ) -> Vec<(usize, BTreeMap<usize, ExprId>)> {
        let Mechanism {
            graph,
            joints,
            bodies,
            ..
        } = mechanism;
        let own = &joints[joint];
        let places = self.rows.iter().enumerate();
        let places: Vec<usize> = places
            .filter(|(_, row)| row.joint == joint)
            .map(|(place, _)| place)
            .collect();
        let operands = self.with_arms(&own.operands, bodies, graph);
        let mut rows: Vec<(usize, BTreeMap<usize, ExprId>)> = places
            .iter()
            .map(|&place| (place, BTreeMap::new()))
            .collect();
        for (place, columns) in &mut rows {
            let residual = self.rows[*place].residual;
            for symbol in graph.symbols(residual).to_vec() {
                if let Some(unknown) = self.place_of_unknown(symbol) {
                    columns.insert(unknown, graph.derivative(residual, symbol));
                }
            }
        }
        let turning_bodies = operands.marks.iter().map(|mark| mark.frame.body.0);
        let curved = operands.curve.map(|curve| curve.frame.body.0);
        let mut turning: Vec<(Turning, usize)> = turning_bodies
            .chain(curved)
            .filter(|&body| body != 0)
            .map(|body| (Turning::Body(body), self.angle_of(body)))
            .collect();
        let links = operands.auxiliaries.iter().enumerate();
        for (at, auxiliary) in links.filter(|(_, it)| it.kind == Auxiliary::LinkAngle) {
            let symbol = super::orientation::as_symbol(auxiliary.value, graph);
            let unknown = symbol.and_then(|symbol| self.place_of_unknown(symbol));
            turning.extend(unknown.map(|unknown| (Turning::Link(at), unknown)));
        }
        turning.sort_unstable_by_key(|(_, unknown)| *unknown);
        turning.dedup_by_key(|(_, unknown)| *unknown);
        let step = graph.symbol("turned by itself");
        // A row of the textbook in place of one that is monitored has no other form.
        let count = own.kind.vector_rows(&operands, graph).len();
        if count != places.len() {
            return rows;
        }
        let zero = graph.zero();
        for (turning, unknown) in turning {
            let turned = turned(&operands, turning, step, graph);
            let stated = own.kind.vector_rows(&turned, graph);
            for ((_, columns), stated) in rows.iter_mut().zip(stated) {
                let slope = graph.derivative(stated.residual, step);
                let slope = graph.substitute(slope, &[(step, zero)]);
                let direct = columns.get(&unknown).copied().unwrap_or(zero);
                columns.insert(unknown, graph.add(direct, slope));
            }
        }
        for (_, columns) in &mut rows {
            columns.retain(|_, value| *value != zero);
        }
        rows
    }
}

/// The operands with the vectors of one body, or of one link, turned on by a small angle.
fn turned(
    operands: &Resolved,
    turning: Turning,
    step: SymbolId,
    graph: &mut crate::expr::Graph,
) -> Resolved {
    let mut further = |vector: Vector| -> Vector {
        let step = graph.variable(step);
        let across = perpendicular(vector, graph);
        [0, 1].map(|axis| {
            let moved = graph.multiply(step, across[axis]);
            graph.add(vector[axis], moved)
        })
    };
    let mut turned = operands.clone();
    for mark in &mut turned.marks {
        if turning == Turning::Body(mark.frame.body.0) {
            mark.arm = further(mark.arm);
        }
    }
    if let Some(axis) = &mut turned.axis {
        let owner = operands.marks[axis.owner].frame.body.0;
        if turning == Turning::Body(owner) {
            *axis = Axis {
                turned: further(axis.turned),
                ..*axis
            };
        }
    }
    if let Some(curve) = &mut turned.curve
        && turning == Turning::Body(curve.frame.body.0)
    {
        *curve = Curve {
            axis: further(curve.axis),
            ..*curve
        };
    }
    for (at, auxiliary) in turned.auxiliaries.iter_mut().enumerate() {
        if turning == Turning::Link(at) {
            *auxiliary = AuxiliaryUnknown {
                turned: further(auxiliary.turned),
                ..*auxiliary
            };
        }
    }
    turned
}
