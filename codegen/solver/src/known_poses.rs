//! *A block and what is known before it* → *its poses in an order of their own, so that each has a letter*.
//!
//! Where all poses can be proven they ascend in the tear; otherwise the one that is found from the drawing comes first, and others
//! as they are found from starts at random. Both are the same on every run.

use crate::every_pose::EveryPose;
use crate::interpreted::{Interpreted, State};
use crate::search::Sought;
use crate::supplied::Modes;

/// The poses of a block.
pub(crate) struct KnownPoses {
    /// Each with its modes.
    pub poses: Vec<(State, Modes)>,
    /// Which of them is found from the last values.
    pub drawn: Option<usize>,
    /// Whether there are no others, but in `undecided` ranges.
    pub are_all: bool,
    /// Unknowns of the vector form, and ranges in which it is not known whether there are poses.
    pub undecided: Vec<(usize, [f64; 2])>,
}

/// The letter of a pose: `a` of the first one.
pub(crate) fn letter(pose: usize) -> Option<char> {
    let letter = u8::try_from(pose).ok()?.checked_add(b'a')?;
    letter.is_ascii_lowercase().then_some(char::from(letter))
}

impl Interpreted {
    /// The poses of a block in the modes of its closed forms, after the blocks before it.
    pub(crate) fn known_poses(&self, block: usize, modes: &Modes, state: &State) -> KnownPoses {
        let is_closed = self.compiled().blocks[block].newton.is_none();
        let every = match is_closed {
            true => None,
            false => self.every_pose(block, modes, state),
        };
        let Some(EveryPose {
            mut poses,
            undecided,
        }) = every
        else {
            return KnownPoses {
                poses: self.poses(block, modes, state),
                drawn: Some(0),
                are_all: is_closed,
                undecided: Vec::new(),
            };
        };
        let (mut near, mut own) = (state.clone(), modes.clone());
        let solved = self.assemble_block(block, &mut near, &mut own, Sought::Near);
        let drawn = solved.is_ok().then(|| {
            let there = self.pose_of(block, &near);
            let is_there = |(state, _): &(State, Modes)| {
                self.is_same_pose(block, &self.pose_of(block, state), &there)
            };
            poses.iter().position(is_there).unwrap_or_else(|| {
                // One that intervals could not decide.
                poses.push((near, own));
                poses.len() - 1
            })
        });
        KnownPoses {
            poses,
            drawn,
            are_all: true,
            undecided,
        }
    }
}
