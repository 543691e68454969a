//! *Time, free coordinates and their rates* → *their accelerations, and the power of what stores no work*.
//!
//! Near a pose that is singular, rates and accelerations of the bodies lose digits by the square and the cube of the distance, while the
//! acceleration of what is free is a smooth function of it: there it is interpolated between poses on both sides that lose none. They lie
//! on the line along the rates.

use linkwright::{Failure, Shell, Signal};

use super::beyond::{close_blocks, straight_on};
use super::reduced::ReducedMotion;
use super::stop::Stop;
use crate::dormand_prince::Rates;
use crate::instant::Instant;
use crate::interpreted::Interpreted;
use crate::measures::Measures;
use crate::supplied::{InputLaws, InputSignals, Modes};
use crate::view::View;

/// The measure below which a pose is close to a singular one.
const CLOSE: f64 = 0.15;

/// Where accelerations are taken on both sides of a singular pose, in units of how far a close pose is at most.
const NODES: [f64; 6] = [1.0, 1.3, 1.6, 1.9, 2.2, 2.5];

/// The rates of free coordinates, their rates and the work.
#[derive(Clone, Debug)]
pub(super) struct RightSide {
    pub shell: Shell<Interpreted>,
    pub motion: ReducedMotion,
    laws: InputLaws,
    measures: Option<Measures>,
    goes_through: bool,
    /// The mechanism at its last frame that was not close to a singular pose.
    clear: Shell<Interpreted>,
    pub evaluations: u64,
    /// Where forces keep the power that is added, where that is asked for.
    added: Option<usize>,
}

impl RightSide {
    /// Of a mechanism where it starts.
    pub fn new(shell: Shell<Interpreted>, motion: ReducedMotion, goes_through: bool) -> RightSide {
        let view = shell.blocks();
        let names = crate::forces::names(view.system());
        RightSide {
            laws: view.input_laws(),
            measures: view.measures(),
            added: names.iter().position(|(name, _)| name == "added_power"),
            clear: shell.clone(),
            evaluations: 0,
            shell,
            motion,
            goes_through,
        }
    }

    /// The same of a mechanism in which other coordinates are free.
    pub fn with(&self, shell: Shell<Interpreted>, motion: ReducedMotion) -> RightSide {
        RightSide {
            evaluations: self.evaluations,
            ..RightSide::new(shell, motion, self.goes_through)
        }
    }

    /// All inputs at a time; those of the free coordinates as a state has them.
    pub fn inputs(&self, t: f64, state: &[f64], accelerations: &[f64]) -> InputSignals {
        let count = self.motion.inputs.len();
        let mut inputs = self.laws.at(t);
        for (place, &input) in self.motion.inputs.iter().enumerate() {
            let acceleration = accelerations.get(place).copied().unwrap_or(0.0);
            inputs.0[input] = Signal::new(state[place], state[count + place], acceleration);
        }
        inputs
    }

    /// The frame at a time to which the last clear frame leads straight on, and its modes; `ahead` is how much farther on its way the mechanism
    /// is than its time says. Whether a path leads there is looked at once the step is taken: where it does not, this frame was never seen.
    pub fn frame(
        &self,
        t: f64,
        ahead: f64,
        inputs: &InputSignals,
    ) -> Result<(Instant, Modes), Failure> {
        let last = self.clear.frame();
        let time = t + ahead - last.t();
        let measures = self.measures.as_ref();
        let close = measures.map_or(Vec::new(), |measures| {
            close_blocks(measures, self.clear.blocks(), last, time)
        });
        straight_on(&self.clear, &close, (t, time), inputs)
    }

    /// Moves the mechanism to a time; whether that took it through a singular pose.
    ///
    /// # Errors
    /// No path leads there.
    pub fn follow(&mut self, t: f64, inputs: &InputSignals) -> Result<bool, Failure> {
        let before = self.shell.branches().clone();
        if t == self.shell.frame().t() {
            let frame = self.shell.frame_at(t, inputs)?;
            self.shell.resume(&frame, &before, inputs);
        } else if let Err(failure) = self.shell.advance(t, inputs) {
            if !self.goes_through {
                return Err(failure);
            }
            let (frame, modes) = self.frame(t, 0.0, inputs)?;
            if modes == before {
                return Err(failure);
            }
            self.shell.resume(&frame, &modes, inputs);
        }
        if self.meeting(self.shell.frame()).is_none() {
            self.clear = self.shell.clone();
        }
        Ok(*self.shell.branches() != before)
    }

