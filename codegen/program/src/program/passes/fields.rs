//! Finds the values that several blocks need.

use crate::expr::{IdMap, IdSet, SymbolId};
use crate::pool::Pool;
use crate::program::block::Block;
use crate::program::function::{Function, Statement};
use crate::system::System;

/// Returns the values that other blocks read, and those in `outputs`, in order of definition. If `whole` is true, coordinates are
/// excluded: the frame has separate places for them.
pub(in crate::program) fn fields(
    blocks: &[Block],
    outputs: &IdSet<SymbolId>,
    whole: bool,
    pool: &Pool,
    system: &System,
) -> Vec<SymbolId> {
    let mut home: IdMap<SymbolId, usize> = IdMap::default();
    let mut order: Vec<SymbolId> = Vec::new();
    let mut shared: IdSet<SymbolId> = IdSet::default();
    for (index, block) in blocks.iter().enumerate() {
        for statement in &block.function.statements {
            for symbol in statement.targets() {
                if home.insert(symbol, index).is_none() {
                    order.push(symbol);
                }
            }
            match statement {
                // An angle is chosen nearest to its last value.
                Statement::Angle { target, .. } => shared.extend([*target]),
                // Newton-Raphson starts from its last values.
                Statement::Newton { found, torn, .. } => {
                    shared.extend(found.iter().flatten());
                    shared.extend(torn.iter().flat_map(|it| &it.memory));
                }
                _ => {}
            }
        }
    }
    for (index, block) in blocks.iter().enumerate() {
        // Tearing variables are local to the equations of their own Newton-Raphson.
        let read = block.functions().flat_map(Function::values);
        for symbol in read.flat_map(|expr| pool.graph.symbols(expr)) {
            if home.get(symbol).is_some_and(|&place| place != index) {
                shared.insert(*symbol);
            }
        }
    }
    shared.extend(outputs);
    order.retain(|&symbol| {
        shared.contains(&symbol) && !(whole && system.is_coordinate(symbol, pool))
    });
    order
}
