//! Values and derivatives of an expression of t, by differentiation of its text.

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::read;
use linkwright_codegen::stages::expr::{ExprId, Graph, Tape};

/// A driven angle as a function of t, with its derivatives.
pub struct Law {
    graph: Graph,
    orders: Vec<ExprId>,
}

impl Law {
    /// Motion with the text after `drive phi(1) =`, with derivatives up to the fourth.
    ///
    /// # Panics
    /// If the description has errors.
    pub fn new(written: &str) -> Law {
        Law::with("", written)
    }

    /// Motion below further statements.
    ///
    /// # Panics
    /// If the description has errors.
    pub fn with(statements: &str, written: &str) -> Law {
        let text = format!(
            "mechanism driven {{ {statements} body 1 at (0, 0); absolute_x(1) = 0; absolute_y(1) = 0; drive phi(1) = {written}; }}"
        );
        let source = Source::new("driven.mech", text);
        let read = read(&source).unwrap_or_else(|found| panic!("{}", found.render(&source)));
        let derived = read.only().expect("one motion");
        let residual = derived.system.rows[2].residual;
        let mechanism = derived.system.mechanism;
        let mut graph = derived.pool.graph;
        let [_, _, angle] = mechanism.bodies[1].coordinates;
        let angle = angle.expect("a moving body").symbol;
        let zero = graph.zero();
        // Φ is φ − f(t).
        let negative = graph.substitute(residual, &[(angle, zero)]);
        let mut orders = vec![graph.negate(negative)];
        for order in 0..4 {
            orders.push(graph.derivative(orders[order], mechanism.time));
        }
        Law { graph, orders }
    }

    /// The value and the first four derivatives.
    pub fn at(&self, t: f64) -> [f64; 5] {
        let mut symbols = vec![0.0; self.graph.symbol_count()];
        if let Some(time) = self.graph.symbols(self.orders[0]).first() {
            symbols[time.index()] = t;
        }
        let mut values = [0.0; 5];
        Tape::new(&self.graph, &self.orders).evaluate(&symbols, &mut Vec::new(), &mut values);
        values
    }
}
