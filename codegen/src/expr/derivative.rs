//! The derivative.
use super::graph::Graph;
use super::node::{ExprId, SymbolId};
impl Graph {
    /// The partial derivative; memoized.
    pub fn derivative(&mut self, expr: ExprId, symbol: SymbolId) -> ExprId {
        let _ = (expr, symbol);
        unimplemented!()
    }
}
