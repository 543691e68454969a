//! Tests choices: their simplification, derivatives and printed conditions.

use crate::expr::{Graph, Term};

#[test]
fn choices_collapse_where_nothing_is_left_to_choose() {
    let mut graph = Graph::new();
    let (x, y) = (graph.symbol("x"), graph.symbol("y"));
    let [x_value, y_value] = [x, y].map(|symbol| graph.variable(symbol));
    let (one, two) = (graph.one(), graph.integer(2));
    let condition = graph.subtract(x_value, two);
    assert_eq!(graph.choose(condition, y_value, y_value), y_value);
    assert_eq!(graph.choose(one, x_value, y_value), y_value);
    let negative = graph.negate(one);
    assert_eq!(graph.choose(negative, x_value, y_value), x_value);
    let choice = graph.choose(condition, x_value, y_value);
    // The inner choice is already decided.
    assert_eq!(graph.choose(condition, choice, one), {
        graph.choose(condition, x_value, one)
    });
    assert_eq!(graph.choose(condition, x_value, choice), choice);
    // Both arms are differentiated; arms without the symbol become zero.
    let (zero, derivative) = (graph.zero(), graph.derivative(choice, x));
    assert_eq!(derivative, graph.choose(condition, one, zero));
    let constant_arms = graph.choose(condition, one, two);
    assert_eq!(graph.derivative(constant_arms, x), zero);
    let whole = graph.floor(x_value);
    assert_eq!(graph.derivative(whole, x), zero);
    let five_halves = graph.rational(-5, 2);
    let floored = graph.floor(five_halves);
    assert_eq!(floored, graph.integer(-3));
    let undefined = graph.rational(1, 0);
    let choice = graph.choose(condition, undefined, one);
    assert!(!graph.is_finite(choice));
}

#[test]
fn conditions_are_written_without_negative_terms() {
    let mut graph = Graph::new();
    let [x, y] = ["x", "y"].map(|name| {
        let symbol = graph.symbol(name);
        graph.variable(symbol)
    });
    let two = graph.integer(2);
    let sides = |graph: &Graph, condition| {
        let comparison = graph.comparison(condition);
        let coefficients = |terms: &[Term]| -> Vec<(f64, usize)> {
            let pairs = terms
                .iter()
                .map(|it| (it.coefficient.to_f64(), it.expr.index()));
            pairs.collect()
        };
        (
            coefficients(&comparison.left),
            comparison.is_less,
            coefficients(&comparison.right),
        )
    };
    let (one, x_index, y_index) = (graph.one().index(), x.index(), y.index());
    let condition = graph.subtract(x, two);
    assert_eq!(
        sides(&graph, condition),
        (vec![(1.0, x_index)], true, vec![(2.0, one)])
    );
    let condition = graph.subtract(two, x);
    assert_eq!(
        sides(&graph, condition),
        (vec![(1.0, x_index)], false, vec![(2.0, one)])
    );
    let condition = graph.subtract(y, x);
    assert_eq!(
        sides(&graph, condition),
        (vec![(1.0, y_index)], true, vec![(1.0, x_index)])
    );
    assert_eq!(sides(&graph, x), (vec![(1.0, x_index)], true, vec![]));
}
