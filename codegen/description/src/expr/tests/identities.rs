//! Tests random expressions: simplified against written value, derivative against two independent ones, tape against recursion,
//! and substitution against evaluation.

use super::generator::Generator;
use super::tree::{SYMBOLS, Tree, evaluate_node};
use crate::expr::{ExprId, Graph, Recorder, SymbolId, Tape};

const SEED: u64 = 0x11d9_e0f4;
const TREES: usize = 6000;

fn symbols(graph: &mut Graph) -> Vec<SymbolId> {
    (0..SYMBOLS)
        .map(|place| graph.symbol(&format!("x{place}")))
        .collect()
}

fn point(generator: &mut Generator) -> Vec<f64> {
    (0..SYMBOLS).map(|_| generator.uniform(-2.0, 2.0)).collect()
}

fn value(graph: &Graph, expr: ExprId, values: &[f64]) -> f64 {
    let mut result = [0.0];
    Tape::new(graph, &[expr]).evaluate(values, &mut Vec::new(), &mut result);
    result[0]
}

#[test]
fn a_simplified_expression_has_the_value_as_written() {
    let mut generator = Generator::new(SEED);
    let mut compared = 0;
    for round in 0..TREES {
        let mut graph = Graph::new();
        let names = symbols(&mut graph);
        let tree = Tree::random(&mut generator, 5);
        let expr = tree.build(&mut graph, &names);
        for _ in 0..4 {
            let values = point(&mut generator);
            let written = tree.evaluate(&values, 0).value;
            if !written.is_reliable() {
                continue;
            }
            let simplified = evaluate_node(&graph, expr, &values);
            if simplified.error.is_infinite() && simplified.value.is_finite() {
                continue;
            }
            compared += 1;
            assert!(
                simplified.agrees(written),
                "seed {SEED:#x}, round {round}: {tree:?} at {values:?} is {written:?}, simplified {simplified:?}"
            );
            let taped = value(&graph, expr, &values);
            assert!(
                (taped - simplified.value).abs() <= simplified.error,
                "seed {SEED:#x}, round {round}: {tree:?} at {values:?}: tape {taped}, recursion {simplified:?}"
            );
        }
    }
    assert!(compared > TREES, "seed {SEED:#x}: only {compared} samples");
}

#[test]
fn a_derivative_equals_the_one_carried_along_with_the_value() {
    let mut generator = Generator::new(SEED ^ 1);
    let mut compared = 0;
    for round in 0..TREES {
        let mut graph = Graph::new();
        let names = symbols(&mut graph);
        let tree = Tree::random(&mut generator, 5);
        let expr = tree.build(&mut graph, &names);
        for (direction, &name) in names.iter().enumerate() {
            let derivative = graph.derivative(expr, name);
            for _ in 0..2 {
                let values = point(&mut generator);
                let written = tree.evaluate(&values, direction);
                if !written.value.is_reliable() || !written.slope.is_reliable() {
                    continue;
                }
                let symbolic = evaluate_node(&graph, derivative, &values);
                if symbolic.error.is_infinite() && symbolic.value.is_finite() {
                    continue;
                }
                compared += 1;
                assert!(
                    symbolic.agrees(written.slope),
                    "seed {SEED:#x}, round {round}: d/dx{direction} {tree:?} at {values:?} is {written:?}, symbolic {symbolic:?}"
                );
            }
        }
    }
    assert!(compared > TREES, "seed {SEED:#x}: only {compared} samples");
}