    /// How long ago, or when, the mechanism would be singular on its way, and for how long it is close to that; `None` where it is not
    /// close.
    fn meeting(&self, frame: &Instant) -> Option<[f64; 2]> {
        let measures = self.measures.as_ref()?;
        let samples = measures.at(frame);
        let parts = measures.parts().iter().zip(samples);
        let own = parts.filter(|(part, _)| !part.is_relative);
        let (_, [size, rate]) = own.min_by(|(_, one), (_, other)| {
            let [one, other] = [one, other].map(|it| it[0].abs());
            one.total_cmp(&other)
        })?;
        (size.abs() < CLOSE && rate != 0.0).then(|| [-size / rate, CLOSE / rate.abs()])
    }

    /// What rates are made of in a pose.
    fn found(&self, t: f64, frame: &Instant) -> Result<Vec<f64>, Stop> {
        let found = self.motion.acceleration(frame);
        let found = found.map_err(|coordinate| Stop::Massless { t, coordinate })?;
        let mut values = found.as_slice().to_vec();
        let forces = self.shell.blocks().forces(frame);
        let power = self.added.and_then(|place| Some(forces?[place]));
        values.push(power.unwrap_or(0.0));
        Ok(values)
    }

    /// The same of a pose close to a singular one, between poses on both sides of it; `None` where there are none.
    fn interpolated(&mut self, t: f64, state: &[f64], meeting: [f64; 2]) -> Option<Vec<f64>> {
        let count = self.motion.inputs.len();
        let [middle, width] = meeting;
        let nodes = NODES.iter().rev().map(|node| -node).chain(NODES);
        let nodes: Vec<f64> = nodes.map(|node| middle + node * width).collect();
        let (mut table, mut modes) = (Vec::with_capacity(nodes.len()), Vec::new());
        for &ahead in &nodes {
            let mut moved = state.to_vec();
            for place in 0..count {
                moved[place] += ahead * state[count + place];
            }
            self.evaluations += 1;
            let inputs = self.inputs(t, &moved, &[]);
            let (frame, own) = self.frame(t, ahead, &inputs).ok()?;
            table.push(self.found(t, &frame).ok()?);
            modes.push(own);
        }
        // Both sides are those of one meeting, and each is the same throughout.
        let half = NODES.len();
        let [before, beyond] = [&modes[..half], &modes[half..]];
        let is_one = |modes: &[Modes]| modes.iter().all(|it| *it == modes[0]);
        if !is_one(before) || !is_one(beyond) || before[0] == beyond[0] {
            return None;
        }
        // Neville's scheme at the state itself.
        for order in 1..nodes.len() {
            for at in 0..nodes.len() - order {
                let [from, to] = [nodes[at], nodes[at + order]];
                for component in 0..table[at].len() {
                    let [one, other] = [table[at][component], table[at + 1][component]];
                    table[at][component] = (to * one - from * other) / (to - from);
                }
            }
        }
        Some(table.swap_remove(0))
    }
}

impl Rates for RightSide {
    type Failure = Stop;

    fn rates(&mut self, t: f64, state: &[f64], rates: &mut [f64]) -> Result<(), Stop> {
        let count = self.motion.inputs.len();
        self.evaluations += 1;
        let inputs = self.inputs(t, state, &[]);
        let (frame, _) = self.frame(t, 0.0, &inputs).map_err(Stop::Unsolvable)?;
        let meeting = self.meeting(&frame);
        let between = meeting.and_then(|meeting| self.interpolated(t, state, meeting));
        let found = match between {
            Some(found) => found,
            None => self.found(t, &frame)?,
        };
        rates[..count].copy_from_slice(&state[count..2 * count]);
        rates[count..].copy_from_slice(&found);
        match rates.iter().all(|rate| rate.is_finite()) {
            true => Ok(()),
            false => Err(Stop::NotFinite { t }),
        }
    }

    fn judged(&self) -> usize {
        2 * self.motion.inputs.len()
    }
}
