//! Lists the lengths whose maximum is the characteristic length, if a parameter changes one of them.
//!
//! The list has the components of joint points in their bodies and the constant lengths of the equations. These lengths give the
//! size of a mechanism and its distance from the origin. Estimated poses of bodies do not count, as an estimate may not follow a
//! change of parameters. The largest constant length represents all constant ones. The list is empty if no parameter occurs; the
//! largest design coordinate then is the characteristic length.

use std::collections::HashSet;

use crate::expr::{ExprId, Graph, Node};
use crate::joint::Quantity;
use crate::model::Mechanism;
use crate::pool::Pool;

use super::{Row, System};

/// Returns the lengths that depend on parameters, each once and in written order, after the largest constant length.
pub(super) fn lengths(mechanism: &Mechanism, rows: &[Row], graph: &mut Graph) -> Vec<ExprId> {
    if mechanism.parameters.is_empty() {
        return Vec::new();
    }
    let Mechanism { joints, bodies, .. } = mechanism;
    let marks = joints.iter().flat_map(|it| &it.operands.marks);
    // Vectors on a body that is only an angle are directions.
    let marks = marks.filter(|mark| !bodies[mark.frame.body.0].is_angle());
    let mut lengths: Vec<ExprId> = marks.flat_map(|mark| mark.local).collect();
    lengths.extend(joints.iter().filter_map(|it| it.operands.length()));
    for row in rows.iter().filter(|row| row.quantity == Quantity::Length) {
        let Node::Sum(terms) = graph.node(row.residual) else {
            continue;
        };
        let terms = terms.clone();
        let known = terms.iter().filter(|term| graph.is_fixed(term.expr));
        let known: Vec<_> = known.copied().collect();
        // Only magnitudes count.
        lengths.extend(known.iter().map(|it| match it.coefficient.to_f64().abs() {
            1.0 => it.expr,
            _ => graph.scale(it.coefficient, it.expr),
        }));
    }
    let graph = &*graph;
    let value = |expr: ExprId| graph.constant_value(expr).map(f64::abs);
    let mut largest: Option<ExprId> = None;
    let mut following: Vec<ExprId> = Vec::new();
    let mut known: HashSet<ExprId> = HashSet::new();
    for expr in lengths {
        if !graph.is_fixed(expr) {
            continue;
        }
        if !graph.is_constant(expr) {
            if known.insert(expr) {
                following.push(expr);
            }
        } else if value(expr) > largest.and_then(value).or(Some(0.0)) {
            largest = Some(expr);
        }
    }
    if following.is_empty() {
        return following;
    }
    largest.into_iter().chain(following).collect()
}

impl System {
    /// Returns the characteristic length, in m, at the nominal values of the parameters.
    pub fn characteristic_length(&self, pool: &Pool) -> f64 {
        let values = self.lengths.iter();
        let largest = values
            .filter_map(|&it| pool.graph.constant_value(it))
            .fold(0.0_f64, |largest, value| largest.max(value.abs()));
        if largest > 0.0 && largest.is_finite() {
            largest
        } else {
            self.mechanism.characteristic_length
        }
    }

    /// Returns the scale of a quantity: a power of the characteristic length by its exponent of metres, 1 rad for angles.
    pub fn scale(&self, quantity: Quantity, pool: &Pool) -> f64 {
        self.characteristic_length(pool)
            .powi(quantity.power_of_length())
    }
}
