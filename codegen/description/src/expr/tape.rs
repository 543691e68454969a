//! Evaluates roots of a graph for given values of the symbols.
//!
//! A tape is independent of its graph.

use super::code::{Code, Register};
use super::graph::Graph;
use super::node::{ExprId, SymbolId};
use super::recorder::Recorder;

/// The instructions that evaluate expressions.
#[derive(Clone, Debug)]
pub struct Tape {
    code: Code,
    symbols: Vec<(SymbolId, Register)>,
    roots: Vec<Register>,
}

impl Tape {
    /// The instructions for these roots, in their order.
    pub fn new(graph: &Graph, roots: &[ExprId]) -> Tape {
        let mut recorder = Recorder::new(graph);
        let roots = roots.iter().map(|&root| recorder.value(root)).collect();
        Tape {
            symbols: recorder.symbols().to_vec(),
            code: recorder.finish(),
            roots,
        }
    }

    /// The value of each root. `symbols` holds a value for each symbol by [`SymbolId::index`](super::SymbolId::index), at
    /// least up to the last one that occurs; `results` has one place per root. The workspace may be used again for any
    /// tape; its content means nothing.
    ///
    /// # Panics
    /// Panics if `symbols` is too short, or if `results` has another length than the roots.
    pub fn evaluate(&self, symbols: &[f64], workspace: &mut Vec<f64>, results: &mut [f64]) {
        assert!(
            results.len() == self.roots.len(),
            "every root has a place for its result"
        );
        self.run(|symbol| symbols[symbol.index()], workspace);
        for (result, &root) in results.iter_mut().zip(&self.roots) {
            *result = workspace[root.index()];
        }
    }

    /// Number of instructions.
    pub fn length(&self) -> usize {
        self.code.length()
    }

    fn run(&self, value_of: impl Fn(SymbolId) -> f64, registers: &mut Vec<f64>) {
        registers.clear();
        registers.extend_from_slice(self.code.registers());
        for &(symbol, register) in &self.symbols {
            registers[register.index()] = value_of(symbol);
        }
        self.code.run(0..self.code.length(), registers);
    }
}

/// Evaluates one expression, where `value_of` gives the value of each symbol: a table of few of many symbols would be long.
pub fn evaluate_by(graph: &Graph, expr: ExprId, value_of: impl Fn(SymbolId) -> f64) -> f64 {
    let tape = Tape::new(graph, &[expr]);
    let mut workspace = Vec::new();
    tape.run(value_of, &mut workspace);
    let root = tape.roots.first();
    root.map_or(0.0, |&root| workspace[root.index()])
}
