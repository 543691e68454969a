//! Searches for the poses of a block: one in a sought mode, or all that are found.
//!
//! A closed form has one pose for each choice of its signs. Of a block without a closed form, Newton-Raphson finds a pose near its start,
//! and there may be more: it starts from the last values and from random poses about them.

use std::f64::consts::PI;

use linkwright::generated::{Start, failed};
use linkwright::math::Real as _;
use linkwright::{Branch, Failure, FailureKind};
use nalgebra::DVector;

use crate::interpreted::{Interpreted, State};
use crate::newton::Newton;
use crate::supplied::Modes;

/// Number of random poses from which a mode is sought if it is not found from the last values.
pub const STARTS: u32 = 200;

/// Largest distance of these poses from the last values: half a turn, and this many characteristic lengths.
const SCATTER: f64 = PI;

/// Distance below which poses are equal, in the scale of each unknown.
pub(crate) const POSE_TOLERANCE: f64 = 1e-6;

/// Sought mode of a block without a closed form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sought {
    /// Pose near the last values.
    Near,
    /// Pose with this sign of its Jacobian's determinant, wherever it is found.
    Sign(Branch),
    /// Pose other than the near one.
    Other,
}

/// Reproducible sequence of numbers in [-1, 1) (xorshift64*, Vigna 2016).
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
    /// Solves a block in the sought mode, after those before it.
    ///
    /// The modes of closed forms are taken from `modes`, and that of a Newton-Raphson is recorded there.
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
        let mut solution = None;
        self.try_starts(newton, state, |mut start| {
            modes.iterated[self.compiled().blocks[index].iterated] = Some(branch);
            let solved = self.solve_block(index, &mut start, Start::Estimate, modes);
            solution = solved.ok().map(|()| start);
            solution.is_some()
        });
        match solution {
            Some(solution) => {
                *state = solution;
                Ok(())
            }
            None => Err(failed(FailureKind::WrongBranch, state.t, 0)),
        }
    }

    /// Returns the poses of a block without a closed form that are found in these modes, after those before it.
    ///
    /// The pose found from the last values comes first. Angles are those nearest to the last values.
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
        let mut distinct: Vec<DVector<f64>> = Vec::new();
        self.try_starts(newton, state, |start| {
            if let Some((reached, _)) = solved_from(start) {
                let mut pose = newton.pose(&reached.registers);
                for (place, value) in pose.iter_mut().enumerate() {
                    if newton.is_angle[place] {
                        *value = value.nearest_turn(last[place]);
                    }
                }
                if !distinct.iter().any(|other| is_same(newton, other, &pose)) {
                    distinct.push(pose);
                }
            }
            false
        });
        let poses = distinct.iter().filter_map(|pose| {
            let mut start = state.clone();
            newton.set_last(pose, &mut start.registers);
            solved_from(start)
        });
        poses.collect()
    }

    /// Offers the last values, and random poses about them, until one is taken.
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
    /// Returns the unknowns of a solved block without a closed form.
    pub(crate) fn pose_of(&self, index: usize, state: &State) -> DVector<f64> {
        let newton = self.compiled().blocks[index].newton.as_ref();
        newton.map_or_else(|| DVector::zeros(0), |newton| newton.pose(&state.registers))
    }

    /// True if two poses of a block without a closed form differ by rounding alone, or by whole turns.
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

/// True if two poses of the tearing variables differ by rounding alone, or by whole turns.
fn is_same(newton: &Newton, one: &DVector<f64>, other: &DVector<f64>) -> bool {
    (0..one.len()).all(|place| {
        let other = match newton.is_angle[place] {
            true => other[place].nearest_turn(one[place]),
            false => other[place],
        };
        (one[place] - other).abs() <= POSE_TOLERANCE * newton.scale(place)
    })
}
