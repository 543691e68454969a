//! Simulates a mechanism with free coordinates under its forces.
//!
//! The integrated variables are coordinates of the null space of Φ_q at a recent pose, and their rates (tangent-space parametrization;
//! Wehage and Haug 1982, Potra and Rheinboldt 1991). Free coordinates are unknowns in Φ_q. Every frame lies on the constraints to
//! rounding, and the choice of free coordinates does not matter. The work of everything that adds or removes energy is integrated as
//! well: a motion whose energy is out of balance ends. Steps are explicit, or implicit while the motion is stiff.

mod balance;
mod chart;
mod crossing;
mod elongations;
mod equations;
mod massless;
mod method;
mod next_step;
mod reduced;
mod right_side;
mod rounding;
mod solved;
mod stop;
mod straight;

pub(crate) use equations::MotionEquations;
pub use equations::Varied;

pub use crate::tolerances::Tolerances;
pub use method::Method;
pub use reduced::ReducedMotion;
pub use stop::Stop;

use balance::Balance;
use crossing::Crossing;
use linkwright::{Blocks, Shell};
use method::{Chosen, Step};
use right_side::RightSide;
use rounding::Rounding;
use solved::Solved;

use crate::dense::Dense;
use crate::dormand_prince::first_length;
use crate::instant::Instant;
use crate::interpreted::Interpreted;
use crate::supplied::{Modes, Numbers};
use crate::trajectory::END_PRECISION;
use crate::view::View;

/// Factor of the length of a step that leads to a state without a solution, for the next attempt.
const RETREAT: f64 = 0.25;

/// SimulationOptions of an integration.
#[derive(Clone, Copy, Debug)]
pub struct SimulationOptions {
    /// Tolerances of a step.
    pub tolerances: Tolerances,
    /// Method of the steps.
    pub method: Method,
}

/// Cost of a motion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Effort {
    /// Number of solutions for an acceleration.
    pub evaluations: u64,
    /// Number of accepted steps.
    pub steps: u64,
    /// Number of implicit steps among them.
    pub implicit: u64,
    /// Number of rejected steps.
    pub rejected: u64,
}

/// Segment of the motion around the current time.
#[derive(Clone, Debug)]
enum Segment {
    Step(Box<Step>),
    Crossing(Box<Crossing>),
}

/// Mechanism that forces move.
///
/// ```
/// use linkwright_codegen::Source;
/// use linkwright_solver::{Interpreted, Method, Simulation, SimulationOptions, Tolerances};
///
/// // A point mass on a rod of 2 m, released at a small angle from its lowest position: T = 2π √(l / g).
/// let text = "
///     mechanism pendulum {
///         point O = (0, 0);
///         body bob at O { O, S: (0, -2) }
///         revolute O(ground, bob);
///         free swing: phi(bob) = 0.001 rate 0;
///         mass bob = 3kg at S;
///         gravity = (0, -9.81);
///     }";
/// let read = linkwright_codegen::read(&Source::new("pendulum.mech", text)).expect("no errors");
/// let blocks = Interpreted::new(&read.motions[0]).expect("the equations determine the motion");
/// let period = std::f64::consts::TAU * (2.0_f64 / 9.81).sqrt();
/// let options = SimulationOptions {
///     tolerances: Tolerances { relative: 1e-9, absolute: 1e-12 },
///     method: Method::Automatic,
/// };
/// let mut pendulum = Simulation::new(&blocks, None, period, options).expect("it starts");
/// let half = pendulum.advance(0.5 * period).expect("it moves").q()[2];
/// assert!((half + 0.001).abs() < 1e-8);
/// ```
#[derive(Clone, Debug)]
pub struct Simulation {
    view: Dense,
    right_side: RightSide,
    options: SimulationOptions,
    /// End of the motion (s), which no step exceeds.
    end: f64,
    state: Vec<f64>,
    slope: Vec<f64>,
    /// Length of the next step (s).
    length: f64,
    segment: Option<Segment>,
    /// Frame at the end of the segment, or at the start.
    reached: Instant,
    /// Frame of the last request.
    frame: Instant,
    balance: Balance,
    rounding: Rounding,
    method: Chosen,
    steps: u64,
    implicit: u64,
    rejected: u64,
    /// Distance from the loss of rank at which a crossing last failed.
    tried: f64,
    passed: Vec<[f64; 2]>,
}

