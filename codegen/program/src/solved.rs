//! Plans and lowers the solution of a motion, and freezes it with its equations.
//!
//! Nothing else plans or lowers. The parts of a [`Solved`] belong together and never change: output makes further expressions in a
//! draft of the pool.

use crate::model::set;
use crate::pool::Pool;
use crate::program::{Kept, Program, Report, lower};
use crate::structure::{Shift, SolvedPlan, Unplanned, plan};
use crate::system::{Derived, System};

/// Motion with its solution, from which all outputs are produced.
#[derive(Clone, Debug)]
pub struct Solved {
    derived: Derived,
    plan: SolvedPlan,
    program: Program,
}

impl Solved {
    /// Plans and lowers the solution of a motion.
    ///
    /// # Errors
    /// The equations do not determine the motion, or a limit is exceeded.
    pub fn of(mut derived: Derived, shift: Shift, kept: Kept) -> Result<Solved, Unplanned> {
        let plan = plan(&mut derived.pool, &derived.system, shift)?;
        Ok(Solved::of_plan(derived, plan, kept))
    }

    /// Lowers an existing plan, for a motion that needs a second program of it. The pool holds the plan's expressions.
    pub fn of_plan(mut derived: Derived, plan: SolvedPlan, kept: Kept) -> Solved {
        let program = lower(&mut derived.pool, &derived.system, &plan, kept);
        Solved {
            derived,
            plan,
            program,
        }
    }

    /// Applies an assignment to a parameter or an input, as [`set`] does. The program is unchanged: it reads parameters and inputs as values.
    ///
    /// # Errors
    /// Those of [`set`].
    pub fn set(&mut self, option: &str, assignment: &str) -> Result<(), String> {
        let Derived { pool, system } = &mut self.derived;
        set(pool, &mut system.mechanism, option, assignment)
    }

    /// Equations, with the expressions of all parts.
    pub fn derived(&self) -> &Derived {
        &self.derived
    }

    /// Expressions of all parts.
    pub fn pool(&self) -> &Pool {
        &self.derived.pool
    }

    /// Equations.
    pub fn system(&self) -> &System {
        &self.derived.system
    }

    /// Plan of the solution.
    pub fn plan(&self) -> &SolvedPlan {
        &self.plan
    }

    /// Functions of the solution.
    pub fn program(&self) -> &Program {
        &self.program
    }

    /// Kept and omitted calculations; `None` if a limit is exceeded, so that the program is incomplete.
    pub fn report(&self) -> Option<&Report> {
        let is_whole = self.derived.pool.graph.excess().is_none();
        is_whole.then_some(&self.program.report)
    }
}
