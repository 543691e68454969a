//! Names components of rotated local vectors.

use super::EQUALITY_TOLERANCE;
use crate::expr::{ExprId, Node};
use crate::pool::{Pool, SymbolRole};
use crate::system::System;

/// Returns the name of a sum that is a component of a point's local vector, rotated with its body: `p_coupler_x`, or
/// `minus_p_coupler_x` for the opposite. `None` if the sum is of another kind.
pub(in crate::program) fn rotated_component(
    expr: ExprId,
    pool: &Pool,
    system: &System,
) -> Option<String> {
    let graph = &pool.graph;
    let Node::Sum(terms) = graph.node(expr) else {
        return None;
    };
    let [first, second] = &terms[..] else {
        return None;
    };
    let (mut sine, mut cosine) = (None, None);
    for term in [first, second] {
        let (value, base) = scaled(term.coefficient.to_f64(), term.expr, pool)?;
        match *graph.node(base) {
            Node::Sin(angle) => sine = Some((value, angle)),
            Node::Cos(angle) => cosine = Some((value, angle)),
            _ => return None,
        }
    }
    let ((sine, angle), (cosine, other)) = (sine?, cosine?);
    let Node::Symbol(symbol) = *graph.node(angle) else {
        return None;
    };
    let is_angle = matches!(pool.role(symbol), SymbolRole::Position(_));
    if angle != other || !is_angle {
        return None;
    }
    let bodies = system.mechanism.bodies.iter();
    for body in bodies.filter(|body| body.frame.angle == angle) {
        for mark in &body.marks {
            let [x, y] = mark.mark.local.map(|part| graph.constant_value(part));
            let (x, y) = (x?, y?);
            // R s has the components x cos φ − y sin φ and x sin φ + y cos φ.
            let components = [("x", [x, -y]), ("y", [y, x])];
            for (axis, [along, across]) in components {
                for (sign, factor) in [("", 1.0), ("minus_", -1.0)] {
                    if is_equal(cosine, factor * along) && is_equal(sine, factor * across) {
                        let [point, body] = [&mark.name, &body.name].map(|it| it.to_lowercase());
                        return Some(format!("{sign}{point}_{body}_{axis}"));
                    }
                }
            }
        }
    }
    None
}

/// Returns the constant factor of a term and its only other factor; `None` if there are several.
fn scaled(coefficient: f64, expr: ExprId, pool: &Pool) -> Option<(f64, ExprId)> {
    let graph = &pool.graph;
    let Node::Product(factors) = graph.node(expr) else {
        return Some((coefficient, expr));
    };
    let (mut value, mut base) = (coefficient, None);
    for factor in factors.iter() {
        if graph.is_constant(factor.base) {
            value *= graph
                .constant_value(factor.base)?
                .powf(factor.exponent.to_f64());
        } else if base.replace(factor.base).is_some() || factor.exponent.to_f64() != 1.0 {
            return None;
        }
    }
    Some((value, base?))
}

fn is_equal(first: f64, second: f64) -> bool {
    (first - second).abs() <= EQUALITY_TOLERANCE * second.abs()
}
