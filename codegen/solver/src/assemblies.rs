//! Finds all poses in which a mechanism can be assembled at a time, as far as they are known.
//!
//! Each closed form has two solutions, told apart by a sign, so k of them allow up to 2^k assemblies. Both signs are tried block by
//! block; if links do not reach, all assemblies that would follow are skipped. A block without a closed form has the poses that
//! Newton-Raphson finds from the design configuration and from random poses; there may be more. Afterwards every assembly satisfies the
//! textbook equations: Newton-Raphson on Φ confirms it from the pose of the blocks.

use linkwright::{Blocks, Branch, Equations, Frame, Settings};
use linkwright_codegen::stages::assemblies::counts_turns;
use nalgebra::DVector;

use crate::every_pose::Undecided;
use crate::instant::Instant;
use crate::interpreted::{Interpreted, State};
use crate::known_poses::letter;
use crate::search::{POSE_TOLERANCE, STARTS};
use crate::supplied::Modes;
use crate::textbook::TextbookEquations;
use crate::view::View;

/// Largest number of tried combinations of signs. Each random pose from which a block without a closed form is solved counts as one.
pub(crate) const MAX_ASSEMBLIES: usize = 4096;

/// Pose of a block without a closed form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pose {
    /// Index among the known poses.
    pub place: usize,
    /// True if the pose is found from the design configuration.
    pub is_drawn: bool,
}

/// One assembly of the mechanism.
#[derive(Clone, Debug)]
pub struct Assembly {
    /// Assembly modes.
    pub modes: Modes,
    /// Pose of each block without a closed form, in the order of the blocks.
    #[doc(hidden)]
    pub poses: Vec<Pose>,
    /// True if all modes and poses are those of the design configuration.
    pub drawn: bool,
    /// Pose, rates and accelerations.
    pub instant: Instant,
}

impl Assembly {
    /// Label as in `--branch`: `+-`, or `+-b` with a block without a closed form in its second pose.
    pub fn label(&self) -> String {
        let signs = self.modes.closed.iter();
        let signs = signs.map(|it| if *it == Branch::Positive { '+' } else { '-' });
        let letters = self.poses.iter();
        let letters = letters.map(|pose| letter(pose.place).unwrap_or('*'));
        signs.chain(letters).collect()
    }
}

/// All assemblies at one time.
#[derive(Clone, Debug)]
pub struct Assemblies {
    /// Number of assembly modes of the closed forms.
    pub modes: usize,
    /// Number of blocks without a closed form.
    pub iterated: usize,
    /// Existing assemblies: that of the design configuration first, then by signs, positive ones first, and by poses.
    pub found: Vec<Assembly>,
    /// True if blocks without a closed form have no further pose, except for `undecided` ranges. False if a pose was left out for being
    /// too close to singular.
    pub proven: bool,
    /// Ranges in which existence of poses is undecided.
    #[doc(hidden)]
    pub undecided: Vec<Undecided>,
    /// Part of the candidate volume in which existence is decided, at most 1: the smallest of all blocks; 0 without a proof.
    pub decided: f64,
    /// True if some combinations were left untried because there are more than `MAX_ASSEMBLIES`.
    pub cut_short: bool,
}

impl Assemblies {
    /// Returns an empty set, for a mechanism with a value that no assembly may have.
    pub(crate) fn refused(interpreted: &Interpreted) -> Assemblies {
        let modes = interpreted.drawn_branches();
        Assemblies {
            modes: modes.closed.len(),
            iterated: modes.iterated.len(),
            found: Vec::new(),
            proven: true,
            undecided: Vec::new(),
            decided: 1.0,
            cut_short: false,
        }
    }

    /// True if a proof excludes further assemblies.
    pub fn are_all(&self) -> bool {
        self.proven && self.undecided.is_empty()
    }
}

