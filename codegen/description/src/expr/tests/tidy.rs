//! Tests shorter forms of constants: equal values, with zeros and ones as in the design configuration.

use super::generator::Generator;
use super::tree::{SYMBOLS, Tree, evaluate_node};
use crate::expr::{ExprId, Graph, Rational};

/// Returns numbers that no rule reduces to one another.
fn constants(graph: &mut Graph) -> Vec<ExprId> {
    let angle = graph.rational(7, 10);
    let three = graph.integer(3);
    let decimal = graph.rational(3, 8);
    let all = [
        graph.cos(angle),
        graph.sin(angle),
        graph.sqrt(three),
        decimal,
    ];
    all.into_iter().cycle().take(SYMBOLS).collect()
}

#[test]
fn a_shorter_form_has_the_same_value() {
    let mut generator = Generator::new(0x71d7);
    let (mut compared, mut shorter) = (0, 0);
    for round in 0..4000 {
        let mut graph = Graph::new();
        let symbols: Vec<_> = (0..SYMBOLS)
            .map(|place| graph.symbol(&format!("x{place}")))
            .collect();
        let tree = Tree::random(&mut generator, 5);
        let written = tree.build(&mut graph, &symbols);
        let constants = constants(&mut graph);
        let replacements: Vec<_> = symbols.into_iter().zip(constants).collect();
        let expr = graph.substitute(written, &replacements);
        if !graph.is_finite(expr) || !graph.is_constant(expr) {
            continue;
        }
        let short = graph.tidied(expr);
        assert!(graph.written_length(short) <= graph.written_length(expr));
        let [before, after] = [expr, short].map(|it| evaluate_node(&graph, it, &[]));
        if !before.is_reliable() || !after.is_reliable() {
            continue;
        }
        compared += 1;
        shorter += usize::from(short != expr);
        assert!(
            after.agrees(before),
            "round {round}: {tree:?}: {before:?} and {after:?}"
        );
    }
    assert!(compared > 1500 && shorter > 50, "{compared}, {shorter}");
}

/// Returns (x, y) rotated by an angle without an exact value.
fn turned(graph: &mut Graph, x: (i64, i64), y: (i64, i64)) -> [ExprId; 2] {
    let angle = graph.rational(7, 10);
    let (sine, cosine) = (graph.sin(angle), graph.cos(angle));
    let [x, y] = [x, y].map(|(above, below)| graph.rational(above, below));
    let parts = [
        graph.multiply(cosine, x),
        graph.multiply(sine, y),
        graph.multiply(sine, x),
        graph.multiply(cosine, y),
    ];
    [
        graph.subtract(parts[0], parts[1]),
        graph.add(parts[2], parts[3]),
    ]
}

fn dot(graph: &mut Graph, a: [ExprId; 2], b: [ExprId; 2]) -> ExprId {
    let parts = [0, 1].map(|axis| graph.multiply(a[axis], b[axis]));
    graph.sum(&parts)
}

fn unit(graph: &mut Graph, a: [ExprId; 2]) -> [ExprId; 2] {
    let square = dot(graph, a, a);
    let length = graph.sqrt(square);
    a.map(|part| graph.divide(part, length))
}

#[test]
fn lengths_and_products_of_turned_vectors_are_those_before_they_were_turned() {
    let mut graph = Graph::new();
    let a = turned(&mut graph, (3, 10), (2, 5));
    let b = turned(&mut graph, (4, 5), (-3, 5));
    let square = dot(&mut graph, a, a);
    assert_eq!(graph.tidied(square), graph.rational(1, 4));
    let across = dot(&mut graph, a, b);
    assert_eq!(graph.tidied(across), graph.zero());
    let along = [graph.negate(b[1]), b[0]];
    let along = dot(&mut graph, a, along);
    assert_eq!(graph.tidied(along), graph.rational(1, 2));
}

