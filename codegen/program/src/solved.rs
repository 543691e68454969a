//! Freezes a motion whose solution has been planned and lowered.

use crate::program::Program;
use crate::structure::SolvedPlan;
use crate::system::Derived;

/// Motion with its solution, from which all outputs are produced. None of its parts changes any more.
#[derive(Clone, Debug)]
pub struct Solved {
    /// Equations, with the expressions of all parts.
    pub derived: Derived,
    /// Plan of their solution.
    pub plan: SolvedPlan,
    /// Functions that solve them.
    pub program: Program,
}
