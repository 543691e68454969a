//! Reports the kept and the omitted calculations, with their numbers of operations.

use super::needed::Needed;
use super::share_blocks;
use super::stated::Stated;
use crate::expr::{IdSet, SymbolId};
use crate::joint::Quantity;
use crate::pool::Pool;
use crate::program::block::Block;
use crate::program::function::Statement;
use crate::program::passes::costs::by_level;
use crate::program::passes::iterations::iterations;
use crate::program::passes::liveness::prune;
use crate::program::{Report, Work};
use crate::system::System;

/// Returns the report; removes blocks that are not needed.
pub(super) fn reported(
    stated: &Stated,
    needed: &mut Needed,
    pool: &mut Pool,
    system: &System,
) -> Report {
    let Needed {
        blocks,
        asked,
        path,
    } = needed;
    let mut report = Report::default();
    let levels = by_level(blocks, pool, system);
    report.operations.copy_from_slice(&levels[..3]);
    report.all_operations = match stated.outputs {
        None => report.operations,
        Some(_) => {
            let mut all = stated.blocks.clone();
            let coordinate = |symbol| system.is_coordinate(symbol, pool) || asked.contains(&symbol);
            prune(&mut all, &coordinate, &pool.graph);
            share_blocks(&mut all, pool, system);
            let [position, velocity, acceleration, ..] = by_level(&all, pool, system);
            [position, velocity, acceleration]
        }
    };
    let is_empty = |block: &Block| block.function.statements.is_empty();
    report.left_out = blocks
        .iter()
        .filter(|block| is_empty(block) && !block.joints.is_empty())
        .map(|block| block.name.clone())
        .collect();
    blocks.retain(|block| !is_empty(block));
    report.kept = blocks.iter().map(|block| block.name.clone()).collect();
    report.iterations = iterations(blocks, pool, system);
    report.transmission = (!stated.transmissions.is_empty()).then_some(levels[3]);
    report.forces = (!stated.forces.fields().is_empty()).then_some(levels[5]);
    report.sensitivity = (!stated.sensitivities.is_empty()).then_some(levels[4]);
    report.angles_left_out = angles_left_out(blocks, system);
    report.work = Work::of(blocks, &levels, path.as_ref(), pool, system);
    report
}

/// Returns the angles of closed forms that no statement computes.
fn angles_left_out(blocks: &[Block], system: &System) -> Vec<String> {
    let statements = blocks.iter().flat_map(|block| &block.function.statements);
    let computed: IdSet<SymbolId> = statements
        .filter_map(|statement| match statement {
            Statement::Angle { target, .. } => Some(*target),
            _ => None,
        })
        .collect();
    let forms = blocks.iter().flat_map(|block| &block.forms);
    let closed = forms.filter(|form| form.modes().is_some());
    closed
        .flat_map(|form| form.unknowns())
        .filter(|&unknown| {
            let unknown = &system.vector_form.unknowns[unknown];
            unknown.quantity == Quantity::Angle && !computed.contains(&unknown.position)
        })
        .map(|unknown| system.unknown_name(unknown).to_string())
        .collect()
}
