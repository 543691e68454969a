//! *A solved view and a time → every pose in which the closed forms let the mechanism be assembled.*
//!
//! Each closed form has two solutions, told apart by a sign, so k of them allow up to 2^k assemblies. They are found by trying
//! both signs block by block: where links do not reach, everything that would follow is dropped at once. Afterwards every
//! assembly satisfies the textbook equations: Newton-Raphson on Φ confirms it from the closed forms' pose. What a Newton block
//! allows beyond the solution that is reached from the drawing is not known here.

use linkwright::{Frame, Settings, assemble};
use nalgebra::Dyn;

use crate::interpreter::Interpreter;
use crate::solved_interpreter::{SolvedInterpreter, Values};

/// How many combinations of signs are tried at most.
pub const LARGEST: usize = 4096;

/// Poses closer than this, relative to the scale of each coordinate, are the same.
const SAME: f64 = 1e-6;

/// One way of putting the mechanism together.
#[derive(Clone, Debug)]
pub struct Assembly {
    /// The sign of each assembly mode, in the order of the blocks; `true` for positive.
    pub signs: Vec<bool>,
    /// Whether they are the drawing's.
    pub drawn: bool,
    /// The pose with its velocities and accelerations.
    pub frame: Frame<f64, Dyn>,
}

/// All assemblies at one time.
#[derive(Clone, Debug)]
pub struct Assemblies {
    /// How many assembly modes the closed forms have.
    pub modes: usize,
    /// Those that exist, the drawing's first, then by their signs, positive ones first.
    pub found: Vec<Assembly>,
    /// Whether combinations were left untried because there are more than [`LARGEST`].
    pub cut_short: bool,
}

/// Tries every combination of signs at `t`.
pub fn assemblies(solved: &SolvedInterpreter, textbook: &Interpreter, t: f64) -> Assemblies {
    let drawn: Vec<bool> = solved.drawn_signs().concat();
    let mut search = Search {
        solved,
        textbook,
        drawn: &drawn,
        found: Vec::new(),
        tried: 0,
    };
    search.below(0, &mut Vec::new(), &solved.begin(t));
    let Search {
        mut found, tried, ..
    } = search;
    found.sort_by_key(|it| !it.drawn);
    Assemblies {
        modes: drawn.len(),
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

impl Search<'_> {
    /// Tries all signs of this block and those after it.
    fn below(&mut self, block: usize, signs: &mut Vec<bool>, values: &Values) {
        if block == self.solved.block_count() {
            self.confirm(signs, values);
            return;
        }
        let modes = self.solved.branches(block).len();
        for choice in 0..1_usize << modes.min(usize::BITS as usize - 2) {
            self.tried += 1;
            if self.tried > LARGEST {
                return;
            }
            let own: Vec<bool> = (0..modes).map(|mode| choice >> mode & 1 == 0).collect();
            let mut after = values.clone();
            if self.solved.solve_block(block, &own, &mut after).is_ok() {
                let before = signs.len();
                signs.extend(own);
                self.below(block + 1, signs, &after);
                signs.truncate(before);
            }
        }
    }

    /// Keeps the pose if the textbook equations hold there.
    fn confirm(&mut self, signs: &[bool], values: &Values) {
        let q = self.solved.pose(values);
        let Ok(frame) = assemble(self.textbook, &q, values.t, &Settings::default()) else {
            return;
        };
        if is_same(self.textbook, &q, &frame.q) {
            self.found.push(Assembly {
                signs: signs.to_vec(),
                drawn: signs == self.drawn,
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
