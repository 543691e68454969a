//! Counts the operations of Newton-Raphson by block.
//!
//! The number of evaluations is known only at run time; its limit is constant.

use super::costs::{Operations, of_function};
use super::elimination::{elimination, substitution};
use crate::pool::Pool;
use crate::program::block::Block;
use crate::program::tearing::Tearing;
use crate::system::System;

/// Largest number of evaluations of a torn block before all its equations are solved at once, as in the runtime.
pub const EVALUATIONS: usize = 6;

/// Default limit of steps for all equations at once, as in the runtime.
pub const STEPS: usize = 25;
/// Evaluations of the residuals and of the Jacobian beyond [`STEPS`].
pub const BEYOND_STEPS: [usize; 2] = [3, 5];

/// Operations of the Newton-Raphson of one block.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Iterations {
    /// Name of the block.
    pub block: String,
    /// Number of unknowns.
    pub unknowns: usize,
    /// Operations of the tearing; `None` if the block is not torn.
    pub torn: Option<TornIterations>,
    /// Operations of all residuals.
    pub residuals: Operations,
    /// Operations of the Jacobian, its elimination and one solution.
    pub jacobian: Operations,
}

/// Operations of a block's tearing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TornIterations {
    /// Number of tearing variables.
    pub tears: usize,
    /// Operations of the tearing residuals with their derivatives.
    pub evaluation: Operations,
    /// Operations of all unknowns with their rates, once, including angles.
    pub completion: Operations,
}

/// Returns the Newton-Raphson of all blocks, in solve order.
pub(in crate::program) fn iterations(
    blocks: &[Block],
    pool: &Pool,
    system: &System,
) -> Vec<Iterations> {
    let newtons = blocks
        .iter()
        .filter_map(|block| Some((block, block.newton.as_ref()?)));
    let iterations = newtons.map(|(block, newton)| {
        let mut jacobian = of_function(&newton.jacobian, pool, system);
        jacobian += elimination(newton.unknowns.len());
        jacobian += substitution(newton.unknowns.len());
        Iterations {
            block: block.name.clone(),
            unknowns: newton.unknowns.len(),
            torn: newton.tearing.as_ref().map(|it| torn(it, pool, system)),
            residuals: of_function(&newton.residual, pool, system),
            jacobian,
        }
    });
    iterations.collect()
}

fn torn(tearing: &Tearing, pool: &Pool, system: &System) -> TornIterations {
    let mut completion = of_function(&tearing.complete, pool, system);
    completion.arctangents += tearing.angles;
    TornIterations {
        tears: tearing.tears.len(),
        evaluation: of_function(&tearing.evaluate, pool, system),
        completion,
    }
}
