//! Selects the values of a frame whose finiteness proves that the whole frame is finite.

use super::Module;
use crate::expr::{IdSet, SymbolId};
use crate::program::{Block, Function, Statement};

/// Returns the values of a frame that no other value depends on. If any value is not finite, one of these is not finite either, since
/// infinities and NaN propagate.
pub(in crate::emit) fn checked(module: &Module<'_>) -> Vec<SymbolId> {
    let graph = &module.pool.graph;
    let blocks = &module.program.blocks;
    let values = blocks
        .iter()
        .flat_map(Block::functions)
        .flat_map(Function::values);
    let read: IdSet<SymbolId> = values
        .flat_map(|expr| graph.symbols(expr))
        .copied()
        .collect();
    let mut checked = Vec::new();
    for statement in blocks.iter().flat_map(|block| &block.function.statements) {
        let moves = match statement {
            Statement::Let { value, .. } => !graph.is_constant(*value),
            // The runtime checks its solutions.
            Statement::Newton { .. } => false,
            _ => true,
        };
        let targets = statement.targets().into_iter().filter(|_| moves);
        checked
            .extend(targets.filter(|&symbol| module.is_field(symbol) && !read.contains(&symbol)));
    }
    checked
}
