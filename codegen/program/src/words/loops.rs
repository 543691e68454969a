//! A block of the plan → what a person calls it.

use std::collections::HashSet;

use crate::structure::{Definition, SolvedBlock};
use crate::system::System;

/// How many statements a name lists.
const LISTED: usize = 3;

/// How many pins a name lists.
const PINS: usize = 6;

/// `loop F-N-M`: the pins that are closed, or else the statements of all joints.
pub fn loop_name(block: &SolvedBlock, system: &System) -> String {
    let joints = closing_joints(block, system);
    let joints = || joints.iter().map(|&joint| &system.mechanism.joints[joint]);
    let mut pins: Vec<&str> = joints()
        .filter(|joint| joint.kind.joins_points())
        .filter_map(|joint| {
            let (_, operands) = joint.label.split_once(' ')?;
            Some(operands.split_once('(').map_or(operands, |(pin, _)| pin))
        })
        .collect();
    pins.dedup();
    // A joint of two points with names of their own has none itself.
    let are_named = pins.iter().all(|pin| !pin.is_empty());
    if pins.len() > 1 && are_named && !block.parts.is_empty() {
        return format!("loop {}", pins[..pins.len().min(PINS)].join("-"));
    }
    let labels: Vec<&str> = joints().map(|joint| joint.label.as_str()).collect();
    match labels.len().checked_sub(LISTED) {
        None | Some(0 | 1) => labels.join(", "),
        Some(more) => format!("{} and {more} more", labels[..LISTED].join(", ")),
    }
}

/// Returns the joints on which the parts of a block depend, in written order; where everything is explicit, all of them. What only follows
/// from the parts closes nothing.
fn closing_joints(block: &SolvedBlock, system: &System) -> Vec<usize> {
    let form = &system.vector_form;
    let graph = &system.mechanism.graph;
    let equations = block.parts.iter().flat_map(|part| &part.equations);
    let mut rows: Vec<usize> = equations.map(|equation| equation.row).collect();
    let mut left: Vec<&Definition> = block.definitions.iter().collect();
    let mut place = 0;
    while let Some(row) = rows.get(place) {
        let residual = form.rows[*row].residual;
        let (before, after): (Vec<&Definition>, Vec<&Definition>) = left
            .into_iter()
            .partition(|it| form.mentions(residual, it.unknown, graph));
        rows.extend(before.iter().map(|it| it.row));
        left = after;
        place += 1;
    }
    let joints: HashSet<usize> = rows.iter().map(|&row| form.rows[row].joint).collect();
    let is_closing = |joint: &&usize| joints.is_empty() || joints.contains(joint);
    block.joints.iter().filter(is_closing).copied().collect()
}
