//! Blocks that are needed → what shows that they have stayed on their path, which needs more of them.

use crate::expr::{ExprId, IdSet, SymbolId};
use crate::program::block::{Block, Lowering};
use crate::program::function::{Function, Statement};
use crate::program::passes::liveness::prune_path;
use crate::program::passes::sharing::share_all;
use crate::program::path::Path;
use crate::structure::SolvedPlan;
use crate::system::{SymbolRole, System};

/// What is computed, with what nothing needs left out.
pub(super) struct Needed {
    pub blocks: Vec<Block>,
    /// The fields that are asked for, also by the path.
    pub asked: IdSet<SymbolId>,
    pub path: Option<Path>,
}

/// What shows that these blocks have stayed on their path.
pub(super) fn path_of(blocks: &[Block], lowering: &mut Lowering<'_>, plan: &SolvedPlan) -> Path {
    let kept: Vec<usize> = blocks
        .iter()
        .filter(|block| !block.function.statements.is_empty())
        .filter_map(|block| block.place)
        .collect();
    let kept = kept.into_iter().map(|place| (place, &plan.blocks[place]));
    let mut found = lowering.path(kept.clone());
    // What Newton-Raphson finds needs its enclosures, also where it does not move.
    if blocks.iter().all(|block| block.newton.is_none()) {
        found.closed = lowering.closed_path(kept);
    }
    prune_path(&mut found, &lowering.system.mechanism.graph);
    found
}

/// What a path reads of what the blocks find, now and in the last frame; `whole` blocks have nothing left out.
pub(super) fn read_by_path(path: &Path, unpruned: &[Block], system: &System) -> IdSet<SymbolId> {
    let graph = &system.mechanism.graph;
    let found: IdSet<SymbolId> = unpruned
        .iter()
        .flat_map(|it| it.function.targets())
        .collect();
    let symbols = path
        .functions()
        .flat_map(Function::values)
        .flat_map(|expr| graph.symbols(expr));
    let symbols = symbols.map(|&symbol| match system.roles[symbol.index()] {
        SymbolRole::Last(symbol) => symbol,
        _ => symbol,
    });
    // Arms are found anew.
    let is_arm = |symbol: SymbolId| matches!(system.roles[symbol.index()], SymbolRole::Arm(_));
    symbols
        .filter(|symbol| found.contains(symbol) && !is_arm(*symbol))
        .collect()
}

pub(super) fn share_path(path: &mut Function, system: &mut System) {
    share_all(path, system);
    for inner in path.statements.iter_mut().filter_map(Statement::inner_mut) {
        share_all(inner, system);
    }
    halve(path, system);
}

/// Computes a sine without its cosine, or the other way round, where nobody reads the other.
fn halve(function: &mut Function, system: &mut System) {
    let graph = &mut system.mechanism.graph;
    // A value is read by its symbol, or as the expression that the symbol stands for.
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
