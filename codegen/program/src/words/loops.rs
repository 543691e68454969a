//! A block of the plan → what a person calls it.

use crate::structure::SolvedBlock;
use crate::system::System;

/// How many statements a name lists.
const LISTED: usize = 3;

/// How many pins a name lists.
const PINS: usize = 6;

/// `loop F-N-M`: the pins that are closed, or else the statements of all joints.
pub fn loop_name(block: &SolvedBlock, system: &System) -> String {
    let joints = || {
        block
            .joints
            .iter()
            .map(|&joint| &system.mechanism.joints[joint])
    };
    let mut pins: Vec<&str> = joints()
        .filter(|joint| joint.kind.joins_points())
        .filter_map(|joint| {
            let (_, operands) = joint.label.split_once(' ')?;
            Some(operands.split_once('(').map_or(operands, |(pin, _)| pin))
        })
        .collect();
    pins.dedup();
    if pins.len() > 1 && !block.parts.is_empty() {
        return format!("loop {}", pins[..pins.len().min(PINS)].join("-"));
    }
    let labels: Vec<&str> = joints().map(|joint| joint.label.as_str()).collect();
    match labels.len().checked_sub(LISTED) {
        None | Some(0 | 1) => labels.join(", "),
        Some(more) => format!("{} and {more} more", labels[..LISTED].join(", ")),
    }
}
