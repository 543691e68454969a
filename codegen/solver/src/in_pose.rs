//! *A mechanism and one of its poses* → *the assembly modes that it has there*.
//!
//! Blocks are solved one after another from the pose itself, each in all modes of its closed forms, until all of them have found it again.

use linkwright::{Blocks, Branch};

use crate::interpreted::{Interpreted, State};
use crate::search::{SAME, Sought};
use crate::supplied::{InputSignals, Modes, Numbers};
use crate::view::View;

impl Interpreted {
    /// The modes of a pose of nominal parameters and these inputs; `None` where it is none of the mechanism's.
    pub(crate) fn modes_in(&self, q: &[f64], t: f64, inputs: &InputSignals) -> Option<Modes> {
        let start = self.before(&Numbers(q.to_vec()), t, inputs);
        self.modes_from(0, q, &start, &self.drawn_branches())
    }

    /// The coordinates that a block finds.
    pub(crate) fn found_in(&self, number: usize) -> Vec<usize> {
        let block = self.program().blocks.get(number).and_then(|it| it.place);
        let Some(block) = block.and_then(|place| self.plan().blocks.get(place)) else {
            return Vec::new();
        };
        let torn = block
            .parts
            .iter()
            .flat_map(|part| part.unknowns.iter().copied());
        let following = block.definitions.iter().map(|it| it.unknown);
        let count = self.system().coordinates.len();
        torn.chain(following).filter(|it| *it < count).collect()
    }

    /// The modes of this block and those after it, where some lead to the pose.
    fn modes_from(&self, block: usize, q: &[f64], state: &State, modes: &Modes) -> Option<Modes> {
        let Some(own) = self.compiled().blocks.get(block) else {
            return Some(modes.clone());
        };
        let most = own.closed.len().min(usize::BITS as usize - 2);
        (0..1_usize << most).find_map(|choice| {
            let (mut state, mut modes) = (state.clone(), modes.clone());
            for (bit, &mode) in own.closed.iter().enumerate() {
                modes.closed[mode] = match choice >> bit & 1 {
                    0 => Branch::Positive,
                    _ => Branch::Negative,
                };
            }
            let solved = self.assemble_block(block, &mut state, &mut modes, Sought::Near);
            let is_there = solved.is_ok() && self.has_found(block, q, &state);
            is_there.then(|| self.modes_from(block + 1, q, &state, &modes))?
        })
    }

    /// Whether what a block has found is the pose.
    fn has_found(&self, block: usize, q: &[f64], state: &State) -> bool {
        let instant = self.instant(state);
        let length = self.system().mechanism.characteristic_length;
        self.found_in(block).into_iter().all(|at| {
            let scale = match self.system().coordinates[at].quantity.power_of_length() {
                0 => 1.0,
                _ => length,
            };
            (instant.q()[at] - q[at]).abs() <= SAME * scale
        })
    }
}
