//! The blocks of a program → what they are called, and what is said of them where they are singular.

use super::SingularPose;
use crate::program::Block;
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
                (Some(place), None) => loop_name(&plan.blocks[place], system),
                (None, _) => block.title.trim_end_matches('.').to_lowercase(),
            },
            singular: said.collect::<Vec<_>>().join(", or "),
        }
    };
    blocks.iter().map(words).collect()
}
