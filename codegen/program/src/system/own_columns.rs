//! Differentiates a joint's rows of the vector form while every body rotates independently.
//!
//! In the vector form, bodies of constant relative angle share one sine and cosine. A joint's action on one of them needs the
//! change of its rows while that body alone rotates. Derivatives are in terms of the shared rotated vectors.

use std::collections::BTreeMap;

use super::vector_form::making::kept_rows;
use super::{VectorForm, VectorRow};
use crate::expr::{ExprId, Graph, SymbolId};
use crate::joint::geometry::{Vector, perpendicular};
use crate::joint::{Auxiliary, AuxiliaryUnknown, Axis, Curve, Resolved};
use crate::model::Mechanism;
use crate::pool::Pool;

/// Rotating body or link.
#[derive(Clone, Copy, PartialEq)]
enum Turning {
    /// Body, by its index.
    Body(usize),
    /// Link without a body: the index of its angle among the joint's auxiliary unknowns.
    Link(usize),
}

/// Derivatives of a row in unknowns.
pub(super) type Columns = BTreeMap<usize, ExprId>;

impl VectorForm {
    /// Returns the joint's rows by their indices among all rows, with derivatives in unknowns that are not identically zero.
    pub(super) fn own_columns(
        &self,
        joint: usize,
        rows: &[VectorRow],
        mechanism: &Mechanism,
        pool: &mut Pool,
    ) -> Vec<(usize, Columns)> {
        let rows = rows.iter().enumerate();
        let rows = rows.filter(|(_, row)| row.joint == joint);
        let (places, residuals): (Vec<usize>, Vec<ExprId>) =
            rows.map(|(place, row)| (place, row.residual)).unzip();
        let dropped = self.dropped[joint].clone();
        let kind = mechanism.joints[joint].kind;
        let state = |operands: &Resolved, graph: &mut Graph| {
            let rows = kept_rows(kind, operands, &dropped, graph);
            rows.into_iter().map(|row| row.residual).collect()
        };
        let columns = self.columns(joint, residuals, state, mechanism, pool);
        places.into_iter().zip(columns).collect()
    }

    /// Returns the derivatives of the joint's monitored rows.
    pub(super) fn monitored_columns(
        &self,
        joint: usize,
        mechanism: &Mechanism,
        pool: &mut Pool,
    ) -> Vec<Columns> {
        let dropped = self.dropped[joint].clone();
        let kind = mechanism.joints[joint].kind;
        let state = |operands: &Resolved, graph: &mut Graph| -> Vec<ExprId> {
            let rows = kind.rows(operands, graph).into_iter().zip(&dropped);
            rows.filter(|(_, is_dropped)| **is_dropped)
                .map(|(row, _)| row.residual)
                .collect()
        };
        let Mechanism { joints, bodies, .. } = mechanism;
        let operands = self.with_arms(&joints[joint].operands, bodies, pool);
        let residuals = state(&operands, &mut pool.graph);
        self.columns(joint, residuals, state, mechanism, pool)
    }

    /// Returns the derivatives of rows that `state` makes of operands.
    fn columns(
        &self,
        joint: usize,
        residuals: Vec<ExprId>,
        state: impl Fn(&Resolved, &mut Graph) -> Vec<ExprId>,
        mechanism: &Mechanism,
        pool: &mut Pool,
    ) -> Vec<Columns> {
        let Mechanism { joints, bodies, .. } = mechanism;
        let operands = self.with_arms(&joints[joint].operands, bodies, pool);
        let mut rows = vec![Columns::new(); residuals.len()];
        for (columns, residual) in rows.iter_mut().zip(residuals) {
            for symbol in pool.graph.symbols(residual).to_vec() {
                if let Some(unknown) = pool.place_of_unknown(symbol) {
                    columns.insert(unknown, pool.graph.derivative(residual, symbol));
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
            let symbol = super::orientation::as_symbol(auxiliary.value, &pool.graph);
            let unknown = symbol.and_then(|symbol| pool.place_of_unknown(symbol));
            turning.extend(unknown.map(|unknown| (Turning::Link(at), unknown)));
        }
        turning.sort_unstable_by_key(|(_, unknown)| *unknown);
        turning.dedup_by_key(|(_, unknown)| *unknown);
        let graph = &mut pool.graph;
        let step = graph.symbol("turned by itself");
        let zero = graph.zero();
        for (turning, unknown) in turning {
            let turned = turned(&operands, turning, step, graph);
            let stated = state(&turned, graph);
            for (columns, stated) in rows.iter_mut().zip(stated) {
                let slope = graph.derivative(stated, step);
                let slope = graph.substitute(slope, &[(step, zero)]);
                let direct = columns.get(&unknown).copied().unwrap_or(zero);
                columns.insert(unknown, graph.add(direct, slope));
            }
        }
        for columns in &mut rows {
            columns.retain(|_, value| *value != zero);
        }
        rows
    }
}

/// Returns the operands with the vectors of one body or link rotated by a small angle.
fn turned(operands: &Resolved, turning: Turning, step: SymbolId, graph: &mut Graph) -> Resolved {
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
