//! Tests derivatives of quotients by roots far from zero, where the terms of the product rule almost cancel.

use super::super::{ExprId, Graph, Rational, SymbolId, Tape};

/// Maximum relative error: some roundings.
const ROUNDINGS: f64 = 1e-14;

fn value(graph: &Graph, expr: ExprId, values: &[f64]) -> f64 {
    let mut result = [0.0];
    Tape::new(graph, &[expr]).evaluate(values, &mut Vec::new(), &mut result);
    result[0]
}

/// Returns b·(c + b^power)^(-1/power).
fn quotient(graph: &mut Graph, b: ExprId, c: ExprId, power: i64) -> ExprId {
    let power = Rational::integer(power);
    let raised = graph.power(b, power);
    let sum = graph.add(c, raised);
    let root = graph.power(sum, -power.reciprocal().expect("not zero"));
    graph.multiply(b, root)
}

/// Checks c·(c + x^n)^(-1 - 1/n) and its derivative, -(n + 1)·c·x^(n - 1)·(c + x^n)^(-2 - 1/n).
#[test]
fn rates_of_quotients_by_roots_keep_their_digits() {
    for power in [2, 3, 4] {
        let mut graph = Graph::new();
        let [x, y] = ["x", "y"].map(|it| graph.symbol(it));
        let [b, c] = [x, y].map(|it: SymbolId| graph.variable(it));
        let quotient = quotient(&mut graph, b, c, power);
        let first = graph.derivative(quotient, x);
        let second = graph.derivative(first, x);
        let order = power as f64;
        for (x, c) in [(1e8, 1.0), (3e5, 2.5), (0.7, 1.0), (1e-9, 4.0)] {
            let sum = c + f64::powf(x, order);
            let expected = [
                c * sum.powf(-1.0 - 1.0 / order),
                -(order + 1.0) * c * f64::powf(x, order - 1.0) * sum.powf(-2.0 - 1.0 / order),
            ];
            for (derivative, expected) in [first, second].into_iter().zip(expected) {
                let computed = value(&graph, derivative, &[x, c]);
                let off = (computed / expected - 1.0).abs();
                assert!(off < ROUNDINGS, "{power}, {x}: {computed} {expected}");
            }
        }
    }
}

/// Checks x·z/√(1 + x²·z²) for an inner formula z = sin x: (sin x + x·cos x)·(1 + x²·sin²x)^(-3/2).
#[test]
fn the_numerator_may_be_a_product() {
    let mut graph = Graph::new();
    let x = graph.symbol("x");
    let b = graph.variable(x);
    let sine = graph.sin(b);
    let product = graph.multiply(b, sine);
    let one = graph.one();
    let quotient = quotient(&mut graph, product, one, 2);
    let derivative = graph.derivative(quotient, x);
    for x in [1e7_f64, 2e4, 0.3] {
        let product = x * x.sin();
        let expected = (x.sin() + x * x.cos()) * (1.0 + product * product).powf(-1.5);
        let computed = value(&graph, derivative, &[x]);
        assert!(
            (computed / expected - 1.0).abs() < ROUNDINGS,
            "{x}: {computed} {expected}"
        );
    }
}
