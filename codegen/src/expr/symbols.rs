//! The symbols.
use super::graph::Graph;
use super::node::{ExprId, SymbolId};
impl Graph {
    /// The symbols that occur, sorted.
    pub fn symbols(&self, expr: ExprId) -> &[SymbolId] {
        let _ = (expr,);
        unimplemented!()
    }
    /// Whether the symbol occurs.
    pub fn depends_on(&self, expr: ExprId, symbol: SymbolId) -> bool {
        let _ = (expr, symbol);
        unimplemented!()
    }
}
