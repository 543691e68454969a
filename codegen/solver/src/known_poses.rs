//! Orders the poses of a block, so that each has a letter.
//!
//! If a proof exists, the poses ascend in the sought unknowns. Otherwise the pose that is found from the design configuration comes
//! first, and the others follow as they are found from random starts. Both orders are equal on every run.

use linkwright::FailureKind;
use linkwright_codegen::stages::assemblies::order;

use crate::every_pose::{EveryPose, Undecided};
use crate::interpreted::{Interpreted, State};
use crate::search::Sought;
use crate::supplied::Modes;

/// Poses of a block.
pub(crate) struct KnownPoses {
    /// Poses with their modes.
    pub poses: Vec<(State, Modes)>,
    /// Index of the pose that is found from the last values; `None` if that is not among them.
    pub drawn: Option<usize>,
    /// True if no further poses exist, except for `undecided` ranges.
    pub are_all: bool,
    /// Ranges in which existence of poses is undecided.
    pub undecided: Vec<Undecided>,
    /// Part of the candidate volume in which existence is decided, at most 1.
    pub decided: f64,
}

/// Returns the letter of a pose: `a` of the first; `None` beyond `z`.
pub(crate) fn letter(pose: usize) -> Option<char> {
    let letter = u8::try_from(pose).ok()?.checked_add(b'a')?;
    letter.is_ascii_lowercase().then_some(char::from(letter))
}

impl Interpreted {
    /// Returns the poses of a block in the modes of its closed forms, after the blocks before it.
    pub(crate) fn known_poses(&self, block: usize, modes: &Modes, state: &State) -> KnownPoses {
        if self.compiled().blocks[block].newton.is_none() {
            return self.closed_poses(block, modes, state);
        }
        let every = self.every_pose(block, modes, state);
        let Some(EveryPose {
            mut poses,
            sought,
            undecided,
            decided,
        }) = every
        else {
            return KnownPoses {
                poses: self.poses(block, modes, state),
                drawn: Some(0),
                are_all: false,
                undecided: Vec::new(),
                decided: 0.0,
            };
        };
        let near = {
            let (mut near, mut own) = (state.clone(), modes.clone());
            let solved = self.assemble_block(block, &mut near, &mut own, Sought::Near);
            solved.is_ok().then_some((near, own))
        };
        // Undecided ranges may contain further poses.
        let others = match undecided.is_empty() {
            true => Vec::new(),
            false => self.poses(block, modes, state),
        };
        for other in near.iter().cloned().chain(others) {
            let there = self.pose_of(block, &other.0);
            let is_there = |(state, _): &(State, Modes)| {
                self.is_same_pose(block, &self.pose_of(block, state), &there)
            };
            if !poses.iter().any(is_there) {
                poses.push(other);
            }
        }
        let newton = self.compiled().blocks[block].newton.as_ref();
        let is_angle = |place: usize| newton.is_some_and(|newton| newton.is_angle[place]);
        poses.sort_by_cached_key(|(state, _)| {
            let pose = self.pose_of(block, state);
            order(pose.as_slice(), is_angle, &sought)
        });
        let drawn = near.and_then(|(near, _)| {
            let there = self.pose_of(block, &near);
            let mut poses = poses.iter();
            poses.position(|(state, _)| {
                self.is_same_pose(block, &self.pose_of(block, state), &there)
            })
        });
        KnownPoses {
            poses,
            drawn,
            are_all: true,
            undecided,
            decided,
        }
    }

    /// Returns the one pose of a block with closed forms in these modes.
    ///
    /// Only links that do not reach exclude a pose for certain: collinear links may have a pose that cannot be solved.
    fn closed_poses(&self, block: usize, modes: &Modes, state: &State) -> KnownPoses {
        let (mut state, mut modes) = (state.clone(), modes.clone());
        let solved = self.assemble_block(block, &mut state, &mut modes, Sought::Near);
        let are_all = match &solved {
            Ok(()) => true,
            Err(failure) => matches!(failure.kind, FailureKind::OutOfReach { .. }),
        };
        let pose = solved.is_ok().then_some((state, modes));
        KnownPoses {
            poses: pose.into_iter().collect(),
            drawn: Some(0),
            are_all,
            undecided: Vec::new(),
            decided: 0.0,
        }
    }
}
