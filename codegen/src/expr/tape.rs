//! Evaluation.
use super::graph::Graph;
use super::node::ExprId;
/// A linear list of instructions that evaluates expressions.
#[derive(Clone, Debug)]
pub struct Tape {}
impl Tape {
    /// The instructions for these roots, in their order.
    pub fn new(graph: &Graph, roots: &[ExprId]) -> Tape {
        let _ = (graph, roots);
        unimplemented!()
    }
    /// The value of each root. `symbols` holds a value per symbol by [`SymbolId::index`](super::SymbolId::index).
    pub fn evaluate(&self, symbols: &[f64], workspace: &mut Vec<f64>, results: &mut [f64]) {
        let _ = (symbols, workspace, results);
        unimplemented!()
    }
    /// For each root the sum of the absolute values of its terms.
    pub fn magnitudes(&self, symbols: &[f64], workspace: &mut Vec<f64>, results: &mut [f64]) {
        let _ = (symbols, workspace, results);
        unimplemented!()
    }
}
