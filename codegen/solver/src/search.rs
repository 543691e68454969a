//! *A block and what is known before it* → *its poses*: in the mode that is sought, or all that are found.
//!
//! A closed form has one pose for each choice of its signs. Of a block without one Newton-Raphson finds a pose near where it starts,
//! and there may be more: it is started from the last values and from poses at random about them.

use std::f64::consts::PI;

use linkwright::closed_form::failed;
use linkwright::math::nearest_turn;
use linkwright::{Branch, Failure, FailureKind, Start};
use nalgebra::DVector;

use crate::interpreted::{Interpreted, State};
use crate::newton::Newton;
use crate::supplied::Modes;

/// From how many poses at random a mode is looked for, if it is not found from the last values.
pub const STARTS: u32 = 200;

/// How far these poses are from the last values at most: half a turn, and this many characteristic lengths.
const SCATTER: f64 = PI;

/// Poses closer than this, in the scale of each unknown, are the same.
pub const SAME: f64 = 1e-6;

/// Which mode is sought of a block without a closed form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sought {
    /// The one near the last values.
    Near,
    /// The one with this sign of its Jacobian's determinant, from wherever it is found.
    Sign(Branch),
    /// The one that is not near.
    Other,
}

/// A reproducible sequence of numbers in [-1, 1) (xorshift64*, Vigna 2016).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let bits = self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11;
        bits as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

impl Interpreted {
    /// Solves a block in the mode that is sought, after those before it. The modes of closed forms are taken from `modes`, and that of a
    /// Newton-Raphson is noted there.
    pub(crate) fn assemble_block(
        &self,
        index: usize,
        state: &mut State,
        modes: &mut Modes,
        sought: Sought,
    ) -> Result<(), Failure> {
        let block = &self.compiled().blocks[index];
        let Some(newton) = &block.newton else {
            return self.solve_block(index, state, Start::Estimate, modes);
        };
        match sought {
            Sought::Near => {
                modes.iterated[block.iterated] = None;
                self.solve_block(index, state, Start::Estimate, modes)
            }
            Sought::Sign(branch) => self.assemble_on(index, newton, branch, state, modes),
            Sought::Other => {
                let mut near = state.clone();
                self.assemble_block(index, &mut near, modes, Sought::Near)?;
                match modes.iterated[block.iterated] {
                    Some(branch) => {
                        self.assemble_on(index, newton, branch.opposite(), state, modes)
                    }
                    None => Err(failed(FailureKind::WrongBranch, state.t, 0)),
                }
            }
        }
    }

    fn assemble_on(
        &self,
        index: usize,
        newton: &Newton,
        branch: Branch,
        state: &mut State,
        modes: &mut Modes,
    ) -> Result<(), Failure> {
        let mut found = None;
        self.try_starts(newton, state, |mut start| {
            modes.iterated[self.compiled().blocks[index].iterated] = Some(branch);
            let solved = self.solve_block(index, &mut start, Start::Estimate, modes);
            found = solved.ok().map(|()| start);
            found.is_some()
        });
        match found {
            Some(found) => {
                *state = found;
                Ok(())
            }
            None => Err(failed(FailureKind::WrongBranch, state.t, 0)),
        }
    }

    /// The poses of a block without a closed form that are found in these modes, after those before it: that from the last values first.
    /// Angles are those nearest to the last values.
    pub(crate) fn poses(&self, index: usize, modes: &Modes, state: &State) -> Vec<(State, Modes)> {
        let solved_from = |mut start: State| {
            let mut modes = modes.clone();
            let solved = self.assemble_block(index, &mut start, &mut modes, Sought::Near);
            solved.ok().map(|()| (start, modes))
        };
        let Some(newton) = &self.compiled().blocks[index].newton else {
            return Vec::new();
        };
        let last = newton.last_frame(&state.registers, state.t).q;
        let mut found: Vec<DVector<f64>> = Vec::new();
        self.try_starts(newton, state, |start| {
            if let Some((reached, _)) = solved_from(start) {
                let mut pose = newton.pose(&reached.registers);
                for (place, value) in pose.iter_mut().enumerate() {
                    if newton.is_angle[place] {
                        *value = nearest_turn(*value, last[place]);
                    }
                }
                if !found.iter().any(|other| is_same(newton, other, &pose)) {
                    found.push(pose);
                }
            }
            false
        });
        let poses = found.iter().filter_map(|pose| {
            let mut start = state.clone();
            newton.set_last(pose, &mut start.registers);
            solved_from(start)
        });
        poses.collect()
    }

    /// Offers the last values and poses at random about them until one is taken.
    fn try_starts(&self, newton: &Newton, state: &State, mut take: impl FnMut(State) -> bool) {
        let last = newton.last_frame(&state.registers, state.t).q;
        let mut random = Random(1);
        let mut pose = last.clone();
        for _ in 0..=STARTS {
            let mut start = state.clone();
            newton.set_last(&pose, &mut start.registers);
            if take(start) {
                return;
            }
            for (place, value) in pose.iter_mut().enumerate() {
                *value = last[place] + SCATTER * newton.scale(place) * random.next();
            }
        }
    }
}

impl Interpreted {
    /// The unknowns that a block without a closed form has found.
    pub(crate) fn pose_of(&self, index: usize, state: &State) -> DVector<f64> {
        let newton = self.compiled().blocks[index].newton.as_ref();
        newton.map_or_else(|| DVector::zeros(0), |newton| newton.pose(&state.registers))
    }

    /// Whether two poses of a block without a closed form differ by rounding alone, or by whole turns.
    pub(crate) fn is_same_pose(
        &self,
        index: usize,
        one: &DVector<f64>,
        other: &DVector<f64>,
    ) -> bool {
        let newton = self.compiled().blocks[index].newton.as_ref();
        newton.is_some_and(|newton| is_same(newton, one, other))
    }
}

/// Whether two poses of the tears differ by rounding alone, or by whole turns.
fn is_same(newton: &Newton, one: &DVector<f64>, other: &DVector<f64>) -> bool {
    (0..one.len()).all(|place| {
        let other = match newton.is_angle[place] {
            true => nearest_turn(other[place], one[place]),
            false => other[place],
        };
        (one[place] - other).abs() <= SAME * newton.scale(place)
    })
}
