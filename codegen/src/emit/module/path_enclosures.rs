//! Lists the unknowns of Newton-Raphson that path enclosures verify.

use super::Module;
use crate::expr::{IdSet, SymbolId};
use crate::program::{Path, Program};
use crate::system::System;

/// Returns the unknowns of Newton-Raphson with their deviations; an unknown that rests has none.
pub(in crate::emit) fn iterated(
    program: &Program,
    system: &System,
    path: &Path,
) -> Vec<(SymbolId, Option<SymbolId>)> {
    let blocks = program.blocks.iter();
    let unknowns = blocks.flat_map(|block| block.newton.iter().flat_map(|newton| &newton.unknowns));
    let unknowns = unknowns.map(|unknown| {
        let position = system.vector_form.unknowns[*unknown].position;
        (position, path.deviations.get(unknown).copied())
    });
    unknowns.collect()
}

/// Number of enclosures.
pub(in crate::emit) fn enclosure_count(module: &Module<'_>) -> usize {
    let path = module.program.path.iter();
    path.map(|path| iterated(module.program, module.system, path).len())
        .sum()
}

/// Returns the deviations in path enclosures.
pub(super) fn deviations_of_enclosures(program: &Program, system: &System) -> IdSet<SymbolId> {
    let path = program.path.iter();
    path.flat_map(|path| iterated(program, system, path))
        .filter_map(|(_, deviation)| deviation)
        .collect()
}
