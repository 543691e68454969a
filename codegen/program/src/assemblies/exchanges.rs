//! Finds the blocks that continue in another mode beyond a pose at which their two modes meet.

use super::never_meet;
use crate::expr::{IdMap, IdSet, SymbolId};
use crate::pool::Pool;
use crate::program::Program;
use crate::system::System;

/// Returns the numbers of blocks in closed form with one mode, by the symbol of the mode. Blocks whose modes never meet are omitted.
pub fn exchanges(pool: &Pool, system: &System, program: &Program) -> IdMap<SymbolId, usize> {
    let graph = &pool.graph;
    let blocks = program.blocks.iter().enumerate();
    let apart = never_meet(pool, system, program);
    let closed = blocks.filter(|(_, block)| block.newton.is_none());
    // A mode belongs to the first block that reads it.
    let mut met: IdSet<SymbolId> = IdSet::default();
    let mut exchanged = IdMap::default();
    for (number, block) in closed {
        let read = block.function.values().flat_map(|it| graph.symbols(it));
        let read = read.filter(|&&symbol| program.branch_of(symbol).is_some());
        let read: IdSet<SymbolId> = read.copied().collect();
        let first_read = read.iter().filter(|&&symbol| met.insert(symbol)).count();
        if first_read == 1 && read.len() == 1 && !apart[number] {
            exchanged.extend(read.into_iter().map(|symbol| (symbol, number)));
        }
    }
    exchanged
}
