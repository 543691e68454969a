//! Names the blocks of a plan.

use std::collections::HashSet;

use crate::pool::Pool;
use crate::structure::{Definition, SolvedBlock};
use crate::system::System;

/// Largest number of statements in a name.
const MAX_LISTED: usize = 3;

/// Largest number of pins in a name.
const PINS: usize = 6;

/// Returns the name of a block: its closed pins (`loop F-N-M`), or the statements of its joints.
pub fn loop_name(block: &SolvedBlock, pool: &Pool, system: &System) -> String {
    let joints = closing_joints(block, pool, system);
    let joints = || joints.iter().map(|&joint| &system.mechanism.joints[joint]);
    let mut pins: Vec<&str> = joints()
        .filter(|joint| joint.kind.joins_points)
        .filter_map(|joint| {
            let (_, operands) = joint.label.split_once(' ')?;
            Some(operands.split_once('(').map_or(operands, |(pin, _)| pin))
        })
        .collect();
    pins.dedup();
    // A joint of two named points has no pin name.
    let are_named = pins.iter().all(|pin| !pin.is_empty());
    if pins.len() > 1 && are_named && !block.parts.is_empty() {
        return format!("loop {}", pins[..pins.len().min(PINS)].join("-"));
    }
    let labels: Vec<&str> = joints().map(|joint| joint.label.as_str()).collect();
    match labels.len().checked_sub(MAX_LISTED) {
        None | Some(0 | 1) => labels.join(", "),
        Some(more) => format!("{} and {more} more", labels[..MAX_LISTED].join(", ")),
    }
}

/// Returns the joints of the block's subsystems, in written order; all joints if every unknown is explicit. Explicit assignments
/// close no loop.
fn closing_joints(block: &SolvedBlock, pool: &Pool, system: &System) -> Vec<usize> {
    let form = &system.vector_form;
    let equations = block.parts.iter().flat_map(|part| &part.equations);
    let mut rows: Vec<usize> = equations.map(|equation| equation.row).collect();
    let mut left: Vec<&Definition> = block.definitions.iter().collect();
    let mut place = 0;
    while let Some(row) = rows.get(place) {
        let residual = form.rows[*row].residual;
        let (before, after): (Vec<&Definition>, Vec<&Definition>) = left
            .into_iter()
            .partition(|it| pool.mentions(residual, it.unknown));
        rows.extend(before.iter().map(|it| it.row));
        left = after;
        place += 1;
    }
    let joints: HashSet<usize> = rows.iter().map(|&row| form.rows[row].joint).collect();
    let is_closing = |joint: &&usize| joints.is_empty() || joints.contains(joint);
    block.joints.iter().filter(is_closing).copied().collect()
}
