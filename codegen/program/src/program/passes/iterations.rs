//! Newton-Raphson of the blocks → what it takes.
//!
//! How often it evaluates the equations of a block is known only while it runs, but not how often at most. Nothing here knows how the
//! runtime decides.

use super::costs::{Operations, of_function};
use super::elimination::{elimination, substitution};
use crate::program::block::Block;
use crate::program::tearing::Tearing;
use crate::system::System;

/// How often a torn block is evaluated at most before all its equations are solved at once, as in the runtime.
pub const EVALUATIONS: usize = 6;

/// Default limit of steps for all equations at once, as in the runtime.
pub const STEPS: usize = 25;
/// Evaluations of the residuals and of the Jacobian beyond [`STEPS`].
pub const BEYOND_STEPS: [usize; 2] = [3, 5];

/// What the Newton-Raphson of one block takes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Iterations {
    /// The block.
    pub block: String,
    /// How many unknowns it has.
    pub unknowns: usize,
    /// Where it is torn.
    pub torn: Option<TornIterations>,
    /// All residuals.
    pub residuals: Operations,
    /// Their Jacobian, its elimination and one solution with it.
    pub jacobian: Operations,
}

/// What the tears of a block take.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TornIterations {
    /// How many there are.
    pub tears: usize,
    /// What remains with its derivatives.
    pub evaluation: Operations,
    /// All unknowns with their rates, once, their angles included.
    pub completion: Operations,
}

/// The Newton-Raphson of all blocks, in solve order.
pub(in crate::program) fn iterations(blocks: &[Block], system: &System) -> Vec<Iterations> {
    let newtons = blocks
        .iter()
        .filter_map(|block| Some((block, block.newton.as_ref()?)));
    let found = newtons.map(|(block, newton)| {
        let mut jacobian = of_function(&newton.jacobian, system);
        jacobian += elimination(newton.unknowns.len());
        jacobian += substitution(newton.unknowns.len());
        Iterations {
            block: block.name.clone(),
            unknowns: newton.unknowns.len(),
            torn: newton.tearing.as_ref().map(|it| torn(it, system)),
            residuals: of_function(&newton.residual, system),
            jacobian,
        }
    });
    found.collect()
}

fn torn(tearing: &Tearing, system: &System) -> TornIterations {
    let mut completion = of_function(&tearing.complete, system);
    completion.arctangents += tearing.angles;
    TornIterations {
        tears: tearing.tears.len(),
        evaluation: of_function(&tearing.evaluate, system),
        completion,
    }
}
