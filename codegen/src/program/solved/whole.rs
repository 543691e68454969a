//! Every block of the plan → its function with nothing left out, for whoever evaluates it without a compile step.

use super::block::lower_block;
use super::lower::{drawn_values, set_apart};
use super::responses::Responses;
use super::{BlockProgram, Branch};
use crate::program::constants::Constants;
use crate::structure::SolvedPlan;
use crate::system::System;

/// A block whose values are all kept.
#[derive(Clone, Debug)]
pub struct WholeBlock {
    /// What it does.
    pub program: BlockProgram,
    /// Its assembly modes, one for each closed form with a sign.
    pub branches: Vec<Branch>,
}

/// The functions of all blocks. Values that nothing needs are computed too, so that every unknown of the vector form has its
/// position and rate. The system's arena grows by the values that are computed on the way.
pub fn whole(system: &mut System, plan: &SolvedPlan) -> Vec<WholeBlock> {
    let drawn = drawn_values(system);
    let mut responses = Responses::new(system);
    let mut constants = Constants::default();
    let mut names = Vec::new();
    let blocks = plan.blocks.iter().map(|block| {
        let mut branches = Vec::new();
        let mut program = lower_block(
            system,
            block,
            &drawn,
            &mut branches,
            &mut responses,
            &mut constants,
        );
        set_apart(&mut program, &mut names);
        WholeBlock { program, branches }
    });
    blocks.collect()
}
