//! Finds all poses of a block without a closed form, as far as a proof exists.
//!
//! Intervals isolate the poses; the block is then assembled from each of them as from any other estimate.

use linkwright::math::Real as _;
use linkwright_codegen::stages::assemblies::{Interval, poses};
use linkwright_codegen::stages::expr::SymbolId;
use nalgebra::DVector;

use crate::interpreted::{Interpreted, State};
use crate::search::Sought;
use crate::supplied::Modes;

/// Largest number of examined parts of the candidate volume.
const MOST_PARTS: usize = 100_000;

/// Poses of a block.
pub(crate) struct EveryPose {
    /// Poses with their modes, in an order of their own.
    pub poses: Vec<(State, Modes)>,
    /// Indices of the block's unknowns that were sought.
    pub sought: Vec<usize>,
    /// Ranges in which further poses are undecided: unknowns of the vector form with a range of each.
    pub undecided: Vec<Undecided>,
    /// Part of the candidate volume in which existence is decided, at most 1.
    pub decided: f64,
}

/// Range of the values of some unknowns.
#[derive(Clone, Debug, PartialEq)]
pub struct Undecided(pub Vec<(usize, [f64; 2])>);

impl Interpreted {
    /// Returns all poses of a block after those before it; `None` if such a block admits no proof.
    pub(crate) fn every_pose(
        &self,
        index: usize,
        modes: &Modes,
        state: &State,
    ) -> Option<EveryPose> {
        let compiled = self.compiled();
        let newton = compiled.blocks[index].newton.as_ref()?;
        let functions = compiled.solved.program().blocks[index].newton.as_ref()?;
        let known = |symbol: SymbolId| {
            let mut known = newton.known.iter();
            let (_, register) = known.find(|(own, _)| *own == symbol)?;
            Some(Interval::point(state.registers[register.index()]))
        };
        let all = poses(
            functions,
            compiled.solved.pool(),
            compiled.solved.system(),
            &known,
            MOST_PARTS,
        )?;
        let part = |ranges: Vec<[f64; 2]>| {
            let sought = all.sought.iter().map(|&place| functions.unknowns[place]);
            Undecided(sought.zip(ranges).collect())
        };
        let ranges = all.undecided.iter().cloned();
        let mut undecided: Vec<Undecided> = ranges.map(part).collect();
        let last = newton.last_frame(&state.registers, state.t).q;
        let mut poses: Vec<(State, Modes)> = Vec::new();
        for pose in all.found {
            let places = pose.unknowns.iter().enumerate();
            let near = places.map(|(place, &value)| match newton.is_angle[place] {
                true => value.nearest_turn(last[place]),
                false => value,
            });
            let pose = DVector::from_vec(near.collect());
            let (mut start, mut modes) = (state.clone(), modes.clone());
            newton.set_last(&pose, &mut start.registers);
            let solved = self.assemble_block(index, &mut start, &mut modes, Sought::Near);
            let there = newton.pose(&start.registers);
            match solved.is_ok() && self.is_same_pose(index, &there, &pose) {
                true => poses.push((start, modes)),
                // The pose exists, but is too close to singular to be solved.
                false => {
                    let sought = all.sought.iter();
                    undecided.push(part(sought.map(|&place| [pose[place]; 2]).collect()));
                }
            }
        }
        Some(EveryPose {
            poses,
            sought: all.sought,
            undecided,
            decided: all.decided,
        })
    }
}
