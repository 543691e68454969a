//! *A mechanism with free coordinates, and the forces on it* → *its motion*.
//!
//! What is integrated are the free coordinates s and their rates, s̈ = mass⁻¹ force; all else follows from them by the blocks, so that every
//! frame lies on the constraints to rounding, and no equation of constraint is ever integrated. A step counts once the shell has
//! followed it: the motion stays on its path, and ends with a failure where that ends. The work of everything that is not stored is
//! integrated beside, without a say in the length of steps. Deliberately unknown here: files and how anything is printed.

mod beyond;
mod change;
mod freedom;
mod reduced;
mod right_side;
mod stop;

pub use crate::dormand_prince::Tolerances;
pub use change::{Change, Hindrance};
pub use reduced::ReducedMotion;
pub use stop::Stop;

use change::{Changed, Changing, hindrance};
use linkwright::{Blocks, Shell, Signal};
use right_side::RightSide;

use crate::dormand_prince::{Rates, Step, first_length};
use crate::instant::Instant;
use crate::interpreted::Interpreted;
use crate::supplied::{InputSignals, Modes, Numbers};
use crate::trajectory::END;
use crate::view::View;

/// How much shorter a step is tried again that leads to where nothing can be solved.
const RETREAT: f64 = 0.25;

/// The same where it leads to where a free coordinate is too unsteady.
const HALF: f64 = 0.5;

/// How a motion is integrated.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// How accurate a step has to be.
    pub tolerances: Tolerances,
    /// Whether it goes straight on through poses in which several blocks are singular at once.
    pub goes_through: bool,
    /// Whether another coordinate takes the place of a free one that is about to stand still while the mechanism moves.
    pub changes: bool,
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
    /// Where integration has begun, or gone on in another coordinate (s).
    origin: f64,
    state: Vec<f64>,
    slope: Vec<f64>,
    changing: Option<Changing>,
    /// The length of the next step (s).
    length: f64,
    /// The step that the mechanism is on.
    step: Option<Step>,
    steps: u64,
    rejected: u64,
    passed: Vec<[f64; 2]>,
}

impl Simulation {
    /// The mechanism where it starts, at t = 0: as it is drawn, or in the given pose and modes.
    ///
    /// # Errors
    /// It cannot be assembled, or has no acceleration there.
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
        let shell = shell.map_err(Stop::NotAssembled)?;
        let mut right_side = RightSide::new(shell, motion, options.goes_through);
        let mut slope = vec![0.0; state.len()];
        right_side.rates(0.0, &state, &mut slope)?;
        let count = right_side.judged() / 2;
        let inputs = right_side.inputs(0.0, &state, &slope[count..2 * count]);
        right_side.follow(0.0, &inputs).map_err(Stop::Unsolvable)?;
        let mut simulation = Simulation {
            right_side,
            options,
            end,
            origin: 0.0,
            state,
            slope,
            changing: options.changes.then(|| Changing::new(view)),
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
            let end = self.step.as_ref().map_or(self.origin, |step| step.to);
            if t <= end {
                break;
            }
            self.follow(end)?;
            self.change(end);
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

    /// Lets another coordinate take the place of one that is about to stand still, at a time at which the mechanism is.
    fn change(&mut self, t: f64) {
        let state = match &self.step {
            Some(step) => step.end(),
            None => &self.state,
        };
        let changing = self.changing.as_mut();
        let changed = changing.and_then(|it| it.see(&self.right_side, state));
        if let Some(changed) = changed {
            let Changed {
                right_side,
                state,
                slope,
                ..
            } = changed;
            (self.right_side, self.state, self.slope) = (right_side, state, slope);
            (self.origin, self.step) = (t, None);
        }
    }

    /// Whether a step ends where what is free is too unsteady to be exchanged.
    fn is_too_far(&mut self, step: &Step) -> bool {
        let Some(changing) = &self.changing else {
            return false;
        };
        self.right_side.evaluations += 1;
        let inputs = self.right_side.inputs(step.to, step.end(), &[]);
        let frame = self.right_side.frame(step.to, 0.0, &inputs);
        frame.is_ok_and(|(end, _)| changing.is_too_far(self.view(), &end))
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
                    if is_taken && self.is_too_far(&step) {
                        self.length = HALF * (to - from);
                    } else if is_taken {
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
            None => Ok(self.state[place]),
        }
    }

    /// What keeps the motion from going on in what is free, where it has ended.
    pub fn hindrance(&self) -> Option<Hindrance> {
        hindrance(self.view(), self.frame())
    }

    /// The changes of free coordinates so far.
    pub fn changes(&self) -> &[Change] {
        self.changing.as_ref().map_or(&[], |it| &it.changes)
    }

    /// The times between which singular poses were passed.
    pub fn passed(&self) -> &[[f64; 2]] {
        &self.passed
    }
}
