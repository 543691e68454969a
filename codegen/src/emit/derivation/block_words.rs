//! The blocks of a program → what they are called, and what is said of them where they are singular.

use super::SingularPose;
use crate::pool::Pool;
use crate::program::{Block, Statement};
use crate::structure::SolvedPlan;
use crate::system::System;
use crate::words::loop_name;

/// What a failure says of a block.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BlockWords {
    /// `loop F-N-M`.
    pub name: String,
    /// `c2 and the actuator c8-c7 are in line`; empty where the block is never singular.
    pub singular: String,
}

/// What each block is called, in solve order; `poses` says where the parts of the plan are singular.
pub fn block_words(
    blocks: &[Block],
    pool: &Pool,
    system: &System,
    plan: &SolvedPlan,
    poses: &[SingularPose],
) -> Vec<BlockWords> {
    let words = |block: &Block| {
        let own = poses.iter().filter(|pose| Some(pose.block) == block.place);
        let own: Vec<&SingularPose> = own.collect();
        let said = own.iter().filter_map(|pose| pose.said.as_deref());
        let pins = match own.as_slice() {
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
                Some(_) => said.collect::<Vec<_>>().join(", or "),
                None => without_forces(block, system),
            },
        }
    };
    blocks.iter().map(words).collect()
}

/// Returns what leaves forces undetermined that follow from the pose, in words; empty if nothing does.
fn without_forces(block: &Block, system: &System) -> String {
    let Some(forces) = &system.forces else {
        return String::new();
    };
    let loads = &system.mechanism.forces.loads;
    let sprung = forces.sprung.iter().map(|&load| loads[load].label.as_str());
    let sprung: Vec<&str> = sprung.collect();
    let mut statements = block.function.statements.iter();
    let is_solved = statements.any(|it| matches!(it, Statement::Multipliers { .. }));
    let mut said = Vec::new();
    if !sprung.is_empty() {
        said.push(format!("{} has no length", sprung.join(" or ")));
    }
    if is_solved {
        said.push("the pose does not determine what joints carry".to_string());
    }
    said.join(", or ")
}
