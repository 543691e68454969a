//! Tests the bounds of graphs: work of derivatives, depth of walks, and size.

use std::thread;

use super::generator::Generator;
use crate::expr::{Excess, ExprId, Graph, MAX_DEPTH, Number, SymbolId, Tape};

/// Returns the product of n sums x + k, or of n sines of kx.
fn product(graph: &mut Graph, x: ExprId, n: usize, sines: bool) -> ExprId {
    let factors: Vec<ExprId> = (1..=n as i64)
        .map(|k| {
            let k = graph.integer(k);
            if sines {
                let angle = graph.multiply(k, x);
                graph.sin(angle)
            } else {
                graph.add(x, k)
            }
        })
        .collect();
    graph.product(&factors)
}

/// Returns the number of terms and factors stored for two derivatives of such a product.
fn store_of_derivatives(n: usize, sines: bool) -> usize {
    let mut graph = Graph::new();
    let symbol = graph.symbol("x");
    let x = graph.variable(symbol);
    let product = product(&mut graph, x, n, sines);
    let before = graph.store();
    let first = graph.derivative(product, symbol);
    graph.derivative(first, symbol);
    graph.store() - before
}

#[test]
fn a_product_is_differentiated_twice_in_little_more_than_proportion() {
    for sines in [false, true] {
        let [short, long] = [100, 400].map(|n| store_of_derivatives(n, sines));
        // n log² n grows 6.8-fold, the product rule as it stands 64-fold.
        assert!(long < 8 * short, "{short} and {long}");
        assert!(short < 100 * 100, "{short}");
    }
}

#[test]
fn a_halved_derivative_has_the_value_of_the_product_rule() {
    let mut graph = Graph::new();
    let symbols: Vec<SymbolId> = ["x", "y"].map(|name| graph.symbol(name)).to_vec();
    let [x, y] = [symbols[0], symbols[1]].map(|symbol| graph.variable(symbol));
    for sines in [false, true] {
        let long = product(&mut graph, x, 30, sines);
        let factor = graph.sin(y);
        let whole = graph.multiply(long, factor);
        let expected = |at: f64, y: f64| {
            let factor = |k: f64| match sines {
                true => ((k * at).sin(), k * (k * at).cos()),
                false => (at + k, 1.0),
            };
            // Value and derivative, propagated together.
            let pair = (1..=30).fold((1.0, 0.0), |(value, slope), k| {
                let (factor, its_slope) = factor(f64::from(k));
                (value * factor, slope * factor + value * its_slope)
            });
            pair.1 * y.sin()
        };
        let derivative = graph.derivative(whole, symbols[0]);
        let tape = Tape::new(&graph, &[derivative]);
        for at in [0.1, 0.37, -0.21] {
            let mut value = [0.0];
            tape.evaluate(&[at, 0.6], &mut Vec::new(), &mut value);
            let expected = expected(at, 0.6);
            assert!(
                (value[0] - expected).abs() <= 1e-11 * expected.abs(),
                "{value:?} {expected}"
            );
        }
    }
}

/// Wraps an expression in one more level.
type Nest = fn(&mut Graph, ExprId) -> ExprId;

/// Functions that nest an expression in itself to any depth.
const NESTS: [(&str, Nest); 7] = [
    ("sin", Graph::sin),
    ("exp", |graph, x| {
        let minus = graph.negate(x);
        graph.exp(minus)
    }),
    ("ln", |graph, x| {
        let two = graph.integer(2);
        let sum = graph.add(x, two);
        graph.ln(sum)
    }),
    ("sqrt", |graph, x| {
        let one = graph.one();
        let sum = graph.add(x, one);
        graph.sqrt(sum)
    }),
    ("atan2", |graph, x| {
        let two = graph.integer(2);
        graph.atan2(x, two)
    }),
    ("floor", |graph, x| {
        let third = graph.rational(1, 3);
        let sum = graph.multiply(third, x);
        graph.floor(sum)
    }),
    ("choice", |graph, x| {
        let (one, zero) = (graph.one(), graph.zero());
        let condition = graph.subtract(x, one);
        let other = graph.sin(x);
        graph.choose(condition, other, zero)
    }),
];

#[test]
fn deep_nests_are_walked_on_a_small_stack() {
    let walk = || {
        for (name, nest) in NESTS {
            let mut graph = Graph::new();
            let [p, q] = ["p", "q"].map(|name| graph.symbol(name));
            let mut expr = graph.variable(p);
            while graph.depth(expr) < MAX_DEPTH - 8 {
                expr = nest(&mut graph, expr);
            }
            let nodes = graph.node_count();
            let derivative = graph.derivative(expr, p);
            assert!(graph.is_finite(derivative), "{name}");
            let other = graph.variable(q);
            let replaced = graph.substitute(expr, &[(p, other)]);
            assert_eq!(graph.depth(replaced), graph.depth(expr), "{name}");
            assert!(graph.node_count() < 20 * nodes, "{name}");
            assert!(graph.written_length(derivative) > 0, "{name}");
        }
    };
    // The stack is too small for a recursion through all levels in a debug build.
    let builder = thread::Builder::new().stack_size(192 * 1024);
    let handle = builder.spawn(walk).expect("a thread");
    handle.join().expect("no overflow");
}

