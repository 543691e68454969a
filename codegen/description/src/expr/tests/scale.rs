//! Tests that the work for large graphs is proportional to their size.

use crate::expr::{ExprId, Graph, Tape};

/// Returns the constraints of a chain of bodies joined end to end: two rows per joint, at most nine coordinates in each.
fn chain(graph: &mut Graph, bodies: usize) -> Vec<ExprId> {
    let mut rows = Vec::new();
    let coordinates: Vec<[ExprId; 3]> = (0..bodies)
        .map(|body| {
            ["x", "y", "phi"].map(|name| {
                let symbol = graph.symbol(&format!("{name}{body}"));
                graph.variable(symbol)
            })
        })
        .collect();
    let half = graph.rational(1, 2);
    for pair in coordinates.windows(2) {
        let [[x1, y1, phi1], [x2, y2, phi2]] = [pair[0], pair[1]];
        let (sin1, cos1) = (graph.sin(phi1), graph.cos(phi1));
        let (sin2, cos2) = (graph.sin(phi2), graph.cos(phi2));
        for (from, to, ahead, behind) in [(x1, x2, cos1, cos2), (y1, y2, sin1, sin2)] {
            let ahead = graph.multiply(half, ahead);
            let behind = graph.multiply(half, behind);
            let end = graph.add(from, ahead);
            let start = graph.subtract(to, behind);
            rows.push(graph.subtract(end, start));
        }
    }
    rows
}

#[test]
fn a_chain_is_differentiated_twice_by_all_its_symbols() {
    const BODIES: usize = 2000;
    let mut graph = Graph::new();
    let rows = chain(&mut graph, BODIES);
    let mut entries = Vec::new();
    for &row in &rows {
        for symbol in graph.symbols(row).to_vec() {
            let first = graph.derivative(row, symbol);
            entries.push(first);
            for again in graph.symbols(first).to_vec() {
                entries.push(graph.derivative(first, again));
            }
        }
    }
    // Each row has two constants, two angles, and the second derivative of each angle.
    assert_eq!(entries.len(), 6 * 2 * (BODIES - 1));
    let tape = Tape::new(&graph, &entries);
    let values = vec![0.25; graph.symbol_count()];
    let mut results = vec![0.0; entries.len()];
    tape.evaluate(&values, &mut Vec::new(), &mut results);
    let (sine, cosine) = (0.25f64.sin() / 2.0, 0.25f64.cos() / 2.0);
    let known = [1.0, sine, cosine];
    assert!(
        results
            .iter()
            .all(|result| known.iter().any(|known| result.abs() == *known))
    );
}

#[test]
fn a_wide_sum_and_a_wide_product_take_all_operands_at_once() {
    const WIDTH: usize = 20_000;
    let mut graph = Graph::new();
    let symbols: Vec<_> = (0..WIDTH)
        .map(|place| graph.symbol(&format!("x{place}")))
        .collect();
    let variables: Vec<_> = symbols
        .iter()
        .map(|&symbol| graph.variable(symbol))
        .collect();
    let squares: Vec<_> = variables
        .iter()
        .map(|&variable| {
            let sine = graph.sin(variable);
            graph.multiply(sine, sine)
        })
        .collect();
    let sum = graph.sum(&squares);
    let product = graph.product(&variables);
    let both = graph.multiply(sum, product);
    assert_eq!(graph.symbols(both), &symbols[..]);
    let derivative = graph.derivative(sum, symbols[WIDTH / 2]);
    assert_eq!(graph.symbols(derivative), &[symbols[WIDTH / 2]]);
    let squared_cosines: Vec<_> = variables
        .iter()
        .map(|&variable| {
            let cosine = graph.cos(variable);
            graph.multiply(cosine, cosine)
        })
        .collect();
    let others = graph.sum(&squared_cosines);
    let all = graph.add(sum, others);
    assert_eq!(all, graph.integer(WIDTH as i64));
}