#[test]
fn a_derivative_equals_the_difference_quotient_to_its_truncation_error() {
    let mut generator = Generator::new(SEED ^ 2);
    let mut compared = 0;
    for round in 0..TREES {
        let mut graph = Graph::new();
        let names = symbols(&mut graph);
        let tree = Tree::random(&mut generator, 4);
        let expr = tree.build(&mut graph, &names);
        let derivative = graph.derivative(expr, names[0]);
        let values = point(&mut generator);
        let quotient = |step: f64| {
            let [ahead, behind] = [step, -step].map(|shift| {
                let mut moved = values.clone();
                moved[0] += shift;
                tree.evaluate(&moved, 0).value
            });
            let slope = (ahead.value - behind.value) / (2.0 * step);
            (slope, (ahead.error + behind.error) / (2.0 * step))
        };
        let [(coarse, _), (middle, _), (fine, rounding)] =
            [1.0 / 256.0, 1.0 / 512.0, 1.0 / 1024.0].map(quotient);
        let (first, second) = ((coarse - middle).abs(), (middle - fine).abs());
        // The error of a central difference falls to a quarter if the step is halved. Otherwise a singularity is near, and the
        // quotient is inconclusive.
        let converges =
            second <= 0.3 * first + 4.0 * rounding && first <= 1e-2 * (1.0 + fine.abs());
        if !converges || !fine.is_finite() || rounding > 1e-6 * (1.0 + fine.abs()) {
            continue;
        }
        compared += 1;
        let symbolic = evaluate_node(&graph, derivative, &values);
        let truncation = second + rounding + symbolic.error;
        assert!(
            (symbolic.value - fine).abs() <= truncation,
            "seed {SEED:#x}, round {round}: {tree:?} at {values:?}: quotient {fine} ± {truncation:e}, symbolic {symbolic:?}"
        );
    }
    assert!(
        compared > TREES / 3,
        "seed {SEED:#x}: only {compared} samples"
    );
}

#[test]
fn substitution_has_the_value_of_evaluation() {
    let mut generator = Generator::new(SEED ^ 3);
    let mut compared = 0;
    for round in 0..TREES {
        let mut graph = Graph::new();
        let names = symbols(&mut graph);
        let tree = Tree::random(&mut generator, 4);
        let inner = [
            Tree::random(&mut generator, 2),
            Tree::random(&mut generator, 2),
        ];
        let expr = tree.build(&mut graph, &names);
        let [first, second] = [&inner[0], &inner[1]].map(|inner| inner.build(&mut graph, &names));
        let replaced = graph.substitute(expr, &[(names[1], second), (names[0], first)]);
        let written_out = tree.with([&inner[0], &inner[1], &Tree::Symbol(2)]);
        let values = point(&mut generator);
        let written = written_out.evaluate(&values, 0).value;
        let result = evaluate_node(&graph, replaced, &values);
        if !written.is_reliable() || (result.error.is_infinite() && result.value.is_finite()) {
            continue;
        }
        compared += 1;
        assert!(
            result.agrees(written),
            "seed {SEED:#x}, round {round}: {tree:?} with {inner:?} at {values:?}: {written:?}, {result:?}"
        );
    }
    assert!(
        compared > TREES / 4,
        "seed {SEED:#x}: only {compared} samples"
    );
}

#[test]
fn a_tape_shares_symbols_and_scales_residuals_by_their_terms() {
    let mut graph = Graph::new();
    let names = symbols(&mut graph);
    let [x, y, z] = [0, 1, 2].map(|place| graph.variable(names[place]));
    let sum = graph.sum(&[x, y, z]);
    let difference = graph.subtract(x, y);
    let product = graph.multiply(x, y);
    let tape = Tape::new(&graph, &[sum, difference, product, sum]);
    // Two additions, a subtraction and a product: symbols are stored already, and the sum occurs once.
    assert_eq!(tape.length(), 4);
    let mut workspace = Vec::new();
    let mut results = [0.0; 4];
    tape.evaluate(&[3.0, -4.0, 1.0], &mut workspace, &mut results);
    assert_eq!(results, [0.0, 7.0, -12.0, 0.0]);
    let mut recorder = Recorder::new(&graph);
    let magnitudes = [sum, difference, product, sum].map(|it| recorder.magnitude(it));
    let read = recorder.symbols().to_vec();
    let code = recorder.finish();
    let mut registers = code.registers().to_vec();
    for (symbol, register) in read {
        registers[register.index()] = [3.0, -4.0, 1.0][symbol.index()];
    }
    code.run(0..code.length(), &mut registers);
    assert_eq!(
        magnitudes.map(|it| registers[it.index()]),
        [8.0, 7.0, 12.0, 8.0]
    );
}