impl Simulation {
    /// Assembles the mechanism at t = 0, in the design configuration or in a pose and modes.
    ///
    /// # Errors
    /// The mechanism cannot be assembled, or has no acceleration.
    pub fn new(
        view: &Interpreted,
        chosen: Option<(Instant, Modes)>,
        end: f64,
        options: SimulationOptions,
    ) -> Result<Simulation, Stop> {
        let motion = ReducedMotion::of(view).ok_or(Stop::NothingFree)?;
        let parameters = view.nominal_parameters();
        let (pose, modes) = match chosen {
            Some((instant, modes)) => (Numbers(instant.q().to_vec()), modes),
            None => (view.drawn_pose(&parameters), view.drawn_branches()),
        };
        let inputs = view.input_laws().at(0.0);
        let settings = Default::default();
        let shell = Shell::assemble(
            view.clone(),
            &parameters,
            &pose,
            modes,
            0.0,
            &inputs,
            settings,
        );
        let shell = shell.map_err(Stop::NotAssembled)?;
        let massless = |places: Vec<usize>| Stop::Massless {
            t: 0.0,
            coordinates: places,
        };
        motion.acceleration(shell.frame()).map_err(massless)?;
        let system = view.system();
        let equations = MotionEquations::new(view.pool(), system).ok_or(Stop::NothingFree)?;
        let mut start = equations.instant(0.0);
        start.set_frame(&shell.frame().frame());
        let right_side = RightSide::new(equations, &start);
        let mut right_side = right_side.ok_or(Stop::LosesRank { t: 0.0 })?;
        let mut state = right_side.state(&start);
        state.push(0.0);
        let solved = right_side.solve(0.0, &state)?;
        let mut simulation = Simulation {
            view: Dense::moved_by_forces(view.derived()),
            right_side,
            options,
            end,
            slope: Vec::new(),
            state,
            length: end,
            segment: None,
            reached: solved.instant.clone(),
            frame: solved.instant.clone(),
            balance: Balance::new(solved.energies),
            rounding: Rounding::new(),
            method: Chosen::new(options.method),
            steps: 0,
            implicit: 0,
            rejected: 0,
            tried: f64::INFINITY,
            passed: Vec::new(),
        };
        simulation.begin(&solved, 0.0)?;
        if end > 0.0 {
            simulation.length = simulation.first_length()?;
        }
        Ok(simulation)
    }

    /// Changes to a chart around a frame, with the state of the mechanism in the chart.
    fn begin(&mut self, solved: &Solved, work: f64) -> Result<(), Stop> {
        let right_side = &mut self.right_side;
        let t = solved.instant.t();
        right_side
            .enter(&solved.instant, self.method.is_implicit())
            .ok_or(Stop::LosesRank { t })?;
        self.state = right_side.state(&solved.instant);
        let count = right_side.chart.dimension();
        self.slope = self.state[count..].to_vec();
        let acceleration = right_side.level(&solved.instant, 2);
        self.slope.extend(acceleration);
        self.slope.push(solved.power);
        self.state.push(work);
        Ok(())
    }

    /// Returns the length of the first step (s), which is reduced while its end has no solution.
    fn first_length(&mut self) -> Result<f64, Stop> {
        let mut longest = self.end;
        loop {
            let tolerances = &self.options.tolerances;
            match first_length(
                &mut self.right_side,
                0.0,
                &self.state,
                &self.slope,
                longest,
                tolerances,
            ) {
                Ok(length) => return Ok(length),
                Err(stop) if longest <= END_PRECISION => return Err(stop),
                Err(_) => longest *= RETREAT,
            }
        }
    }

    /// Moves the mechanism to a later time (s), up to the end of the motion.
    ///
    /// # Errors
    /// The motion ends earlier; the mechanism is then at its last frame.
    pub fn advance(&mut self, t: f64) -> Result<&Instant, Stop> {
        while t > self.reached.t() {
            self.step()?;
        }
        self.show(t)
    }

    /// Takes one step if the reached frame is before `t` (s). Returns true if a step was taken.
    ///
    /// # Errors
    /// The motion ends earlier; the mechanism is then at its last frame.
    pub fn step_toward(&mut self, t: f64) -> Result<bool, Stop> {
        let is_before = t > self.reached.t();
        if is_before {
            self.step()?;
        }
        Ok(is_before)
    }

    fn step(&mut self) -> Result<(), Stop> {
        self.go_on()
            .inspect_err(|_| self.frame = self.reached.clone())
    }

    /// Moves the mechanism to a time on the segment, or at its end.
    fn show(&mut self, t: f64) -> Result<&Instant, Stop> {
        let frame = match t == self.reached.t() {
            true => self.reached.clone(),
            false => self.on_segment(t)?.0,
        };
        match self.view.refused(&frame) {
            Some(failure) => Err(Stop::OutsideRange(failure)),
            None => {
                self.frame = frame;
                Ok(&self.frame)
            }
        }
    }

    /// Returns the frame at a time on the segment, and the work (J).
    fn on_segment(&mut self, t: f64) -> Result<(Instant, f64), Stop> {
        match &mut self.segment {
            Some(Segment::Step(step)) => {
                let state = step.at(&mut self.right_side, t)?;
                let work = state[state.len() - 1];
                Ok((self.right_side.solve(t, &state)?.instant, work))
            }
            Some(Segment::Crossing(crossing)) => Ok(crossing.at(&self.right_side, t)),
            None => Ok((self.reached.clone(), self.state[self.state.len() - 1])),
        }
    }

    /// Frame of the last request.
    pub fn frame(&self) -> &Instant {
        &self.frame
    }

    /// Mechanism in the textbook formulation.
    pub fn view(&self) -> &Dense {
        &self.view
    }

    /// Cost so far.
    #[doc(hidden)]
    pub fn effort(&self) -> Effort {
        Effort {
            evaluations: self.right_side.evaluations,
            steps: self.steps,
            implicit: self.implicit,
            rejected: self.rejected,
        }
    }

    /// Returns the work (J) of dampers, forces, torques and drivers, which store no energy, up to the current frame.
    ///
    /// # Errors
    /// The work is undetermined between the ends of a step near which the equations have no solution.
    pub fn added_work(&mut self) -> Result<f64, Stop> {
        let t = self.frame.t();
        match t == 0.0 {
            true => Ok(0.0),
            false => Ok(self.on_segment(t)?.1),
        }
    }

    /// Intervals of time (s) in which singular poses were passed.
    pub fn passed(&self) -> &[[f64; 2]] {
        &self.passed
    }
}
