//! Selects the values of a frame whose finiteness proves that the whole frame is finite.

use super::Module;
use super::checked_time::checks_time;
use crate::expr::{IdSet, SymbolId};
use crate::program::{Block, Function, Statement};

/// Returns what the final check of a frame reads: `access` to each checked value, unless blocks check their own, and to the `time` if it is
/// checked.
pub(in crate::emit) fn final_check(
    module: &Module<'_>,
    has_own_checks: bool,
    access: impl Fn(SymbolId) -> String,
    time: &str,
) -> Vec<String> {
    let values = match has_own_checks {
        true => Vec::new(),
        false => checked(module),
    };
    let time = checks_time(module).then(|| time.to_string());
    values.into_iter().map(access).chain(time).collect()
}

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
