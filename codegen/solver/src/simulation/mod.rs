//! *A mechanism with free coordinates, and the forces on it* → *its motion*.
//!
//! What is integrated are the free coordinates s and their rates, s̈ = mass⁻¹ force; all else follows from them by the blocks, so that every
//! frame lies on the constraints to rounding, and no equation of constraint is ever integrated. A step counts once the shell has
//! followed it: the motion stays on its path, and ends with a failure where that ends. The work of everything that is not stored is
//! integrated beside, without a say in the length of steps. Deliberately unknown here: files and how anything is printed.

mod beyond;
mod reduced;
mod stop;

pub use crate::dormand_prince::Tolerances;
pub use reduced::ReducedMotion;
pub use stop::Stop;

use linkwright::{Blocks, Failure, Shell, Signal};

use crate::dormand_prince::{Rates, Step, first_length};
use crate::instant::Instant;
use crate::interpreted::Interpreted;
use crate::measures::Measures;
use crate::supplied::{InputLaws, InputSignals, Modes, Numbers};
use crate::trajectory::END;
use crate::view::View;

/// How much shorter a step is tried again that leads to where nothing can be solved.
const RETREAT: f64 = 0.25;

/// How a motion is integrated.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// How accurate a step has to be.
    pub tolerances: Tolerances,
    /// Whether it goes straight on through poses in which several blocks are singular at once.
    pub goes_through: bool,
}

/// What a motion has taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Effort {
    /// How often the mechanism was solved for an acceleration.
    pub evaluations: u64,
    /// Steps that were taken.
    pub steps: u64,
    /// Steps that were tried and not taken.
    pub rejected: u64,
}

/// A mechanism that forces move.
#[derive(Clone, Debug)]
pub struct Simulation {
    right_side: RightSide,
    options: Options,
    /// When the motion ends (s): no step goes beyond.
    end: f64,
    state: Vec<f64>,
    slope: Vec<f64>,
    /// The length of the next step (s).
    length: f64,
    /// The step that the mechanism is on.
    step: Option<Step>,
    steps: u64,
    rejected: u64,
    passed: Vec<[f64; 2]>,
}

/// The rates of free coordinates, their rates and the work.
#[derive(Clone, Debug)]
struct RightSide {
    shell: Shell<Interpreted>,
    motion: ReducedMotion,
    laws: InputLaws,
    measures: Option<Measures>,
    goes_through: bool,
    evaluations: u64,
    /// Where forces keep the power that is added, where that is asked for.
    added: Option<usize>,
}

impl RightSide {
    /// All inputs at a time; those of the free coordinates as a state has them.
    fn inputs(&self, t: f64, state: &[f64], accelerations: &[f64]) -> InputSignals {
        let count = self.motion.inputs.len();
        let mut inputs = self.laws.at(t);
        for (place, &input) in self.motion.inputs.iter().enumerate() {
            let acceleration = accelerations.get(place).copied().unwrap_or(0.0);
            inputs.0[input] = Signal::new(state[place], state[count + place], acceleration);
        }
        inputs
    }

    /// The frame at a time, on the path that leads there straight from the frame of the shell.
    fn frame(&self, t: f64, inputs: &InputSignals) -> Result<Instant, Failure> {
        let last = self.shell.frame();
        let close = self.close(t);
        if close.is_empty() || t == last.t() {
            return self.shell.frame_at(t, inputs);
        }
        let mut ahead = self.shell.clone();
        match ahead.advance(t, inputs) {
            Ok(frame) => Ok(frame.clone()),
            Err(failure) => match self.goes_through {
                true => beyond::straight_on(&self.shell, &close, t, inputs)
                    .map(|(frame, _)| frame)
                    .ok_or(failure),
                false => Err(failure),
            },
        }
    }

    /// The blocks that may be close to a singular pose at a time.
    fn close(&self, t: f64) -> Vec<usize> {
        let frame = self.shell.frame();
        let view = self.shell.blocks();
        let measures = self.measures.as_ref();
        measures.map_or(Vec::new(), |measures| {
            beyond::close_blocks(measures, view, frame, t - frame.t())
        })
    }

    /// Moves the mechanism to a time; whether that took it through a singular pose.
    fn follow(&mut self, t: f64, inputs: &InputSignals) -> Result<bool, Failure> {
        if t == self.shell.frame().t() {
            let (frame, modes) = (
                self.shell.frame_at(t, inputs)?,
                self.shell.branches().clone(),
            );
            self.shell.resume(&frame, &modes, inputs);
            return Ok(false);
        }
        let before = self.shell.branches().clone();
        let close = self.close(t);
        match self.shell.advance(t, inputs) {
            Ok(_) => Ok(*self.shell.branches() != before),
            Err(failure) if self.goes_through => {
                let found = beyond::straight_on(&self.shell, &close, t, inputs);
                let (frame, modes) = found.filter(|(_, it)| *it != before).ok_or(failure)?;
                self.shell.resume(&frame, &modes, inputs);
                Ok(true)
            }
            Err(failure) => Err(failure),
        }
    }
}

