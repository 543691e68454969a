//! Tests exact values and undefined expressions.

use crate::expr::{ExprId, Graph, Number, Rational};

/// Returns the sum of `numerator/denominator · √radicand` over all entries.
fn surds(graph: &mut Graph, parts: &[(i64, i64, i64)]) -> ExprId {
    let parts: Vec<ExprId> = parts
        .iter()
        .map(|&(numerator, denominator, radicand)| {
            let under = graph.integer(radicand);
            let (scale, root) = (graph.rational(numerator, denominator), graph.sqrt(under));
            graph.multiply(scale, root)
        })
        .collect();
    graph.sum(&parts)
}

fn turn(graph: &mut Graph, twelfths: i64) -> ExprId {
    let (part, pi) = (graph.rational(twelfths, 12), graph.pi());
    graph.multiply(part, pi)
}

#[test]
fn multiples_of_a_twelfth_of_pi_have_exact_sines_and_cosines() {
    let table: [&[(i64, i64, i64)]; 7] = [
        &[],
        &[(1, 4, 6), (-1, 4, 2)],
        &[(1, 2, 1)],
        &[(1, 2, 2)],
        &[(1, 2, 3)],
        &[(1, 4, 6), (1, 4, 2)],
        &[(1, 1, 1)],
    ];
    let mut graph = Graph::new();
    for twelfths in -60i64..=60 {
        let angle = turn(&mut graph, twelfths);
        for (function, phase) in [
            (Graph::sin as fn(&mut Graph, ExprId) -> ExprId, 0),
            (Graph::cos, 6),
        ] {
            // Reduced to the first quadrant by hand: sin(π - u) = sin u and sin(u + π) = -sin u.
            let around = (twelfths + phase).rem_euclid(24);
            let half = around % 12;
            let magnitude = surds(&mut graph, table[half.min(12 - half) as usize]);
            let expected = if around >= 12 {
                graph.negate(magnitude)
            } else {
                magnitude
            };
            assert_eq!(
                function(&mut graph, angle),
                expected,
                "{twelfths} π/12, phase {phase}"
            );
        }
    }
}

#[test]
fn directions_of_constant_vectors_are_exact() {
    let mut graph = Graph::new();
    // (x, y) as numerators over 2 with their radicands, and the angle in twelfths of π.
    let vectors = [
        ((1, 1), (0, 1), 0),
        ((1, 3), (1, 1), 2),
        ((1, 1), (1, 1), 3),
        ((1, 2), (1, 2), 3),
        ((1, 1), (1, 3), 4),
        ((0, 1), (5, 1), 6),
        ((-1, 1), (1, 3), 8),
        ((-2, 1), (2, 1), 9),
        ((-1, 3), (1, 1), 10),
        ((-7, 1), (0, 1), 12),
        ((-1, 1), (-1, 1), -9),
        ((0, 1), (-1, 1), -6),
        ((1, 1), (-1, 3), -4),
    ];
    for ((x, x_under), (y, y_under), twelfths) in vectors {
        let (x, y) = (
            surds(&mut graph, &[(x, 2, x_under)]),
            surds(&mut graph, &[(y, 2, y_under)]),
        );
        let expected = turn(&mut graph, twelfths);
        let angle = graph.atan2(y, x);
        assert_eq!(angle, expected, "{twelfths} π/12");
    }
    let [three, four, six, eight] = [3, 4, 6, 8].map(|value| graph.integer(value));
    let direction = graph.atan2(three, four);
    assert_eq!(direction, graph.atan2(six, eight));
    let three_fifths = graph.rational(3, 5);
    assert_eq!(graph.sin(direction), three_fifths);
    let four_fifths = graph.rational(4, 5);
    assert_eq!(graph.cos(direction), four_fifths);
    let opposite = graph.negate(direction);
    let minus = graph.negate(three_fifths);
    assert_eq!(graph.sin(opposite), minus);
    let quarter = turn(&mut graph, 6);
    let turned = graph.add(direction, quarter);
    assert_eq!(graph.sin(turned), four_fifths);
    assert_eq!(graph.cos(turned), minus);
}

#[test]
fn inverse_functions_have_exact_values() {
    let mut graph = Graph::new();
    let half = graph.rational(1, 2);
    let minus_half = graph.rational(-1, 2);
    let one = graph.one();
    let sixth = turn(&mut graph, 2);
    assert_eq!(graph.asin(half), sixth);
    let two_thirds = turn(&mut graph, 8);
    assert_eq!(graph.acos(minus_half), two_thirds);
    let quarter = turn(&mut graph, 3);
    assert_eq!(graph.atan(one), quarter);
    assert_eq!(graph.tan(quarter), one);
    let third = turn(&mut graph, 4);
    let root = surds(&mut graph, &[(1, 1, 3)]);
    assert_eq!(graph.tan(third), root);
    let two = graph.integer(2);
    let beyond = graph.asin(two);
    assert!(!graph.is_finite(beyond));
    let symbol = graph.symbol("x");
    let x = graph.variable(symbol);
    let arc = graph.asin(x);
    assert_eq!(graph.sin(arc), x);
    let arc = graph.acos(x);
    assert_eq!(graph.cos(arc), x);
    let arc = graph.atan(x);
    assert_eq!(graph.tan(arc), x);
    let logarithm = graph.ln(x);
    let exponential = graph.exp(x);
    assert_eq!(graph.ln(exponential), x);
    assert_ne!(graph.exp(logarithm), x);
    let zero = graph.zero();
    assert_eq!(graph.exp(zero), one);
    assert_eq!(graph.ln(one), zero);
    let eight = graph.integer(8);
    let third = graph.rational(1, 3);
    assert_eq!(graph.raise(eight, third), two);
    let logarithm = graph.ln(eight);
    assert_eq!(graph.exp(logarithm), eight);
    let power = graph.raise(two, x);
    assert_eq!(graph.symbols(power), &[symbol]);
}