#[test]
fn measures_shared_parts_without_expansion() {
    let mut graph = Graph::new();
    let symbol = graph.symbol("p");
    let mut expr = graph.variable(symbol);
    for _ in 0..60 {
        let (sine, cosine) = (graph.sin(expr), graph.cos(expr));
        let product = graph.multiply(sine, cosine);
        expr = graph.add(product, expr);
    }
    assert!(graph.node_count() < 300, "{}", graph.node_count());
    assert!(graph.written_length(expr) > 1 << 60);
    let derivative = graph.derivative(expr, symbol);
    assert!(graph.is_finite(derivative));
    assert!(graph.node_count() < 1500, "{}", graph.node_count());
}

#[test]
fn reports_excessive_depth() {
    let mut graph = Graph::new();
    let symbol = graph.symbol("x");
    let mut expr = graph.variable(symbol);
    for _ in 0..MAX_DEPTH {
        expr = graph.sin(expr);
    }
    assert!(graph.is_finite(expr) && graph.excess().is_none());
    let deeper = graph.sin(expr);
    assert!(!graph.is_finite(deeper));
    assert_eq!(graph.excess(), Some(Excess::Depth));
    // Earlier expressions remain valid.
    assert!(graph.is_finite(expr));
}

#[test]
fn reports_excessive_size() {
    let mut graph = Graph::new();
    graph.limit(1000, usize::MAX);
    let mut expr = graph.zero();
    for k in 0..100 {
        let symbol = graph.symbol(&format!("x{k}"));
        let variable = graph.variable(symbol);
        expr = graph.add(expr, variable);
    }
    assert!(!graph.is_finite(expr));
    assert_eq!(graph.excess(), Some(Excess::Size));
    assert!(graph.store() < 1500, "{}", graph.store());
    let mut graph = Graph::new();
    graph.spend(usize::MAX);
    assert_eq!(graph.excess(), Some(Excess::Size));
}

/// Returns the total work of the derivatives of a sum of n terms by each of its n symbols.
fn work_of_gradient(n: usize) -> usize {
    let mut graph = Graph::new();
    let symbols: Vec<SymbolId> = (0..n).map(|k| graph.symbol(&format!("x{k}"))).collect();
    let terms: Vec<ExprId> = symbols
        .iter()
        .map(|&symbol| {
            let variable = graph.variable(symbol);
            graph.sin(variable)
        })
        .collect();
    let sum = graph.sum(&terms);
    let before = graph.work();
    for symbol in symbols {
        graph.derivative(sum, symbol);
    }
    graph.work() - before
}

#[test]
fn a_long_sum_is_differentiated_by_all_its_symbols_in_proportion() {
    let [short, long] = [500, 2000].map(work_of_gradient);
    assert!(long <= 5 * short, "{short} and {long}");
}

#[test]
fn surds_of_products_are_free_of_squares_as_if_factored_anew() {
    let mut generator = Generator::new(0x5ad5);
    let surd = |generator: &mut Generator| {
        let under = 1 + generator.below(1 << 20);
        Number::surd(crate::expr::Rational::ONE, u128::from(under))
    };
    for _ in 0..2000 {
        let (a, b) = (surd(&mut generator), surd(&mut generator));
        let Number::Exact { rational, radicand } = a.mul(b) else {
            panic!("{a:?} and {b:?} are short");
        };
        assert_eq!(a.mul(b), Number::surd(rational, radicand), "{a:?} {b:?}");
    }
}

#[test]
fn a_length_is_looked_at_up_to_its_limit() {
    let mut graph = Graph::new();
    let symbol = graph.symbol("x");
    let x = graph.variable(symbol);
    let mut expr = x;
    let mut within = Vec::new();
    for _ in 0..200 {
        let (sine, cosine) = (graph.sin(expr), graph.cos(expr));
        expr = graph.multiply(sine, cosine);
        let length = graph.written_length(expr);
        for limit in [10, 100, 1000] {
            assert_eq!(graph.is_written_within(expr, limit), length <= limit);
        }
        within.push(graph.is_written_within(expr, 1000));
    }
    assert!(within[0] && !within[199]);
    // With a name for its operand, the expression is short again.
    let inner = graph.operands(expr)[0];
    assert!(graph.is_within_with_names(expr, 40, &|part| graph.operands(inner).contains(&part)));
}
