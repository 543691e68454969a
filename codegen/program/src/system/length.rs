//! *Mechanism and its rows* → *the lengths whose largest is what lengths are judged against*, where parameters change one.
//!
//! These are the components of the points that joints hold, in their bodies, and the known lengths that equations are made
//! of: what says how large a mechanism is and how far off the origin it stands. Where bodies are drawn does not count, as an
//! estimate may stay behind when parameters change. Constants are represented by the largest. The list is empty where no
//! parameter occurs: then the drawing's largest coordinate serves. The module does not know what is judged.

use std::collections::HashSet;

use crate::expr::{ExprId, Node};
use crate::joint::Quantity;
use crate::model::Mechanism;

use super::{Row, System};

/// The lengths that follow parameters, each once and in written order, and before them the largest constant one.
pub(super) fn lengths(mechanism: &mut Mechanism, rows: &[Row]) -> Vec<ExprId> {
    if mechanism.parameters.is_empty() {
        return Vec::new();
    }
    let Mechanism {
        graph,
        joints,
        bodies,
        ..
    } = mechanism;
    let marks = joints.iter().flat_map(|it| &it.operands.marks);
    // What an angle turns is a direction.
    let marks = marks.filter(|mark| !bodies[mark.frame.body.0].is_angle());
    let mut found: Vec<ExprId> = marks.flat_map(|mark| mark.local).collect();
    found.extend(joints.iter().filter_map(|it| it.operands.length()));
    for row in rows.iter().filter(|row| row.quantity == Quantity::Length) {
        let Node::Sum(terms) = graph.node(row.residual) else {
            continue;
        };
        let terms = terms.clone();
        let known = terms.iter().filter(|term| graph.is_fixed(term.expr));
        let known: Vec<_> = known.copied().collect();
        // Only magnitudes count.
        found.extend(known.iter().map(|it| match it.coefficient.to_f64().abs() {
            1.0 => it.expr,
            _ => graph.scale(it.coefficient, it.expr),
        }));
    }
    let graph = &*graph;
    let value = |expr: ExprId| graph.constant_value(expr).map(f64::abs);
    let mut largest: Option<ExprId> = None;
    let mut following: Vec<ExprId> = Vec::new();
    let mut known: HashSet<ExprId> = HashSet::new();
    for expr in found {
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
    /// What lengths are judged against, in m, at the nominal values of the parameters.
    pub fn characteristic_length(&self) -> f64 {
        let graph = &self.mechanism.graph;
        let values = self.lengths.iter();
        let largest = values
            .filter_map(|&it| graph.constant_value(it))
            .fold(0.0_f64, |largest, value| largest.max(value.abs()));
        if largest > 0.0 && largest.is_finite() {
            largest
        } else {
            self.mechanism.characteristic_length
        }
    }

    /// What values of a quantity are judged against: the characteristic length to the power of metres, 1 rad for angles.
    pub fn scale(&self, quantity: Quantity) -> f64 {
        self.characteristic_length()
            .powi(quantity.power_of_length())
    }
}