/// Tries every combination of signs and poses at `t` (s).
pub fn assemblies(interpreted: &Interpreted, t: f64) -> Assemblies {
    let drawn = interpreted.drawn_branches();
    let textbook = TextbookEquations::new(interpreted.pool(), interpreted.system());
    let mut search = Search {
        interpreted,
        textbook: &textbook,
        drawn: &drawn,
        found: Vec::new(),
        proven: !counts_turns(
            interpreted.pool(),
            interpreted.system(),
            interpreted.program(),
        ),
        undecided: Vec::new(),
        decided: 1.0,
        tried: 0,
    };
    let start = interpreted.before_assembly(t);
    search.below(0, &drawn, &[], &start);
    let Search {
        mut found,
        tried,
        proven,
        undecided,
        decided,
        ..
    } = search;
    found.sort_by_key(|it| !it.drawn);
    let is_proven = proven && tried <= MAX_ASSEMBLIES;
    Assemblies {
        modes: drawn.closed.len(),
        iterated: drawn.iterated.len(),
        found,
        decided: if is_proven { decided } else { 0.0 },
        proven: is_proven,
        undecided,
        cut_short: tried > MAX_ASSEMBLIES,
    }
}

struct Search<'a> {
    interpreted: &'a Interpreted,
    textbook: &'a TextbookEquations,
    drawn: &'a Modes,
    found: Vec<Assembly>,
    proven: bool,
    undecided: Vec<Undecided>,
    decided: f64,
    tried: usize,
}

impl Search<'_> {
    /// Tries all signs and poses of this block and of those after it.
    fn below(&mut self, block: usize, modes: &Modes, poses: &[Pose], state: &State) {
        let blocks = &self.interpreted.compiled().blocks;
        let Some(own) = blocks.get(block) else {
            self.confirm(modes, poses, state);
            return;
        };
        let is_iterated = own.newton.is_some();
        // Positive signs come first; the first sign changes fastest.
        for choice in 0..1_usize << own.closed.len().min(usize::BITS as usize - 2) {
            self.tried += if is_iterated { STARTS as usize } else { 1 };
            if self.tried > MAX_ASSEMBLIES {
                return;
            }
            let mut modes = modes.clone();
            for (bit, &mode) in own.closed.iter().enumerate() {
                let is_positive = choice >> bit & 1 == 0;
                modes.closed[mode] = if is_positive {
                    Branch::Positive
                } else {
                    Branch::Negative
                };
            }
            let known = self.interpreted.known_poses(block, &modes, state);
            self.proven &= known.are_all;
            self.undecided.extend(known.undecided);
            if is_iterated {
                self.decided = self.decided.min(known.decided);
            }
            for (pose, (after, modes)) in known.poses.iter().enumerate() {
                let mut poses = poses.to_vec();
                poses.extend(is_iterated.then_some(Pose {
                    place: pose,
                    is_drawn: known.drawn == Some(pose),
                }));
                self.below(block + 1, modes, &poses, after);
            }
        }
    }

    /// Keeps the pose if the textbook equations hold. If they cannot be solved, the pose may still exist, too close to singular.
    fn confirm(&mut self, modes: &Modes, poses: &[Pose], state: &State) {
        let mut instant = self.interpreted.instant(state);
        let q = DVector::from_column_slice(instant.q());
        let Ok(frame) = Frame::assemble(self.textbook, &q, state.t, &Settings::default()) else {
            self.proven = false;
            return;
        };
        let scale = |k| self.textbook.coordinate_scale(k);
        let is_there = (0..q.len()).all(|k| (q[k] - frame.q[k]).abs() <= POSE_TOLERANCE * scale(k));
        self.proven &= is_there;
        if is_there {
            instant.set_frame(&frame);
            self.found.push(Assembly {
                drawn: modes.closed == self.drawn.closed && poses.iter().all(|pose| pose.is_drawn),
                modes: modes.clone(),
                poses: poses.to_vec(),
                instant,
            });
        }
    }
}
