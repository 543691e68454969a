//! Decides the arguments of a block's function, and whether the function can fail.

use super::Module;
use super::scope::{Place, Scope};
use crate::assemblies::never_meet;
use crate::expr::{IdMap, IdSet, SymbolId};
use crate::pool::Pool;
use crate::program::{Block, Program, Statement};
use crate::system::System;

/// Arguments and failures of a block's function.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::emit) struct Needs {
    /// True if the function takes the last frame.
    pub last: bool,
    /// True if the function takes the modes.
    pub branches: bool,
    /// True if the function sets its own mode.
    pub finds_branch: bool,
    /// True if the function takes time, parameters, inputs, settings and the kind of the last frame.
    pub conditions: bool,
    /// True if the function reads the time, or a failure reports it.
    pub time: bool,
    /// True if the function can fail.
    pub fails: bool,
}

impl Needs {
    pub(in crate::emit) fn of(block: &Block, module: &Module<'_>) -> Needs {
        let scope = Scope::new(module, &block.function, Place::Frame);
        let reads = scope.reads();
        let newton = block.newton.is_some();
        let has = |test: fn(&Statement) -> bool| block.function.statements.iter().any(test);
        let checks = has(|it| {
            matches!(
                it,
                Statement::Reach { .. }
                    | Statement::Nonzero { .. }
                    | Statement::Positive { .. }
                    | Statement::Multipliers { .. }
            )
        });
        let fails = newton || checks || module.is_large();
        Needs {
            last: newton || has(|it| matches!(it, Statement::Angle { .. })),
            branches: newton || reads.branches,
            finds_branch: newton,
            time: checks || module.is_large() || reads.time,
            conditions: fails || reads.time || reads.parameters || reads.inputs,
            fails,
        }
    }
}

/// Returns the blocks that have a single mode, by its symbol. Beyond a change point such a block has the other mode. Blocks whose
/// modes never meet are omitted.
pub(super) fn exchanged_by(
    pool: &Pool,
    system: &System,
    program: &Program,
) -> IdMap<SymbolId, usize> {
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
        let first_reads = read.iter().filter(|&&symbol| met.insert(symbol)).count();
        if first_reads == 1 && read.len() == 1 && !apart[number] {
            exchanged.extend(read.into_iter().map(|symbol| (symbol, number)));
        }
    }
    exchanged
}

/// Returns the values of a block that a large mechanism checks before it solves the next block. One check of thousands of coordinates
/// would become as many local values in the compiler.
pub(in crate::emit) fn checked_at_once(block: &Block, scope: &Scope<'_>) -> Vec<SymbolId> {
    let targets = block.function.targets();
    targets.filter(|&symbol| scope.is_field(symbol)).collect()
}
