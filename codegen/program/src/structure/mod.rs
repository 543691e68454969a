//! System → SolvedPlan.
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
mod shortening;

pub use components::components;
pub use elimination::Definition;
pub use freedom::Freedom;
pub use incidence::Incidence;
pub use matching::{Matching, maximum_matching};
pub use parts::{CoarseDecomposition, coarse_decomposition};
pub use plan::{LARGEST_TOGETHER, SolvedBlock, SolvedPlan, Subsystem, plan, plan_of_motion};
pub use rank::released;
pub use shortening::Addition;

use crate::diagnostic::Diagnostics;
use crate::system::System;

/// Whether the equations determine the motion; what is missing, too much, or repeated is otherwise in `diagnostics`.
pub fn analyze(system: &System, diagnostics: &mut Diagnostics) -> bool {
    let incidence = Incidence::of(system);
    let matching = maximum_matching(&incidence);
    let parts = coarse_decomposition(&incidence, &matching);
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
    is_determined
}
