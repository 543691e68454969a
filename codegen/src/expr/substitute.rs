//! The substitute.
use super::graph::Graph;
use super::node::{ExprId, SymbolId};
impl Graph {
    /// Replaces symbols, all at once.
    pub fn substitute(&mut self, expr: ExprId, replacements: &[(SymbolId, ExprId)]) -> ExprId {
        let _ = (expr, replacements);
        unimplemented!()
    }
}
