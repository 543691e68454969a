//! Moves a mechanism by forces, and checks its energy.

use std::io;
use std::ops::ControlFlow;

use linkwright_solver::number::time;
use linkwright_solver::simulation::Effort;
use linkwright_solver::{
    Dense, Instant, Interpreted, Method, Modes, Schedule, Simulation, SimulationOptions, Stop, View,
};

use super::stopped::Stops;
use super::{EarlyEnd, Followed, Sink, Wanted};

/// Cost of an integration, and its conservation of energy.
#[derive(Clone, Debug, Default)]
pub struct Simulated {
    /// Evaluations and steps.
    pub effort: Effort,
    /// Requested method.
    pub method: Method,
    /// Largest part of a change of energy (J) that the work of forces, torques, dampers and drivers does not explain, and its time (s).
    pub drift: (f64, f64),
    /// Largest kinetic energy (J): the scale of the drift.
    pub kinetic: f64,
}

/// Receivers of the progress of a simulation.
pub struct Listeners<'a> {
    /// Receives the number of visited times of the schedule.
    pub reached: &'a mut dyn FnMut(usize),
    /// Receives the cost of all steps, after each step; a break ends the motion with its reason.
    pub taken: &'a mut dyn FnMut(&Effort) -> ControlFlow<String>,
}

/// End of a simulated motion before its last time.
#[derive(Clone, Debug)]
pub(crate) struct Ending {
    /// Failure; `None` if a listener has ended the motion.
    pub failure: Option<EarlyEnd>,
    /// Reason as a sentence.
    pub reason: String,
}

/// Moves the mechanism to a time, and reports the cost after each step.
///
/// # Errors
/// The motion ends earlier; the mechanism is then at its last frame.
pub fn advance(
    simulation: &mut Simulation,
    t: f64,
    taken: &mut dyn FnMut(&Effort) -> ControlFlow<String>,
) -> Result<(), Ending> {
    let ending = |stop: &Stop, simulation: &Simulation| Ending {
        failure: Some(EarlyEnd::from(stop)),
        reason: stop.explained(simulation.view(), simulation.frame()),
    };
    loop {
        match simulation.step_toward(t) {
            Ok(false) => break,
            Ok(true) => {
                if let ControlFlow::Break(reason) = taken(&simulation.effort()) {
                    let failure = None;
                    return Err(Ending { failure, reason });
                }
            }
            Err(stop) => return Err(ending(&stop, simulation)),
        }
    }
    let stop = simulation.advance(t).err();
    stop.map_or(Ok(()), |stop| Err(ending(&stop, simulation)))
}

impl Followed<Dense> {
    /// Prepares a motion under forces from t = 0 on, from the design configuration or from a chosen pose.
    pub fn moved_by_forces(
        view: &Interpreted,
        wanted: Wanted,
        chosen: Option<(Instant, Modes)>,
    ) -> Followed<Dense> {
        let start = Followed::new(view.clone(), wanted, 0.0, chosen);
        start.seen_by(Dense::moved_by_forces(view.derived()))
    }

    /// Lets the forces move the mechanism from t = 0 over the rest of the schedule, and hands its instants on in the order of time.
    ///
    /// # Errors
    /// Errors of the sinks, which end the motion.
    pub fn simulate(
        &mut self,
        (described, chosen): (&Interpreted, Option<(Instant, Modes)>),
        schedule: &Schedule,
        options: SimulationOptions,
        sinks: &mut [&mut dyn Sink],
        listeners: Listeners<'_>,
    ) -> io::Result<()> {
        if self.error.is_some() {
            return Ok(());
        }
        let visits: Vec<f64> = schedule.forward.visits().map(|visit| visit.t).collect();
        let end = visits.last().copied().unwrap_or(0.0);
        let mut simulation = match Simulation::new(described, chosen, end, options) {
            Ok(simulation) => simulation,
            Err(stop) => {
                self.failure = Some(EarlyEnd::from(&stop));
                self.error = Some(stop.not_begun(described));
                return Ok(());
            }
        };
        let mut simulated = Simulated {
            method: options.method,
            ..Simulated::default()
        };
        let mut first = None;
        let stops = Stops::of(described);
        for t in std::iter::once(0.0).chain(visits) {
            let stopped = stops.as_ref().and_then(|it| it.before(&simulation, t));
            if let Some(stopped) = stopped {
                simulation = stopped.simulation;
                self.warnings.push(stopped.message);
                self.show(simulation.frame(), &[], sinks)?;
                self.weigh(&mut simulation, &mut first, &mut simulated);
                break;
            }
            if t > 0.0 {
                if let Err(ending) = advance(&mut simulation, t, listeners.taken) {
                    self.failure = ending.failure;
                    self.error = Some(ending.reason);
                    break;
                }
                self.visits += 1;
                (listeners.reached)(self.visits);
            }
            self.show(simulation.frame(), &[], sinks)?;
            self.weigh(&mut simulation, &mut first, &mut simulated);
        }
        simulated.effort = simulation.effort();
        self.say_passed(simulation.passed());
        self.simulated = Some(simulated);
        self.finish();
        Ok(())
    }

    /// Compares the energy of a frame with that of the first one.
    fn weigh(&self, simulation: &mut Simulation, first: &mut Option<f64>, found: &mut Simulated) {
        let Some(forces) = self.view.reported(simulation.frame()) else {
            return;
        };
        let value = |name: &str| {
            let place = self.reported_names.iter().position(|(own, _)| own == name);
            place.map_or(0.0, |place| forces[place])
        };
        let kinetic = value("kinetic_energy");
        found.kinetic = found.kinetic.max(kinetic);
        let Ok(work) = simulation.added_work() else {
            return;
        };
        let kept = kinetic + value("potential_energy") - work;
        let drift = kept - *first.get_or_insert(kept);
        if drift.abs() > found.drift.0.abs() {
            found.drift = (drift, simulation.frame().t());
        }
    }

    fn say_passed(&mut self, passed: &[[f64; 2]]) {
        let lines = passed.iter().map(|[from, to]| {
            format!(
                "the motion passes straight through a singular pose between t = {} s and {} s",
                time(*from),
                time(*to)
            )
        });
        self.warnings.extend(lines);
    }
}
