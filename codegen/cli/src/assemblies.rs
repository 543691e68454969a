//! *A solved view and a time → every pose in which the mechanism can be assembled, as far as that is known.*
//!
//! Each closed form has two solutions, told apart by a sign, so k of them allow up to 2^k assemblies. They are found by trying
//! both signs block by block: where links do not reach, everything that would follow is dropped at once. A block without a
//! closed form has the poses that Newton-Raphson finds from the drawing and from a number of poses at random; there may be
//! more. Afterwards every assembly satisfies the textbook equations: Newton-Raphson on Φ confirms it from the blocks' pose.

use linkwright::{Frame, Settings, assemble};
use nalgebra::Dyn;

use crate::interpreter::Interpreter;
use crate::solved_interpreter::{SAME, STARTS, SolvedInterpreter, Values};

/// How many combinations of signs are tried at most; each pose at random from which a block without a closed form is solved
/// counts as one.
pub const LARGEST: usize = 4096;

/// One way of putting the mechanism together.
#[derive(Clone, Debug)]
pub struct Assembly {
    /// The sign of each assembly mode, in the order of the blocks; `true` for positive.
    pub signs: Vec<bool>,
    /// Which of its poses each block without a closed form has, in the order of the blocks: 0 for the one that is found from
    /// the drawing.
    pub poses: Vec<usize>,
    /// Whether all of these are the drawing's.
    pub drawn: bool,
    /// The pose with its velocities and accelerations.
    pub frame: Frame<f64, Dyn>,
}

impl Assembly {
    /// `+-`, or `+-b` with a block without a closed form in its second pose.
    pub fn label(&self) -> String {
        let signs = self.signs.iter();
        let signs = signs.map(|positive| if *positive { '+' } else { '-' });
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
    /// Whether combinations were left untried because there are more than [`LARGEST`].
    pub cut_short: bool,
}

/// Tries every combination of signs and poses at `t`.
pub fn assemblies(solved: &SolvedInterpreter, textbook: &Interpreter, t: f64) -> Assemblies {
    let drawn: Vec<bool> = solved.drawn_signs().concat();
    let mut search = Search {
        solved,
        textbook,
        drawn: &drawn,
        found: Vec::new(),
        tried: 0,
    };
    search.below(0, &Chosen::default(), &solved.begin(t));
    let Search {
        mut found, tried, ..
    } = search;
    found.sort_by_key(|it| !it.drawn);
    Assemblies {
        modes: drawn.len(),
        iterated: (0..solved.block_count())
            .filter(|&block| solved.is_iterated(block))
            .count(),
        found,
        cut_short: tried > LARGEST,
    }
}

struct Search<'a> {
    solved: &'a SolvedInterpreter,
    textbook: &'a Interpreter,
    drawn: &'a [bool],
    found: Vec<Assembly>,
    tried: usize,
}

/// What was chosen for the blocks so far.
#[derive(Clone, Debug, Default)]
struct Chosen {
    signs: Vec<bool>,
    poses: Vec<usize>,
}

impl Search<'_> {
    /// Tries all signs and poses of this block and those after it.
    fn below(&mut self, block: usize, chosen: &Chosen, values: &Values) {
        if block == self.solved.block_count() {
            self.confirm(chosen, values);
            return;
        }
        let is_iterated = self.solved.is_iterated(block);
        for own in self.solved.choices(block) {
            self.tried += if is_iterated { STARTS as usize } else { 1 };
            if self.tried > LARGEST {
                return;
            }
            let poses = self.solved.poses(block, &own, values);
            for (pose, after) in poses.iter().enumerate() {
                let mut chosen = chosen.clone();
                chosen.signs.extend(&own);
                chosen.poses.extend(is_iterated.then_some(pose));
                self.below(block + 1, &chosen, after);
            }
        }
    }

    /// Keeps the pose if the textbook equations hold there.
    fn confirm(&mut self, chosen: &Chosen, values: &Values) {
        let q = self.solved.pose(values);
        let Ok(frame) = assemble(self.textbook, &q, values.t, &Settings::default()) else {
            return;
        };
        if is_same(self.textbook, &q, &frame.q) {
            let Chosen { signs, poses } = chosen.clone();
            self.found.push(Assembly {
                drawn: signs == self.drawn && poses.iter().all(|pose| *pose == 0),
                signs,
                poses,
                frame,
            });
        }
    }
}

/// Whether two poses are the same up to rounding.
fn is_same(textbook: &Interpreter, a: &nalgebra::DVector<f64>, b: &nalgebra::DVector<f64>) -> bool {
    use linkwright::Equations;
    (0..a.len()).all(|k| (a[k] - b[k]).abs() <= SAME * textbook.coordinate_scale(k))
}
