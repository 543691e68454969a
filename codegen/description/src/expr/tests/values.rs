//! Tests values of fixed expressions, and undefined constants.

use super::generator::Generator;
use super::tree::{SYMBOLS, Tree};
use crate::expr::{Graph, Number, Rational, Tape};

#[test]
fn a_value_is_that_of_a_tape_also_after_a_nominal_value_has_changed() {
    let mut generator = Generator::new(0x7a1e);
    let mut compared = 0;
    for round in 0..1500 {
        let mut graph = Graph::new();
        let symbols: Vec<_> = (0..SYMBOLS)
            .map(|place| graph.symbol(&format!("p{place}")))
            .collect();
        let mut values = vec![0.0; SYMBOLS];
        for (&symbol, value) in symbols.iter().zip(&mut values) {
            *value = generator.uniform(-2.0, 2.0);
            graph.set_nominal(symbol, *value);
        }
        let tree = Tree::random(&mut generator, 5);
        let expr = tree.build(&mut graph, &symbols);
        if !graph.is_finite(expr) {
            continue;
        }
        for changed in 0..2 {
            if changed == 1 {
                values[0] = generator.uniform(-2.0, 2.0);
                graph.set_nominal(symbols[0], values[0]);
            }
            let mut taped = [0.0];
            Tape::new(&graph, &[expr]).evaluate(&values, &mut Vec::new(), &mut taped);
            let known = graph.constant_value(expr).expect("a fixed expression");
            if taped[0].is_finite() {
                compared += 1;
                assert_eq!(
                    known.to_bits(),
                    taped[0].to_bits(),
                    "round {round}: {tree:?}"
                );
            } else {
                assert!(!graph.is_sound(expr), "round {round}: {tree:?}");
            }
        }
    }
    assert!(compared > 1500, "{compared}");
}

#[test]
fn constants_that_leave_the_range_of_numbers_are_undefined() {
    let mut graph = Graph::new();
    let x = graph.symbol("x");
    let x = graph.variable(x);
    let number = |graph: &mut Graph, value: f64| graph.number(Number::Float(value));
    let large = number(&mut graph, 1e200);
    let exponent = graph.integer(500);
    let power = graph.exp(exponent);
    assert!(graph.is_finite(large) && graph.is_finite(power));
    let products = [
        graph.multiply(large, large),
        graph.multiply(power, power),
        graph.power(power, Rational::integer(2)),
        graph.product(&[power, power, x]),
        graph.product(&[large, power, x]),
    ];
    assert!(products.iter().all(|&it| !graph.is_finite(it)));
    let inverse = graph.power(power, -Rational::ONE);
    let smaller = graph.product(&[inverse, inverse, x]);
    assert!(!graph.is_finite(smaller), "divided by infinity");
    // Terms beside a moving one.
    let huge = number(&mut graph, 1.7e308);
    let root = graph.rational(3, 1);
    let root = graph.sqrt(root);
    let other = graph.multiply(huge, root);
    assert!(!graph.is_finite(other));
    let logarithm = graph.integer(709);
    let almost = graph.exp(logarithm);
    let scaled = graph.scale(Number::integer(2), almost);
    let sum = graph.sum(&[scaled, huge, x]);
    assert!(graph.is_finite(scaled) && !graph.is_finite(sum));
    // A subnormal number has no reciprocal.
    let tiny = number(&mut graph, 1e-310);
    let reciprocal = graph.divide(x, tiny);
    assert!(!graph.is_finite(reciprocal));
    let cosine = graph.integer(2);
    let cosine = graph.cos(cosine);
    let root = graph.sqrt(cosine);
    assert!(!graph.is_finite(root), "the root of a negative constant");
}

#[test]
fn parameters_make_an_expression_unsound_but_leave_it() {
    let mut graph = Graph::new();
    let [p, x] = ["p", "x"].map(|name| graph.symbol(name));
    graph.set_nominal(p, 0.0);
    let [fixed, moving] = [p, x].map(|symbol| graph.variable(symbol));
    let reciprocal = graph.divide(moving, fixed);
    let sum = graph.add(reciprocal, moving);
    for expr in [reciprocal, sum] {
        assert!(graph.is_finite(expr) && !graph.is_sound(expr));
    }
    assert!(graph.is_sound(moving));
    graph.set_nominal(p, 2.0);
    assert!(graph.is_sound(sum));
}

#[test]
fn magnitudes_are_those_of_the_constants_as_they_are_written_out() {
    let mut graph = Graph::new();
    let x = graph.symbol("x");
    let x = graph.variable(x);
    let [small, large] = [1e-30, 1e25].map(|value| graph.number(Number::Float(value)));
    let sine = graph.sin(x);
    let one = graph.one();
    let angle = graph.cos(one);
    let parts = [
        graph.multiply(small, sine),
        graph.product(&[large, angle, x]),
        graph.multiply(x, sine),
    ];
    let sum = graph.sum(&parts);
    let magnitudes = graph.magnitudes(&[sum]);
    assert_eq!(magnitudes.least, 1e-30);
    assert!((magnitudes.largest - 1e25 * 1.0_f64.cos()).abs() < 1e10);
    assert_eq!(graph.magnitudes(&[x]).largest, 0.0);
}
