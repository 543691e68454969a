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
        let of = |pose: &&SingularPose| Some(pose.block) == block.place;
        let said = poses
            .iter()
            .filter(of)
            .filter_map(|pose| pose.said.as_deref());
        BlockWords {
            name: match block.place {
                Some(place) => loop_name(&plan.blocks[place], system),
                None => block.title.trim_end_matches('.').to_lowercase(),
            },
            singular: said.collect::<Vec<_>>().join(", or "),
        }
    };
    blocks.iter().map(words).collect()
}
