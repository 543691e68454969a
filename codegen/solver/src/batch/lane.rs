//! Holds one set of a batch on its way through the instants.

use linkwright::{Blocks, Failure, Shell};

use super::{Outcome, Supplied, Task};
use crate::instant::Instant;
use crate::interpreted::Interpreted;
use crate::supplied::Numbers;

/// Set that is being solved.
pub(super) struct Lane {
    /// Index of the set among all, and of the next instant.
    pub set: usize,
    pub next: usize,
    pub shell: Shell<Interpreted>,
    pub outcome: Outcome,
    /// Instant that was solved by itself.
    pub at: Instant,
}

impl Lane {
    /// Assembles a set at the first instant.
    pub fn assemble(
        task: &Task<'_>,
        blocks: Interpreted,
        set: usize,
        supplied: &Supplied<'_>,
    ) -> Result<Lane, Failure> {
        let parameters = Numbers(supplied.parameters(set).to_vec());
        let (pose, modes) = (blocks.drawn_pose(&parameters), blocks.drawn_branches());
        let inputs = supplied.inputs(set, 0);
        let t = task.times[0];
        let shell = Shell::assemble(blocks, &parameters, &pose, modes, t, inputs, task.settings)?;
        let at = shell.frame().clone();
        Ok(Lane {
            set,
            next: 1,
            shell,
            outcome: Outcome {
                solved: 1,
                failure: None,
            },
            at,
        })
    }

    /// Returns the instant that was solved last.
    pub fn instant(&self, follows_path: bool) -> &Instant {
        match follows_path || self.next == 1 {
            true => self.shell.frame(),
            false => &self.at,
        }
    }
}
