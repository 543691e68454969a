//! Orders a system into blocks and plans their solution.
//!
//! Every coordinate is solved for exactly once, and every equation is used exactly once. A system with a subsystem that is not
//! square is rejected; findings name its bodies and joints. Structural algorithms use only the sparsity pattern.

mod components;
mod diagnose;
mod driven;
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
pub use driven::driven;
pub use elimination::Definition;
pub use freedom::Freedom;
pub use incidence::Incidence;
pub use matching::{Matching, maximum_matching};
pub use parts::{CoarseDecomposition, coarse_decomposition};
pub use plan::{LARGEST_TOGETHER, Shift, SolvedBlock, SolvedPlan, Subsystem, Unplanned, plan};
pub use rank::released;
pub use shortening::Addition;

use crate::diagnostic::Diagnostics;
use crate::pool::Pool;
use crate::system::System;

/// Returns what is wrong with the structure of the equations: missing, surplus or repeated ones. Without errors, they determine
/// the motion.
pub fn analyze(pool: &Pool, system: &System) -> Diagnostics {
    let incidence = Incidence::of(system);
    let matching = maximum_matching(&incidence);
    let parts = coarse_decomposition(&incidence, &matching);
    let mut findings = Diagnostics::new();
    repetition::report_marks(pool, system, &mut findings);
    if !parts.is_square() {
        diagnose::report(pool, system, &parts, &mut findings);
    } else if !findings.has_errors()
        && let Some(singular) = rank::singular(pool, system, &incidence, &matching)
    {
        repetition::report(pool, system, &singular, &mut findings);
    }
    findings
}
