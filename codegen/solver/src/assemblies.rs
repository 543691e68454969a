//! *A mechanism and a time* → *every pose in which it can be assembled, as far as that is known*.
//!
//! Each closed form has two solutions, told apart by a sign, so k of them allow up to 2^k assemblies. They are found by trying
//! both signs block by block: where links do not reach, everything that would follow is dropped at once. A block without a
//! closed form has the poses that Newton-Raphson finds from the drawing and from a number of poses at random; there may be
//! more. Afterwards every assembly satisfies the textbook equations: Newton-Raphson on Φ confirms it from the blocks' pose.

use linkwright::{Blocks, Branch, Equations, Settings, assemble};
use nalgebra::DVector;

use crate::instant::Instant;
use crate::interpreted::{Interpreted, State};
use crate::search::{SAME, STARTS, Sought};
use crate::supplied::Modes;
use crate::textbook::TextbookEquations;
use crate::view::View;

/// How many combinations of signs are tried at most; each pose at random from which a block without a closed form is solved
/// counts as one.
pub const LARGEST: usize = 4096;

/// One way of putting the mechanism together.
#[derive(Clone, Debug)]
pub struct Assembly {
    /// The assembly modes.
    pub modes: Modes,
    /// Which of its poses each block without a closed form has, in the order of the blocks: 0 for the one that is found from
    /// the drawing.
    pub poses: Vec<usize>,
    /// Whether all of these are the drawing's.
    pub drawn: bool,
    /// The pose with its velocities and accelerations.
    pub instant: Instant,
}

impl Assembly {
    /// `+-`, or `+-b` with a block without a closed form in its second pose.
    pub fn label(&self) -> String {
        let signs = self.modes.closed.iter();
        let signs = signs.map(|it| if *it == Branch::Positive { '+' } else { '-' });
        let letters = self.poses.iter().map(|pose| {
            let letter = u8::try_from(*pose).ok().and_then(|it| b'a'.checked_add(it));
            letter
                .filter(u8::is_ascii_lowercase)
                .map_or('*', char::from)
        });
        signs.chain(letters).collect()
    }
}

/// All assemblies at one time.
#[derive(Clone, Debug)]
pub struct Assemblies {
    /// How many assembly modes the closed forms have.
    pub modes: usize,
    /// How many blocks have no closed form.
    pub iterated: usize,
    /// Those that exist, the drawing's first, then by their signs, positive ones first, and their poses.
    pub found: Vec<Assembly>,
    /// Whether every block without a closed form has no other poses than these, but in `undecided` ranges.
    pub proven: bool,
    /// Unknowns of the vector form, and ranges in which it is not known whether they have poses.
    pub undecided: Vec<(usize, [f64; 2])>,
    /// Whether combinations were left untried because there are more than [`LARGEST`].
    pub cut_short: bool,
}

/// Tries every combination of signs and poses at `t`.
pub fn assemblies(interpreted: &Interpreted, t: f64) -> Assemblies {
    let drawn = interpreted.drawn_branches();
    let textbook = TextbookEquations::new(interpreted.system());
    let mut search = Search {
        interpreted,
        textbook: &textbook,
        drawn: &drawn,
        found: Vec::new(),
        proven: true,
        undecided: Vec::new(),
        tried: 0,
    };
    let start = interpreted.before_assembly(t);
    search.below(0, &drawn, &[], &start);
    let Search {
        mut found,
        tried,
        proven,
        undecided,
        ..
    } = search;
    found.sort_by_key(|it| !it.drawn);
    Assemblies {
        modes: drawn.closed.len(),
        iterated: drawn.iterated.len(),
        found,
        proven: proven && tried <= LARGEST,
        undecided,
        cut_short: tried > LARGEST,
    }
}

struct Search<'a> {
    interpreted: &'a Interpreted,
    textbook: &'a TextbookEquations,
    drawn: &'a Modes,
    found: Vec<Assembly>,
    proven: bool,
    undecided: Vec<(usize, [f64; 2])>,
    tried: usize,
}

impl Search<'_> {
    /// Tries all signs and poses of this block and those after it.
    fn below(&mut self, block: usize, modes: &Modes, poses: &[usize], state: &State) {
        let blocks = &self.interpreted.compiled().blocks;
        let Some(own) = blocks.get(block) else {
            self.confirm(modes, poses, state);
            return;
        };
        let is_iterated = own.newton.is_some();
        // Positive signs first, the first of them changing fastest.
        for choice in 0..1_usize << own.closed.len().min(usize::BITS as usize - 2) {
            self.tried += if is_iterated { STARTS as usize } else { 1 };
            if self.tried > LARGEST {
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
            let found = self.poses(block, &modes, state);
            for (pose, (after, modes)) in found.iter().enumerate() {
                let mut poses = poses.to_vec();
                poses.extend(is_iterated.then_some(pose));
                self.below(block + 1, modes, &poses, after);
            }
        }
    }

    /// The poses of a block, all of them where that can be proven: that from the last values first, then in their order.
    fn poses(&mut self, block: usize, modes: &Modes, state: &State) -> Vec<(State, Modes)> {
        if self.interpreted.compiled().blocks[block].newton.is_none() {
            return self.interpreted.poses(block, modes, state);
        }
        let Some(every) = self.interpreted.every_pose(block, modes, state) else {
            self.proven = false;
            return self.interpreted.poses(block, modes, state);
        };
        self.undecided.extend(every.undecided);
        let mut poses = every.poses;
        let (mut near, mut own) = (state.clone(), modes.clone());
        let solved = self
            .interpreted
            .assemble_block(block, &mut near, &mut own, Sought::Near);
        if solved.is_ok() {
            let pose = |state: &State| self.interpreted.pose_of(block, state);
            let there = pose(&near);
            let first = poses
                .iter()
                .position(|(other, _)| self.interpreted.is_same_pose(block, &pose(other), &there));
            match first {
                Some(first) => poses[..=first].rotate_right(1),
                None => poses.insert(0, (near, own)),
            }
        }
        poses
    }

    /// Keeps the pose if the textbook equations hold there.
    fn confirm(&mut self, modes: &Modes, poses: &[usize], state: &State) {
        let mut instant = self.interpreted.instant(state);
        let q = DVector::from_column_slice(instant.q());
        let Ok(frame) = assemble(self.textbook, &q, state.t, &Settings::default()) else {
            return;
        };
        let scale = |k| self.textbook.coordinate_scale(k);
        if (0..q.len()).all(|k| (q[k] - frame.q[k]).abs() <= SAME * scale(k)) {
            instant.set_frame(&frame);
            self.found.push(Assembly {
                drawn: modes.closed == self.drawn.closed && poses.iter().all(|pose| *pose == 0),
                modes: modes.clone(),
                poses: poses.to_vec(),
                instant,
            });
        }
    }
}
