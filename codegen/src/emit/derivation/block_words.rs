//! Names of the blocks of a program, and their singular poses in words.

use super::SingularPose;
use crate::pool::Pool;
use crate::program::{Block, Statement};
use crate::structure::SolvedPlan;
use crate::system::System;
use crate::words::loop_name;

/// Words of a failure about a block.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BlockWords {
    /// `loop F-N-M`.
    pub name: String,
    /// Condition of its singular poses; empty if the block is never singular.
    pub singular: String,
}

/// Words for each block, in solve order; `poses` are the singular poses of the plan's subsystems.
pub fn block_words(
    blocks: &[Block],
    pool: &Pool,
    system: &System,
    plan: &SolvedPlan,
    poses: &[SingularPose],
) -> Vec<BlockWords> {
    let words = |block: &Block| {
        let poses = poses.iter().filter(|pose| Some(pose.block) == block.place);
        let poses: Vec<&SingularPose> = poses.collect();
        let conditions = poses.iter().filter_map(|pose| pose.said.as_deref());
        let pins = match poses.as_slice() {
            [only] => only.pins.as_ref(),
            _ => None,
        };
        BlockWords {
            name: match (block.place, pins) {
                (Some(_), Some(pins)) => format!("loop {pins}"),
                (Some(place), None) => loop_name(&plan.blocks[place], pool, system),
                (None, _) => block.title.trim_end_matches('.').to_lowercase(),
            },
            singular: match block.place {
                Some(_) => conditions.collect::<Vec<_>>().join(", or "),
                None => without_forces(block, system),
            },
        }
    };
    blocks.iter().map(words).collect()
}

/// Causes that leave forces undetermined, in words; empty if there are none.
fn without_forces(block: &Block, system: &System) -> String {
    let Some(forces) = &system.forces else {
        return String::new();
    };
    let loads = &system.mechanism.forces.loads;
    let sprung = forces.sprung.iter().map(|&load| loads[load].label.as_str());
    let sprung: Vec<&str> = sprung.collect();
    let mut statements = block.function.statements.iter();
    let is_solved = statements.any(|it| matches!(it, Statement::Multipliers { .. }));
    let mut causes = Vec::new();
    if !sprung.is_empty() {
        causes.push(format!("{} has no length", sprung.join(" or ")));
    }
    if is_solved {
        causes.push("the pose does not determine what joints carry".to_string());
    }
    causes.join(", or ")
}
