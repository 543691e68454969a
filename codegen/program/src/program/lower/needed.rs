//! Determines the needed parts of blocks, including those that the path verification needs.

use crate::expr::{ExprId, IdSet, SymbolId};
use crate::pool::{Pool, SymbolRole};
use crate::program::block::{Block, Lowering};
use crate::program::function::{Function, Statement};
use crate::program::passes::liveness::prune_path;
use crate::program::passes::sharing::share_all;
use crate::program::path::Path;
use crate::structure::SolvedPlan;
use crate::system::System;

/// Needed statements.
pub(super) struct Needed {
    pub blocks: Vec<Block>,
    /// Requested fields, including those of the path.
    pub asked: IdSet<SymbolId>,
    pub path: Option<Path>,
}

/// Returns the verification that these blocks stay on their path.
pub(super) fn path_of(blocks: &[Block], lowering: &mut Lowering<'_>, plan: &SolvedPlan) -> Path {
    let kept: Vec<usize> = blocks
        .iter()
        .filter(|block| !block.function.statements.is_empty())
        .filter_map(|block| block.place)
        .collect();
    let kept = kept.into_iter().map(|place| (place, &plan.blocks[place]));
    let mut path = lowering.path(kept.clone());
    // Newton-Raphson needs its enclosures even if it does not move.
    if blocks.iter().all(|block| block.newton.is_none()) {
        path.closed = lowering.closed_path(kept);
    }
    prune_path(&mut path, &lowering.pool.graph);
    path
}

/// Returns the symbols of blocks that a path reads, now and in the last frame; `unpruned` blocks are complete.
pub(super) fn read_by_path(path: &Path, unpruned: &[Block], pool: &Pool) -> IdSet<SymbolId> {
    let graph = &pool.graph;
    let targets: IdSet<SymbolId> = unpruned
        .iter()
        .flat_map(|it| it.function.targets())
        .collect();
    let symbols = path
        .functions()
        .flat_map(Function::values)
        .flat_map(|expr| graph.symbols(expr));
    let symbols = symbols.map(|&symbol| match pool.role(symbol) {
        SymbolRole::Last(symbol) => symbol,
        _ => symbol,
    });
    // Rotated vectors are computed anew.
    let is_arm = |symbol: SymbolId| matches!(pool.role(symbol), SymbolRole::Arm(_));
    symbols
        .filter(|symbol| targets.contains(symbol) && !is_arm(*symbol))
        .collect()
}

pub(super) fn share_path(path: &mut Function, pool: &mut Pool, system: &System) {
    share_all(path, pool, system);
    for inner in path.statements.iter_mut().filter_map(Statement::inner_mut) {
        share_all(inner, pool, system);
    }
    halve(path, pool);
}

/// Replaces a sine-cosine pair by one of them if the other is not read.
fn halve(function: &mut Function, pool: &mut Pool) {
    let graph = &mut pool.graph;
    // A value is read by its symbol, or by the expression of the symbol.
    let mut read: IdSet<ExprId> = IdSet::default();
    let mut open: Vec<ExprId> = function.all_values().collect();
    while let Some(expr) = open.pop() {
        if read.insert(expr) {
            open.extend(graph.operands(expr));
        }
    }
    for statement in &mut function.statements {
        let Statement::SineCosine {
            sine,
            cosine,
            angle,
        } = *statement
        else {
            continue;
        };
        let values = [graph.sin(angle), graph.cos(angle)];
        let symbols = [sine, cosine].map(|symbol| graph.variable(symbol));
        let [reads_sine, reads_cosine] =
            [0, 1].map(|which| read.contains(&values[which]) || read.contains(&symbols[which]));
        if !reads_cosine {
            *statement = Statement::assignment(sine, values[0]);
        } else if !reads_sine {
            *statement = Statement::assignment(cosine, values[1]);
        }
    }
}
