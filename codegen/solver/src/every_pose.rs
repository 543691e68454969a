//! *A torn block with one tear and what is known before it* → *all of its poses, and what is not decided*.
//!
//! The poses are the zeros of one function of the tear, for each choice of the signs of the closed forms: intervals isolate all of
//! them. Where the form of three circles finds the others, the function needs no sign and is defined everywhere.

use std::f64::consts::TAU;

use linkwright::math::{angle_near, nearest_turn};
use linkwright_codegen::stages::expr::SymbolId;
use linkwright_codegen::stages::program::Tearing as TearingFunctions;
use nalgebra::DVector;

use crate::enclosed::Enclosed;
use crate::interpreted::{Interpreted, State};
use crate::interval::Interval;
use crate::isolation::isolate;
use crate::search::Sought;
use crate::supplied::Modes;

/// Where the range of an angle begins: not at zero or half a turn, where a person would draw a link.
const BEGINNING: f64 = -3.0;

/// The most signs of closed forms whose choices are all tried.
const MOST_SIGNS: usize = 8;

/// All poses of a block.
pub(crate) struct EveryPose {
    /// Ascending in the tear, each with its modes.
    pub poses: Vec<(State, Modes)>,
    /// The tear, and where it is not known whether there are poses.
    pub undecided: Vec<(usize, [f64; 2])>,
}

impl Interpreted {
    /// All poses of a block after those before it; `None` where that cannot be proven for such a block.
    pub(crate) fn every_pose(
        &self,
        index: usize,
        modes: &Modes,
        state: &State,
    ) -> Option<EveryPose> {
        let compiled = self.compiled();
        let newton = compiled.blocks[index].newton.as_ref()?;
        let own = newton.tearing.as_ref()?;
        let functions = compiled.program.blocks[index].newton.as_ref()?;
        let tearing = functions.tearing.as_ref()?;
        let &[tear] = &tearing.tears[..] else {
            return None;
        };
        let signs = match tearing.proof {
            Some(_) => 0,
            None => tearing.signs.len(),
        };
        if !newton.is_angle[tear] || signs > MOST_SIGNS {
            return None;
        }
        let unknown = functions.unknowns[tear];
        let symbol = compiled.system.vector_form.unknowns[unknown].position;
        let known = own.known.iter();
        let known: Vec<(SymbolId, Interval)> = known
            .map(|(symbol, register)| (*symbol, Interval::point(state.registers[register.index()])))
            .collect();
        let graph = &compiled.system.mechanism.graph;
        let enclosed = |cell: Interval, choice: usize| {
            let signs = tearing.signs.iter().enumerate().map(|(bit, &sign)| {
                let value = if choice >> bit & 1 == 0 { 1.0 } else { -1.0 };
                (sign, Interval::point(value))
            });
            let given = known.iter().copied().chain(signs);
            Enclosed::new(graph, given.chain([(symbol, cell)]))
        };
        let mut found: Vec<(f64, usize)> = Vec::new();
        let mut undecided = Vec::new();
        for choice in 0..1_usize << signs {
            let range = [BEGINNING, (BEGINNING + TAU).next_up()];
            let zeros = isolate(range, |cell| {
                let mut enclosed = enclosed(cell, choice);
                match tearing.proof {
                    Some(proof) => proof.map(|part| enclosed.value(part)),
                    None => {
                        enclosed.run(&tearing.evaluate);
                        let results = &tearing.evaluate.results;
                        [0, 2].map(|place| enclosed.value(results[place].expr))
                    }
                }
            });
            found.extend(zeros.found.into_iter().map(|zero| (zero, choice)));
            undecided.extend(zeros.undecided.into_iter().map(|range| (unknown, range)));
        }
        found.sort_by(|one, other| one.0.total_cmp(&other.0));
        let mut poses: Vec<(State, Modes)> = Vec::new();
        for (zero, choice) in found {
            let mut enclosed = enclosed(Interval::point(zero), choice);
            let pose = pose(tearing, newton.is_angle.len(), &mut enclosed);
            let last = newton.last_frame(&state.registers, state.t).q;
            let pose = pose.map(|mut pose: DVector<f64>| {
                pose[tear] = zero;
                for (place, value) in pose.iter_mut().enumerate() {
                    if newton.is_angle[place] {
                        *value = nearest_turn(*value, last[place]);
                    }
                }
                pose
            });
            let (mut start, mut modes) = (state.clone(), modes.clone());
            let reached = pose.is_some_and(|pose| {
                newton.set_last(&pose, &mut start.registers);
                let solved = self.assemble_block(index, &mut start, &mut modes, Sought::Near);
                let there = newton.pose(&start.registers);
                solved.is_ok() && self.is_same_pose(index, &there, &pose)
            });
            match reached {
                true => poses.push((start, modes)),
                // It exists, but is too close to singular to be a pose.
                false => undecided.push((unknown, [zero, zero])),
            }
        }
        Some(EveryPose { poses, undecided })
    }
}

/// The unknowns at a tear that is a point.
fn pose(
    tearing: &TearingFunctions,
    size: usize,
    enclosed: &mut Enclosed<'_>,
) -> Option<DVector<f64>> {
    enclosed.run(&tearing.evaluate);
    enclosed.run(&tearing.complete);
    let results = &tearing.complete.results;
    let mut value = |place: usize| enclosed.value(results[place].expr).middle();
    let (cosines, sines): (Vec<f64>, Vec<f64>) = (0..size)
        .map(|place| (value(place), value(size + place)))
        .unzip();
    let angles = cosines.into_iter().zip(sines);
    let values = angles.map(|(cosine, sine)| angle_near(sine, cosine, 0.0));
    let values: Vec<f64> = values.collect();
    let finite = values.iter().all(|it| it.is_finite());
    finite.then(|| DVector::from_vec(values))
}
