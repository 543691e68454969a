//! The values of a frame → those that are looked at last: whether they are finite.

use super::Module;
use crate::expr::{IdSet, SymbolId};
use crate::program::{Block, Function, Statement};

/// The numbers of a frame that nothing else depends on. What is not finite before them would show in them: nothing that is
/// computed of it is finite.
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
            // The runtime has looked at what it found.
            Statement::Newton { .. } => false,
            _ => true,
        };
        let found = statement.targets().into_iter().filter(|_| moves);
        checked.extend(found.filter(|&symbol| module.is_field(symbol) && !read.contains(&symbol)));
    }
    checked
}
