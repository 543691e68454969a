//! Judges simulations of the gallery with masses and free drivers from random states, beside all coordinates integrated with multipliers.
//!
//! What is allowed is measured by the growth of a small change. Each state follows from the seed, the file and a number.

mod expected;
mod gallery;
mod report;
mod start;
mod weighed;

pub use gallery::{Freed, LEFT_OUT, MECHANISMS};
pub use report::{Tally, report};

use linkwright::Blocks;
use linkwright_solver::{Interpreted, Simulation};
use nalgebra::DVector;

use crate::forces::systems;
use crate::multipliers::Multipliers;
use crate::random::Random;
use crate::simulated::{interpreted, options};
use expected::{Expected, TIME, frame};
use start::{Places, Start};
use weighed::Weighed;

/// The relative tolerances of simulations.
pub const TOLERANCES: [f64; 2] = [1e-7, 1e-10];

/// Largest error of a right motion, in tolerances × growth.
pub const ALLOWED: f64 = 100.0;

/// Most starts that are drawn for a state: where some equations are solved by iteration, poses far from the drawing are not always found.
const DRAWS: usize = 20;

/// The end of a simulation.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// It went to the end, with this error in tolerances × growth.
    Went(f64),
    /// It ended with a typed error, or did not begin.
    Ended(String),
    /// It went to the end, and there is no reference for this reason.
    NotCompared(&'static str),
}

/// A simulation that is judged.
#[derive(Clone, Debug)]
pub struct Verdict {
    /// The mechanism.
    pub file: &'static str,
    /// The number of its state.
    pub state: u64,
    /// The determinant of what is free at the start, with gradients of length 1 on an orthonormal basis of what the joints allow.
    pub determinant: f64,
    /// The relative tolerance.
    pub relative: f64,
    /// Its end.
    pub outcome: Outcome,
}

impl Verdict {
    /// True if it went to its end with an error that is too large, or is no number.
    pub fn is_wrong(&self) -> bool {
        match self.outcome {
            Outcome::Went(missed) => missed.is_nan() || missed > ALLOWED,
            _ => false,
        }
    }
}

impl Freed {
    /// Judges a state at relative tolerances; empty where no start is found.
    pub fn judged(&'static self, seed: u64, state: u64, tolerances: &[f64]) -> Vec<Verdict> {
        let (mut random, weighed, start) = self.state(seed, state);
        start.map_or(Vec::new(), |start| {
            let judge = Judge::new(&weighed, &start);
            judge.verdicts(self.file, state, &start, tolerances, &mut random)
        })
    }

    /// The description of a state; `None` where no start is found.
    pub fn text(&'static self, seed: u64, state: u64) -> Option<String> {
        let (_, weighed, start) = self.state(seed, state);
        Some(weighed.started(&start?.values))
    }

    fn state(&'static self, seed: u64, state: u64) -> (Random, Weighed, Option<Start>) {
        let own = self.file.bytes().fold(seed, |sum, byte| {
            Random::new(sum.wrapping_add(u64::from(byte))).bits()
        });
        let mut random = Random::new(own.wrapping_add(state));
        let weighed = Weighed::new(self, &mut random);
        let places = Places::new(self, &weighed);
        let start = (0..DRAWS).find_map(|_| places.start(&mut random));
        (random, weighed, start)
    }
}

/// A mechanism at a start, and its reference.
struct Judge {
    view: Interpreted,
    reference: Multipliers,
}

impl Judge {
    fn new(weighed: &Weighed, start: &Start) -> Judge {
        let view = interpreted(&weighed.started(&start.values));
        let regular = &systems("regular", &weighed.regular(&start.values))[0];
        let reference = Multipliers::new(regular, &weighed.weights(regular), weighed.gravity);
        Judge { view, reference }
    }

    fn verdicts(
        &self,
        file: &'static str,
        state: u64,
        start: &Start,
        tolerances: &[f64],
        random: &mut Random,
    ) -> Vec<Verdict> {
        let mut expected: Option<Result<Expected, &'static str>> = None;
        let pose = DVector::from_column_slice(start.instant.q());
        let determinant = self.reference.determinant(&pose);
        let verdicts = tolerances.iter().map(|&relative| Verdict {
            file,
            state,
            determinant,
            relative,
            outcome: self.outcome(start, relative, &mut expected, random),
        });
        verdicts.collect()
    }

    fn outcome(
        &self,
        start: &Start,
        relative: f64,
        expected: &mut Option<Result<Expected, &'static str>>,
        random: &mut Random,
    ) -> Outcome {
        let chosen = Some((start.instant.clone(), self.view.drawn_branches()));
        let simulation = Simulation::new(&self.view, chosen, TIME, options(relative));
        let mut simulation = match simulation {
            Ok(simulation) => simulation,
            Err(stop) => return Outcome::Ended(format!("{stop:?}")),
        };
        let start = frame(&simulation);
        let expected =
            expected.get_or_insert_with(|| Expected::of(&self.reference, &start, random));
        match expected {
            Ok(expected) => match expected.missed(&mut simulation, relative) {
                Ok(missed) => Outcome::Went(missed),
                Err(stop) => Outcome::Ended(stop),
            },
            Err(reason) => match simulation.advance(TIME) {
                Ok(_) => Outcome::NotCompared(reason),
                Err(stop) => Outcome::Ended(format!("{stop:?}")),
            },
        }
    }
}