#[test]
fn unit_vectors_have_the_length_one() {
    let mut graph = Graph::new();
    // (0.15·cos 0.7, 0.3 + 0.15·sin 0.7): the length has no shorter form.
    let angle = graph.rational(7, 10);
    let (sine, cosine) = (graph.sin(angle), graph.cos(angle));
    let share = graph.rational(3, 20);
    let offset = graph.rational(3, 10);
    let across = graph.multiply(share, sine);
    let gap = [graph.multiply(share, cosine), graph.add(offset, across)];
    let direction = unit(&mut graph, gap);
    let square = dot(&mut graph, direction, direction);
    assert_eq!(graph.tidied(square), graph.one());
    let again = unit(&mut graph, direction);
    assert_eq!(
        again.map(|part| graph.tidied(part)),
        direction.map(|part| graph.tidied(part))
    );
    // The same direction from a gap three times as long.
    let three = graph.integer(3);
    let longer = gap.map(|part| graph.multiply(three, part));
    let other = unit(&mut graph, longer);
    let along = dot(&mut graph, direction, other);
    assert!((graph.constant_value(along).expect("a constant") - 1.0).abs() < 1e-15);
    let cross = [
        graph.multiply(direction[0], other[1]),
        graph.multiply(direction[1], other[0]),
    ];
    let cross = graph.subtract(cross[0], cross[1]);
    assert_eq!(graph.tidied(cross), graph.zero());
}

#[test]
fn keeps_moving_and_short_expressions() {
    let mut graph = Graph::new();
    let symbol = graph.symbol("x");
    let x = graph.variable(symbol);
    let one = graph.one();
    let sum = graph.add(x, one);
    let square = graph.power(sum, Rational::integer(2));
    assert_eq!(graph.tidied(square), square);
    // (√2 + √3 + √5)·(√7 + √11 + √13) has nine terms after expansion.
    let root = |graph: &mut Graph, value: i64| {
        let value = graph.integer(value);
        graph.sqrt(value)
    };
    let roots = [2, 3, 5, 7, 11, 13].map(|value| root(&mut graph, value));
    let sums = [graph.sum(&roots[..3]), graph.sum(&roots[3..])];
    let product = graph.multiply(sums[0], sums[1]);
    assert_eq!(graph.tidied(product), product);
    // (1 + √3)² has two terms.
    let sum = graph.add(one, roots[1]);
    let square = graph.power(sum, Rational::integer(2));
    let tidied = graph.tidied(square);
    assert!(graph.written_length(tidied) < graph.written_length(square) || tidied == square);
}

#[test]
fn a_person_writes_short_constants_exactly() {
    let mut graph = Graph::new();
    let three = graph.integer(3);
    let root = graph.sqrt(three);
    let half = graph.rational(1, 2);
    let short = graph.multiply(half, root);
    assert!(graph.is_short(short));
    assert_eq!(graph.written_length(three), 1);
    let decimal = graph.rational(123, 1000);
    assert_eq!(graph.written_length(decimal), "0.123".len() as u64);
    // √1.591033601168736331263696128561: a fraction of a root of 31 digits.
    let number = crate::expr::Number::parse("1.591033601168736331263696128561");
    let number = graph.number(number.expect("a decimal"));
    let long = graph.sqrt(number);
    assert!(!graph.is_short(long), "{}", graph.written_length(long));
}

#[test]
fn arctangents_that_add_up_to_a_known_direction_show_it() {
    let mut graph = Graph::new();
    let [one, two] = [1, 2].map(|k| graph.integer(k));
    let back = graph.integer(-1);
    // (1, 2) and its mirror image at the y axis.
    let angles = [graph.atan2(two, back), graph.atan2(two, one)];
    let half_turn = graph.sum(&angles);
    let (cosine, sine) = (graph.cos(half_turn), graph.sin(half_turn));
    assert_eq!(graph.tidied(cosine), back);
    assert_eq!(graph.tidied(sine), graph.zero());
    let opening = graph.subtract(angles[0], angles[1]);
    let cosine = graph.cos(opening);
    assert_eq!(graph.tidied(cosine), graph.rational(3, 5));
}