#[test]
fn keeps_undefined_expressions() {
    let mut graph = Graph::new();
    let symbol = graph.symbol("x");
    let x = graph.variable(symbol);
    let (zero, one) = (graph.zero(), graph.one());
    let minus_one = graph.integer(-1);
    let pole = graph.divide(one, zero);
    let root = graph.sqrt(minus_one);
    let direction = graph.atan2(zero, zero);
    let logarithm = graph.ln(zero);
    let negative = graph.ln(minus_one);
    let right_angle = turn(&mut graph, 6);
    let tangent = graph.tan(right_angle);
    let fraction = graph.rational(1, 0);
    let number = graph.number(Number::Float(f64::NEG_INFINITY));
    let two = Rational::integer(2);
    for undefined in [
        pole, root, direction, logarithm, negative, tangent, fraction, number,
    ] {
        assert!(!graph.is_finite(undefined));
        let difference = graph.subtract(undefined, undefined);
        let product = graph.multiply(zero, undefined);
        let other_product = graph.multiply(undefined, x);
        let sum = graph.sum(&[x, undefined]);
        let quotient = graph.divide(x, undefined);
        let power = graph.power(undefined, Rational::ZERO);
        let square = graph.power(undefined, two);
        let angle = graph.atan2(x, undefined);
        let derivative = graph.derivative(undefined, symbol);
        let functions = [
            Graph::sin,
            Graph::cos,
            Graph::tan,
            Graph::exp,
            Graph::ln,
            Graph::asin,
            Graph::acos,
            Graph::atan,
            Graph::sqrt,
            Graph::negate,
        ]
        .map(|function: fn(&mut Graph, ExprId) -> ExprId| function(&mut graph, undefined));
        for built in [
            difference,
            product,
            other_product,
            sum,
            quotient,
            power,
            square,
            angle,
            derivative,
        ] {
            assert!(
                !graph.is_finite(built),
                "{:?} {:?}",
                graph.node(undefined),
                graph.node(built)
            );
        }
        assert!(functions.iter().all(|&built| !graph.is_finite(built)));
        let reciprocal = graph.power(x, -Rational::ONE);
        let cosine = graph.cos(reciprocal);
        for expr in [reciprocal, cosine, x] {
            let replaced = graph.substitute(expr, &[(symbol, undefined)]);
            assert!(!graph.is_finite(replaced));
        }
    }
    let reciprocal = graph.power(x, -Rational::ONE);
    let replaced = graph.substitute(reciprocal, &[(symbol, zero)]);
    assert!(!graph.is_finite(replaced));
    assert_eq!(graph.multiply(zero, reciprocal), zero);
}

#[test]
fn overflow_leaves_exactness_but_not_the_value() {
    let mut graph = Graph::new();
    let symbol = graph.symbol("x");
    let x = graph.variable(symbol);
    let large = graph.integer(i64::MAX);
    let mut expr = x;
    for _ in 0..6 {
        let product = graph.multiply(expr, large);
        expr = graph.add(product, large);
    }
    let value = (0..6).fold(1.0, |value, _| (value + 1.0) * i64::MAX as f64);
    let at_one = graph.substitute(expr, &[(symbol, graph.one())]);
    let computed = graph.constant_value(at_one).expect("a constant");
    assert!(
        (computed - value).abs() <= 1e-13 * value,
        "{computed} {value}"
    );
    assert!(graph.is_finite(expr));
    let small = graph.number(Number::Float(1e-300));
    let squared = graph.multiply(small, small);
    assert_eq!(squared, graph.zero());
    let mut power = x;
    for _ in 0..200 {
        power = graph.multiply(power, power);
    }
    // x^(2^127) has an exponent that a fraction does not hold.
    assert!(!graph.is_finite(power));
}

#[test]
fn constants_are_known_as_such() {
    let mut graph = Graph::new();
    let symbol = graph.symbol("x");
    let x = graph.variable(symbol);
    let (one, pi) = (graph.one(), graph.pi());
    let root = surds(&mut graph, &[(1, 1, 3), (1, 2, 1)]);
    let constant = graph.multiply(root, pi);
    assert!(graph.is_constant(constant));
    let expected = (3f64.sqrt() + 0.5) * std::f64::consts::PI;
    let computed = graph.constant_value(constant).expect("a constant");
    assert!((computed - expected).abs() <= 4.0 * f64::EPSILON * expected);
    let expr = graph.add(x, one);
    assert_eq!(graph.constant_value(expr), None);
    assert_eq!(graph.symbol("x"), symbol);
    assert_eq!(graph.symbol_name(symbol), "x");
}
