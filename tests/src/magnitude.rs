//! *Expressions and values of their symbols* → *the size of what each is made of*: the sum of the absolute values of all
//! terms, at every depth. `ε · magnitude` is the size of one rounding in it, however much cancels.
//!
//! A sine or cosine of an angle that is itself computed carries the magnitude of the angle, as it moves by as much.

use linkwright_codegen::expr::{ExprId, Graph, Node};

/// The magnitude of each node that the roots need, by the node's index; NaN for other nodes.
///
/// # Panics
/// Where a power is not a positive whole one of an expression with symbols, or an elementary function other than sine and
/// cosine of what moves occurs: no mechanism of the repository needs them.
pub fn magnitudes(graph: &Graph, order: &[ExprId], symbols: &[f64]) -> Vec<f64> {
    let mut magnitude = vec![f64::NAN; graph.node_count()];
    let mut value = vec![f64::NAN; graph.node_count()];
    for &id in order {
        let index = id.index();
        (value[index], magnitude[index]) = match graph.node(id) {
            Node::Number(number) => (number.to_f64(), number.to_f64().abs()),
            Node::Pi => (std::f64::consts::PI, std::f64::consts::PI),
            Node::Symbol(symbol) => (symbols[symbol.index()], symbols[symbol.index()].abs()),
            Node::Sum(terms) => terms.iter().fold((0.0, 0.0), |(sum, size), term| {
                let coefficient = term.coefficient.to_f64();
                let at = term.expr.index();
                (
                    sum + coefficient * value[at],
                    size + coefficient.abs() * magnitude[at],
                )
            }),
            Node::Product(factors) => factors.iter().fold((1.0, 1.0), |(product, size), factor| {
                let at = factor.base.index();
                let exponent = factor.exponent.to_f64();
                if let Some(constant) = graph.constant_value(factor.base) {
                    let power = constant.powf(exponent);
                    return (product * power, size * power.abs());
                }
                let whole = whole_exponent(exponent);
                (
                    product * value[at].powi(whole),
                    size * magnitude[at].powi(whole),
                )
            }),
            Node::Sin(angle) => of_angle(graph, *angle, &value, &magnitude, f64::sin, f64::cos),
            Node::Cos(angle) => of_angle(graph, *angle, &value, &magnitude, f64::cos, f64::sin),
            Node::Atan2(y, x) if graph.is_constant(id) => {
                let angle = value[y.index()].atan2(value[x.index()]);
                (angle, angle.abs())
            }
            Node::Choose {
                condition,
                below,
                otherwise,
            } => {
                let is_below = value[condition.index()] < 0.0;
                let chosen = if is_below { below } else { otherwise }.index();
                (value[chosen], magnitude[chosen])
            }
            other => panic!("no magnitude of {other:?}"),
        };
    }
    magnitude
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

/// The exponent of an expression with symbols.
pub(crate) fn whole_exponent(exponent: f64) -> i32 {
    assert!(
        exponent >= 1.0 && exponent.fract() == 0.0,
        "the exponent {exponent} is not covered"
    );
    exponent as i32
}

fn of_angle(
    graph: &Graph,
    angle: ExprId,
    value: &[f64],
    magnitude: &[f64],
    function: fn(f64) -> f64,
    slope: fn(f64) -> f64,
) -> (f64, f64) {
    let at = value[angle.index()];
    let computed = !matches!(graph.node(angle), Node::Symbol(_));
    let carried = if computed {
        slope(at).abs() * magnitude[angle.index()]
    } else {
        0.0
    };
    (function(at), function(at).abs() + carried)
}
