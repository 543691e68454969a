//! System → Plan.
//!
//! Afterwards every coordinate is solved for exactly once and every equation is used exactly once. A system that is not square
//! in every part stops here, with the bodies and joints concerned. The algorithms see integers only: which equation mentions
//! which unknown.

mod components;
mod determinant;
mod diagnose;
mod elimination;
mod following;
mod incidence;
mod matching;
mod parts;
mod plan;
mod recognition;

pub use components::components;
pub use determinant::{Determinant, LARGEST_WRITTEN_OUT, determinant};
pub use elimination::Definition;
pub use incidence::Incidence;
pub use matching::{Matching, maximum_matching};
pub use parts::{Parts, coarse_parts};
pub use plan::{SolvedBlock, SolvedPlan, Step, plan, plan_of_motion};

use crate::diagnostic::Diagnostics;
use crate::system::System;

/// In which order the unknowns are found, and how.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Plan {
    /// The blocks in solve order.
    pub blocks: Vec<Block>,
}

/// Equations that are solved together for as many unknowns.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// Rows of Φ.
    pub equations: Vec<usize>,
    /// Coordinates.
    pub unknowns: Vec<usize>,
    /// How it is solved.
    pub method: Method,
}

/// How a block is solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Newton-Raphson on all unknowns of the block at once.
    Newton,
}

/// The textbook plan: all equations in one dense block. `None` where the system is not structurally square; what is missing
/// or too much is then in `diagnostics`.
pub fn analyze(system: &System, diagnostics: &mut Diagnostics) -> Option<Plan> {
    let incidence = Incidence::of(system);
    let matching = maximum_matching(&incidence);
    let parts = coarse_parts(&incidence, &matching);
    if parts.is_square() {
        let block = Block {
            equations: (0..system.rows.len()).collect(),
            unknowns: (0..system.coordinates.len()).collect(),
            method: Method::Newton,
        };
        return Some(Plan {
            blocks: vec![block],
        });
    }
    diagnose::report(system, &parts, diagnostics);
    None
}