impl Rates for RightSide {
    type Failure = Stop;

    fn rates(&mut self, t: f64, state: &[f64], rates: &mut [f64]) -> Result<(), Stop> {
        self.evaluations += 1;
        let count = self.motion.inputs.len();
        let inputs = self.inputs(t, state, &[]);
        let frame = self.frame(t, &inputs).map_err(Stop::Unsolvable)?;
        let found = self.motion.acceleration(&frame);
        let accelerations = found.map_err(|coordinate| Stop::Massless { t, coordinate })?;
        rates[..count].copy_from_slice(&state[count..2 * count]);
        rates[count..2 * count].copy_from_slice(accelerations.as_slice());
        let forces = self.shell.blocks().forces(&frame);
        let power = self.added.and_then(|place| Some(forces?[place]));
        rates[2 * count] = power.unwrap_or(0.0);
        match rates.iter().all(|rate| rate.is_finite()) {
            true => Ok(()),
            false => Err(Stop::NotFinite { t }),
        }
    }

    fn judged(&self) -> usize {
        2 * self.motion.inputs.len()
    }
}

impl Simulation {
    /// The mechanism where it starts, at t = 0: as it is drawn, or in the given pose and modes.
    ///
    /// # Errors
    /// It cannot be assembled, or has no acceleration there.
    ///
    /// # Panics
    /// Never: a view without a free coordinate is [`Stop::NothingFree`].
    pub fn new(
        view: &Interpreted,
        chosen: Option<(Instant, Modes)>,
        end: f64,
        options: Options,
    ) -> Result<Simulation, Stop> {
        let motion = ReducedMotion::new(view.program(), view.layout()).ok_or(Stop::NothingFree)?;
        let (laws, parameters) = (view.input_laws(), view.nominal_parameters());
        let (pose, modes) = match chosen {
            Some((instant, modes)) => (Numbers(instant.q().to_vec()), modes),
            None => (view.drawn_pose(&parameters), view.drawn_branches()),
        };
        let inputs = laws.at(0.0);
        let start = motion.inputs.iter().map(|&input| inputs.0[input]);
        let start: Vec<Signal> = start.collect();
        let mut state: Vec<f64> = start.iter().map(|signal| signal.value).collect();
        state.extend(start.iter().map(|signal| signal.rate));
        state.push(0.0);
        let shell = Shell::assemble(
            view.clone(),
            &parameters,
            &pose,
            modes,
            0.0,
            &inputs,
            Default::default(),
        );
        let names = crate::forces::names(view.system());
        let mut right_side = RightSide {
            shell: shell.map_err(Stop::NotAssembled)?,
            measures: view.measures(),
            added: names.iter().position(|(name, _)| name == "added_power"),
            goes_through: options.goes_through,
            evaluations: 0,
            motion,
            laws,
        };
        let mut slope = vec![0.0; state.len()];
        right_side.rates(0.0, &state, &mut slope)?;
        let count = right_side.judged() / 2;
        let inputs = right_side.inputs(0.0, &state, &slope[count..2 * count]);
        right_side.follow(0.0, &inputs).map_err(Stop::Unsolvable)?;
        let mut simulation = Simulation {
            right_side,
            options,
            end,
            state,
            slope,
            length: end,
            step: None,
            steps: 0,
            rejected: 0,
            passed: Vec::new(),
        };
        if end > 0.0 {
            simulation.length = simulation.first_length()?;
        }
        Ok(simulation)
    }

    /// The first step is tried shorter where there is nothing to be solved at its end.
    fn first_length(&mut self) -> Result<f64, Stop> {
        let Simulation {
            right_side,
            options,
            end,
            state,
            slope,
            ..
        } = self;
        let mut longest = *end;
        loop {
            match first_length(right_side, 0.0, state, slope, longest, &options.tolerances) {
                Ok(length) => return Ok(length),
                Err(stop) if longest <= END => return Err(stop),
                Err(_) => longest *= RETREAT,
            }
        }
    }

    /// Moves the mechanism to a later time, up to the end of the motion (s).
    ///
    /// # Errors
    /// The motion ends before; the mechanism is then at its last frame.
    pub fn advance(&mut self, t: f64) -> Result<&Instant, Stop> {
        loop {
            let end = self.step.as_ref().map_or(0.0, |step| step.to);
            if t <= end || self.step.is_none() && t <= 0.0 {
                break;
            }
            self.follow(end)?;
            self.take_step(end)?;
        }
        self.follow(t)?;
        Ok(self.frame())
    }

