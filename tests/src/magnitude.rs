//! Magnitudes of expressions for given values of symbols: the sum of the absolute values of all terms, at every
//! depth.
//!
//! One rounding in an expression is of the size `ε · magnitude`, however much cancels. A sine or cosine of a computed
//! angle has the magnitude of the angle, since it moves by as much.

use linkwright_codegen::stages::expr::{ExprId, Factor, Graph, Node};

/// The value of each node in `order` (operands first), by the node's index; NaN for other nodes.
pub fn values(graph: &Graph, order: &[ExprId], symbols: &[f64]) -> Vec<f64> {
    let mut value = vec![f64::NAN; graph.node_count()];
    for &id in order {
        let of = |operand: &ExprId| value[operand.index()];
        value[id.index()] = match graph.node(id) {
            Node::Number(number) => number.to_f64(),
            Node::Pi => std::f64::consts::PI,
            Node::Symbol(symbol) => symbols[symbol.index()],
            Node::Sum(terms) => terms
                .iter()
                .map(|term| term.coefficient.to_f64() * of(&term.expr))
                .sum(),
            Node::Product(factors) => factors
                .iter()
                .map(|factor| of(&factor.base).powf(factor.exponent.to_f64()))
                .product(),
            Node::Sin(angle) => of(angle).sin(),
            Node::Cos(angle) => of(angle).cos(),
            Node::Atan2(y, x) => of(y).atan2(of(x)),
            Node::Exp(exponent) => of(exponent).exp(),
            Node::Ln(argument) => of(argument).ln(),
            Node::Spline {
                spline,
                order,
                argument,
            } => graph.spline_of(*spline).at(of(argument))[usize::from(*order)],
            Node::Floor(argument) => of(argument).floor(),
            Node::Choose {
                condition,
                below,
                otherwise,
            } => of(if of(condition) < 0.0 {
                below
            } else {
                otherwise
            }),
        };
    }
    value
}

/// The magnitude of each node that the roots need, by the node's index; NaN for other nodes.
///
/// # Panics
/// Where an elementary function other than sine, cosine and powers of what moves occurs: no mechanism that is tested with
/// magnitudes has one.
pub fn magnitudes(graph: &Graph, order: &[ExprId], symbols: &[f64]) -> Vec<f64> {
    let mut magnitude = vec![f64::NAN; graph.node_count()];
    let value = values(graph, order, symbols);
    for &id in order {
        let index = id.index();
        magnitude[index] = match graph.node(id) {
            Node::Number(_) | Node::Pi | Node::Symbol(_) => value[index].abs(),
            Node::Sum(terms) => terms
                .iter()
                .map(|term| term.coefficient.to_f64().abs() * magnitude[term.expr.index()])
                .sum(),
            Node::Product(factors) => factors
                .iter()
                .map(|factor| of_power(graph, factor, &value, &magnitude))
                .product(),
            Node::Sin(angle) => of_angle(graph, *angle, &value, &magnitude, f64::sin, f64::cos),
            Node::Cos(angle) => of_angle(graph, *angle, &value, &magnitude, f64::cos, f64::sin),
            Node::Atan2(..) if graph.is_fixed(id) => value[index].abs(),
            // Whole numbers are exact, unless the argument is so near to one that its rounding decides.
            Node::Floor(_) => value[index].abs(),
            Node::Choose {
                condition,
                below,
                otherwise,
            } => {
                let is_below = value[condition.index()] < 0.0;
                magnitude[if is_below { below } else { otherwise }.index()]
            }
            other => panic!("no magnitude of {other:?}"),
        };
    }
    magnitude
}

/// |bᵖ|, and what it moves by when the base moves by its magnitude.
fn of_power(graph: &Graph, factor: &Factor, value: &[f64], magnitude: &[f64]) -> f64 {
    let at = factor.base.index();
    let (base, exponent) = (value[at], factor.exponent.to_f64());
    if graph.is_fixed(factor.base) {
        return base.powf(exponent).abs();
    }
    if let Some(whole) = whole_exponent(exponent) {
        return magnitude[at].powi(whole);
    }
    let power = base.powf(exponent).abs();
    power * (1.0 + exponent.abs() * magnitude[at] / base.abs())
}

/// The nodes that the roots need, operands first.
pub fn needed(graph: &Graph, roots: &[ExprId]) -> Vec<ExprId> {
    let mut is_needed = vec![false; graph.node_count()];
    let mut order = Vec::new();
    let mut open = roots.to_vec();
    while let Some(id) = open.pop() {
        if std::mem::replace(&mut is_needed[id.index()], true) {
            continue;
        }
        order.push(id);
        open.extend(graph.operands(id));
    }
    order.sort_unstable();
    order
}

/// A positive whole exponent.
pub(crate) fn whole_exponent(exponent: f64) -> Option<i32> {
    (exponent >= 1.0 && exponent.fract() == 0.0).then_some(exponent as i32)
}

fn of_angle(
    graph: &Graph,
    angle: ExprId,
    value: &[f64],
    magnitude: &[f64],
    function: fn(f64) -> f64,
    slope: fn(f64) -> f64,
) -> f64 {
    let at = value[angle.index()];
    let computed = !matches!(graph.node(angle), Node::Symbol(_));
    let carried = if computed {
        slope(at).abs() * magnitude[angle.index()]
    } else {
        0.0
    };
    function(at).abs() + carried
}
