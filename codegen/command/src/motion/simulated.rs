//! *A mechanism that forces move* → *its instants, and how well its energy is kept*.

use std::io;

use linkwright_solver::instant::Instant;
use linkwright_solver::interpreted::Interpreted;
use linkwright_solver::number::{counted, time};
use linkwright_solver::pressure::PressureCheck;
use linkwright_solver::residuals::ResidualCheck;
use linkwright_solver::schedule::Schedule;
use linkwright_solver::simulation::{Change, Effort, Hindrance, Options, Simulation, Stop};
use linkwright_solver::supplied::Modes;
use linkwright_solver::view::View;

use super::{Followed, Sink};

/// What an integration has taken, and how well it keeps the energy.
#[derive(Clone, Debug, Default)]
pub struct Simulated {
    /// Evaluations and steps.
    pub effort: Effort,
    /// What of a change of the energy the work of forces, torques and dampers does not account for: the largest over all frames (J) and
    /// when; `None` where drivers bring in work, too.
    pub drift: Option<(f64, f64)>,
    /// The largest kinetic energy (J), which that is to be compared with.
    pub kinetic: f64,
    /// The changes of free coordinates.
    pub changes: Vec<Change>,
}

/// How many changes are said one by one.
const SAID: usize = 8;

impl Followed<Interpreted> {
    /// Lets the forces move the mechanism from t = 0 over the rest of the schedule, and hands its instants on in the order of time;
    /// `reached` hears how many times were visited.
    ///
    /// # Errors
    /// Those of the sinks, which end it.
    pub fn simulate(
        &mut self,
        schedule: &Schedule,
        chosen: Option<(Instant, Modes)>,
        options: Options,
        sinks: &mut [&mut dyn Sink],
        reached: &mut dyn FnMut(usize),
    ) -> io::Result<()> {
        if self.error.is_some() {
            return Ok(());
        }
        let visits: Vec<f64> = schedule.forward.visits().map(|visit| visit.t).collect();
        let end = visits.last().copied().unwrap_or(0.0);
        let mut simulation = match Simulation::new(&self.view, chosen, end, options) {
            Ok(simulation) => simulation,
            Err(stop) => {
                self.error = Some(stop.explained(&self.view, None));
                return Ok(());
            }
        };
        let mut found = Simulated {
            drift: self.is_driven_by_forces().then_some((0.0, 0.0)),
            ..Simulated::default()
        };
        let described = self.view.clone();
        let (mut first, mut stop) = (None, None);
        for t in std::iter::once(0.0).chain(visits) {
            if t > 0.0 {
                if let Err(end) = simulation.advance(t) {
                    stop = Some(end);
                    break;
                }
                self.visits += 1;
                reached(self.visits);
            }
            if simulation.changes().len() > found.changes.len() {
                found.changes = simulation.changes().to_vec();
                self.show_by(simulation.view());
            }
            self.show(simulation.frame(), &[], sinks)?;
            self.weigh(&mut simulation, &mut first, &mut found);
        }
        found.effort = simulation.effort();
        found.changes = simulation.changes().to_vec();
        self.say_passed(simulation.passed());
        self.say_changed(&found.changes);
        self.error = stop.map(|stop: Stop| {
            let last = Some(simulation.frame());
            stop.explained(simulation.view(), last) + &helped(&stop, &simulation, options)
        });
        self.simulated = Some(found);
        self.finish();
        self.view = described;
        Ok(())
    }

    /// Reads instants as those of the same mechanism with another coordinate free from here on.
    fn show_by(&mut self, view: &Interpreted) {
        let (system, layout) = (view.system(), view.layout());
        let mut residuals = ResidualCheck::new(system, layout);
        residuals.largest = self.residuals.largest;
        let mut pressure = PressureCheck::new(system, layout);
        pressure.largest = std::mem::take(&mut self.pressure.largest);
        (self.residuals, self.pressure) = (residuals, pressure);
        self.view = view.clone();
        self.is_changed = true;
    }

    /// Whether all other drivers hold what they hold where it is.
    fn is_driven_by_forces(&self) -> bool {
        let mechanism = &self.system().mechanism;
        let free: Vec<usize> = mechanism.forces.free.iter().map(|it| it.joint).collect();
        let rows = &self.system().rows;
        let mut others = rows.iter().filter(|row| !free.contains(&row.joint));
        others.all(|row| mechanism.graph.constant_value(row.time_derivative) == Some(0.0))
    }

    /// Compares the energy of a frame with that of the first one.
    fn weigh(&self, simulation: &mut Simulation, first: &mut Option<f64>, found: &mut Simulated) {
        let Some(forces) = self.view.forces(simulation.frame()) else {
            return;
        };
        let value = |name: &str| {
            let place = self.force_names.iter().position(|(own, _)| own == name);
            place.map_or(0.0, |place| forces[place])
        };
        let kinetic = value("kinetic_energy");
        found.kinetic = found.kinetic.max(kinetic);
        let Ok(work) = simulation.added_work() else {
            return;
        };
        let kept = kinetic + value("potential_energy") - work;
        let drift = kept - *first.get_or_insert(kept);
        if let Some(largest) = found.drift.as_mut().filter(|it| drift.abs() > it.0.abs()) {
            *largest = (drift, simulation.frame().t());
        }
    }

    fn say_changed(&mut self, changes: &[Change]) {
        let lines = changes.iter().take(SAID).map(|change| {
            let Change { t, from, to, .. } = change;
            let reason = match &change.part {
                Some(part) => format!(
                    ": there the normalized determinant of {part} has fallen to {:.2}",
                    change.determinant
                ),
                None => String::new(),
            };
            format!(
                "at t = {} s the free coordinate changes from {from} to {to}, since {from} is about to stand still{reason}",
                time(*t)
            )
        });
        self.warnings.extend(lines);
        if let Some(rest @ 1..) = changes.len().checked_sub(SAID) {
            let changes = counted(rest, "time");
            self.warnings
                .push(format!("the free coordinate changes {changes} more"));
        }
    }

    fn say_passed(&mut self, passed: &[[f64; 2]]) {
        let lines = passed.iter().map(|[from, to]| {
            format!(
                "a singular pose is passed between t = {} s and {} s: the motion goes straight on there",
                time(*from),
                time(*to)
            )
        });
        self.warnings.extend(lines);
    }
}

/// What would take the motion farther, or why nothing does.
fn helped(stop: &Stop, simulation: &Simulation, options: Options) -> String {
    let mut lines = Vec::new();
    let hindrance = match stop {
        Stop::Unsolvable(_) | Stop::TooShort { .. } => simulation.hindrance(),
        _ => None,
    };
    match hindrance {
        Some(Hindrance::StandsStill(_)) if !options.changes => lines.push(
            "help: `--change-coordinates` goes on there in another coordinate".to_string(),
        ),
        Some(Hindrance::StandsStill(name)) => lines.push(format!(
            "note: {name} stands still there, and no coordinate of a body can take its place"
        )),
        Some(Hindrance::LosesRank) if options.changes => lines.push(
            "note: no other coordinate goes on there: equations of the joints lose rank, whatever is free"
                .to_string(),
        ),
        _ => {}
    }
    if stop.is_where_loops_meet(simulation.view(), simulation.frame()) && !options.goes_through {
        lines.push("help: `--through-singular` goes straight on there".to_string());
    }
    let lines = lines.iter().map(|line| format!("\n  = {line}"));
    lines.collect()
}