    /// Moves the mechanism along the step that it is on.
    fn follow(&mut self, t: f64) -> Result<(), Stop> {
        let from = self.frame().t();
        if t == from {
            return Ok(());
        }
        let inputs = self.inputs(t)?;
        match self.right_side.follow(t, &inputs) {
            Ok(false) => Ok(()),
            Ok(true) => {
                self.passed.push([from, t]);
                Ok(())
            }
            Err(failure) => {
                self.approach(failure.time.clamp(from, t));
                Err(Stop::Unsolvable(failure))
            }
        }
    }

    /// All inputs at a time on the step, with the acceleration that the forces give.
    fn inputs(&mut self, t: f64) -> Result<InputSignals, Stop> {
        let count = self.right_side.judged() / 2;
        let Some(step) = &mut self.step else {
            return Ok(self
                .right_side
                .inputs(t, &self.state, &self.slope[count..2 * count]));
        };
        if t == step.to {
            let accelerations = &step.end_rates()[count..2 * count];
            return Ok(self.right_side.inputs(t, step.end(), accelerations));
        }
        let state = step.at(&mut self.right_side, t)?;
        let mut rates = vec![0.0; state.len()];
        self.right_side.rates(t, &state, &mut rates)?;
        Ok(self.right_side.inputs(t, &state, &rates[count..2 * count]))
    }

    /// Moves the mechanism as close as possible to a time that it cannot reach.
    fn approach(&mut self, mut beyond: f64) {
        loop {
            let t = self.frame().t();
            let middle = t + 0.5 * (beyond - t);
            if (beyond - t).abs() <= END * beyond.abs().max(1.0) || middle == t || middle == beyond
            {
                return;
            }
            let inputs = self.inputs(middle);
            let followed = inputs.map(|inputs| self.right_side.follow(middle, &inputs));
            if !matches!(followed, Ok(Ok(_))) {
                beyond = middle;
            }
        }
    }

    /// Takes a step from a time at which the mechanism is.
    fn take_step(&mut self, from: f64) -> Result<(), Stop> {
        if let Some(step) = &self.step {
            self.state = step.end().to_vec();
            self.slope = step.end_rates().to_vec();
        }
        let mut held = false;
        let mut reason = None;
        loop {
            let is_last = from + self.length >= self.end;
            let to = if is_last {
                self.end
            } else {
                from + self.length
            };
            if to - from <= END * from.abs().max(1.0) && !is_last || to == from {
                return Err(reason.unwrap_or(Stop::TooShort { t: from }));
            }
            let tried = Step::attempt(
                &mut self.right_side,
                [from, to],
                &self.state,
                &self.slope,
                &self.options.tolerances,
            );
            let finished = tried.and_then(|mut step| {
                if step.error <= 1.0 {
                    step.finish(&mut self.right_side)?;
                }
                Ok(step)
            });
            match finished {
                Ok(step) => {
                    let is_taken = step.error <= 1.0;
                    self.length = step.next_length(held || !is_taken);
                    if is_taken {
                        self.steps += 1;
                        self.step = Some(step);
                        return Ok(());
                    }
                }
                Err(stop) => {
                    self.length = RETREAT * (to - from);
                    reason = Some(stop);
                }
            }
            self.rejected += 1;
            held = true;
        }
    }

    /// The frame that was reached.
    pub fn frame(&self) -> &Instant {
        self.right_side.shell.frame()
    }

    /// The mechanism.
    pub fn view(&self) -> &Interpreted {
        self.right_side.shell.blocks()
    }

    /// The reduced mass and force.
    pub fn motion(&self) -> &ReducedMotion {
        &self.right_side.motion
    }

    /// What it has taken so far.
    pub fn effort(&self) -> Effort {
        Effort {
            evaluations: self.right_side.evaluations,
            steps: self.steps,
            rejected: self.rejected,
        }
    }

    /// The work (J) that everything has added that stores none, up to the frame that was reached: of dampers, forces and torques, where
    /// energies are asked for.
    ///
    /// # Errors
    /// It cannot be said between the ends of a step near which nothing can be solved.
    pub fn added_work(&mut self) -> Result<f64, Stop> {
        let t = self.frame().t();
        let place = self.right_side.judged();
        match &mut self.step {
            Some(step) => Ok(step.at(&mut self.right_side, t)?[place]),
            None => Ok(0.0),
        }
    }

    /// The times between which singular poses were passed.
    pub fn passed(&self) -> &[[f64; 2]] {
        &self.passed
    }
}
