//! System → Plan.
//!
//! Afterwards every coordinate is solved for exactly once and every equation is used exactly once. A system that is not square
//! in every part stops here, with the bodies and joints concerned. The algorithms see integers only: which equation mentions
//! which unknown.

mod components;
mod diagnose;
mod elimination;
mod following;
mod freedom;
mod incidence;
mod matching;
mod parts;
mod plan;
mod rank;
mod repetition;

pub use components::components;
pub use elimination::{BlockEquation, Definition};
pub use freedom::Freedom;
pub use incidence::Incidence;
pub use matching::{Matching, maximum_matching};
pub use parts::{Parts, coarse_parts};
pub use plan::{LARGEST_TOGETHER, Part, SolvedBlock, SolvedPlan, plan, plan_of_motion};
pub use rank::{Dependence, FreeMotion, LARGEST_SURVEY, Moves, Survey, released};

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

/// The textbook plan: all equations in one dense block. `None` where the equations do not determine the motion: what is missing,
/// too much, or repeated is then in `diagnostics`.
pub fn analyze(system: &System, diagnostics: &mut Diagnostics) -> Option<Plan> {
    let incidence = Incidence::of(system);
    let matching = maximum_matching(&incidence);
    let parts = coarse_parts(&incidence, &matching);
    let mut found = Diagnostics::new();
    repetition::report_marks(system, &mut found);
    if !parts.is_square() {
        diagnose::report(system, &parts, &mut found);
    } else if !found.has_errors()
        && let Some(singular) = rank::singular(system, &incidence, &matching)
    {
        repetition::report(system, &singular, &mut found);
    }
    let is_determined = !found.has_errors();
    diagnostics.extend(found);
    is_determined.then(|| Plan {
        blocks: vec![Block {
            equations: (0..system.rows.len()).collect(),
            unknowns: (0..system.coordinates.len()).collect(),
            method: Method::Newton,
        }],
    })
}
