//! *A mechanism and a schedule* → *its motion, instant by instant, and what is to be said of it afterwards*.
//!
//! Instants are handed on as they are found and not kept, so that a motion of any length takes the same memory. The module does not
//! know how anything is printed.

mod course;
mod curve;
mod path;
mod rows;
mod selection;
mod simulated;

pub use course::Course;
pub use curve::{Curve, Extreme};
pub use path::Path;
pub use rows::{Row, Rows};
pub use selection::{coordinates, points};
pub use simulated::Simulated;

use std::io;

use linkwright::{PointMotion, Shell};
use linkwright_codegen::stages::system::System;
use linkwright_solver::approach::Watch;
use linkwright_solver::condition::{Condition, dimensionless, jacobian};
use linkwright_solver::instant::Instant;
use linkwright_solver::measures::MeasuredPart;
use linkwright_solver::number::time;
use linkwright_solver::pressure::PressureCheck;
use linkwright_solver::residuals::ResidualCheck;
use linkwright_solver::schedule::Schedule;
use linkwright_solver::supplied::{Modes, Numbers};
use linkwright_solver::textbook::TextbookEquations;
use linkwright_solver::trajectory::follow;
use linkwright_solver::view::View;
use linkwright_solver::warnings::warnings;
use nalgebra::DVector;

/// A measure below this is worth a warning: three digits fewer can be trusted there than elsewhere.
const CLOSE: f64 = 1e-3;

/// What is wanted of a motion.
#[derive(Clone, Debug)]
pub struct Wanted {
    /// Which points are shown: indices into the system's outputs.
    pub points: Vec<usize>,
    /// Which coordinates are shown: indices into the system's coordinates.
    pub coordinates: Vec<usize>,
    /// Whether to say how close each part is to a singular pose.
    pub monitor: bool,
    /// Whether to keep what pictures are drawn from.
    pub curves: bool,
}

/// One wanted instant of a motion.
pub struct Shown<'a> {
    /// The instant.
    pub instant: &'a Instant,
    /// The motion of each shown point.
    pub motions: &'a [PointMotion],
    /// What transmissions and sensitivities ask for, in the order of their names; `None` where the equations are singular.
    pub derivatives: Option<&'a [f64]>,
    /// What drivers exert, joints carry and bodies store, in the order of their names; `None` where the equations are singular.
    pub forces: Option<&'a [f64]>,
    /// How close each part is to a singular pose, where that is wanted.
    pub measures: &'a [f64],
}

/// Where wanted instants go.
pub trait Sink {
    /// Takes the next one.
    ///
    /// # Errors
    /// Those of what it is written to.
    fn take(&mut self, shown: &Shown<'_>) -> io::Result<()>;
}

/// A motion that is being followed, and what is to be said of it.
pub struct Followed<V: View> {
    /// What is solved.
    pub view: V,
    /// What is wanted.
    pub wanted: Wanted,
    /// How well-conditioned Φ_q is at the start, in SI units; of the drawing if it cannot be assembled.
    pub condition: Condition,
    /// The same with all lengths in characteristic lengths of the mechanism.
    pub dimensionless_condition: Condition,
    /// When the motion starts (s).
    pub start: f64,
    /// Whether it could be assembled there.
    pub is_assembled: bool,
    /// How many wanted instants were found.
    pub count: usize,
    /// How many times were visited.
    pub visits: usize,
    /// A readable number of instants.
    pub rows: Rows,
    /// What pictures are drawn from, where they are wanted.
    pub course: Option<Course>,
    /// The largest residuals.
    pub residuals: ResidualCheck,
    /// The largest pressure angles.
    pub pressure: PressureCheck,
    /// The names of what transmissions and sensitivities ask for.
    pub derivative_names: Vec<String>,
    /// The names of the forces that are asked for, each with its unit.
    pub force_names: Vec<(String, &'static str)>,
    /// The largest size of each force, and when.
    pub largest_forces: Vec<(f64, f64)>,
    /// When bodies that press on one another would first have to pull, by the place of the force.
    pub pulls: Vec<Option<f64>>,
    /// The names of the measures, where they are wanted.
    pub measure_names: Vec<String>,
    /// The smallest measure: its place among the names, when, and itself.
    pub smallest_measure: Option<(usize, f64, f64)>,
    /// One sentence for each thing to look at.
    pub warnings: Vec<String>,
    /// Why the motion ends early, if it does.
    pub error: Option<String>,
    /// What its integration has taken, where forces move it.
    pub simulated: Option<Simulated>,
    /// Whether another coordinate is free than the description says, so that derivatives along what it frees are not known.
    is_changed: bool,
    /// The last wanted instant.
    last: Option<Instant>,
    shell: Option<Shell<V>>,
    measured: Vec<MeasuredPart>,
}

impl<V: View> Followed<V> {
    /// Assembles the mechanism at the start: as it is drawn, or in the given pose and modes.
    pub fn new(
        view: V,
        wanted: Wanted,
        start: f64,
        chosen: Option<(Instant, Modes)>,
    ) -> Followed<V> {
        let system = view.system();
        let (laws, parameters) = (view.input_laws(), view.nominal_parameters());
        let (pose, modes) = match chosen {
            Some((instant, modes)) => (Numbers(instant.q().to_vec()), modes),
            None => (view.drawn_pose(&parameters), view.drawn_branches()),
        };
        let inputs = laws.at(start);
        let blocks = view.clone();
        let assembled = Shell::assemble(
            blocks,
            &parameters,
            &pose,
            modes,
            start,
            &inputs,
            Default::default(),
        );
        let q = match &assembled {
            Ok(shell) => DVector::from_column_slice(shell.frame().q()),
            Err(_) => DVector::from_vec(pose.0),
        };
        let textbook = TextbookEquations::new(system);
        let matrix = jacobian(&textbook, &q, start);
        let force_names = linkwright_solver::forces::names(system);
        let course = wanted
            .curves
            .then(|| Course::of(&wanted, force_names.len()));
        let measures = view.measures();
        let measured = measures
            .as_ref()
            .map_or(Vec::new(), |it| it.parts().to_vec());
        let name =
            |part: &MeasuredPart| format!("normalized_determinant_{}", part.unknowns.join("_"));
        let monitored = measured.iter().filter(|_| wanted.monitor);
        let (shell, error) = match assembled {
            Ok(shell) => (Some(shell), None),
            Err(failure) => (None, Some(view.not_assembled(&failure))),
        };
        Followed {
            condition: Condition::of(&matrix),
            dimensionless_condition: Condition::of(&dimensionless(&textbook, matrix)),
            start,
            is_assembled: shell.is_some(),
            count: 0,
            visits: usize::from(shell.is_some()),
            rows: Rows::default(),
            course,
            residuals: ResidualCheck::new(system, view.layout()),
            pressure: PressureCheck::new(system, view.layout()),
            derivative_names: linkwright_solver::derivatives::names(system),
            largest_forces: vec![(0.0, start); force_names.len()],
            pulls: vec![None; force_names.len()],
            force_names,
            measure_names: monitored.map(name).collect(),
            smallest_measure: None,
            warnings: Vec::new(),
            simulated: None,
            is_changed: false,
            last: None,
            measured,
            error,
            shell,
            wanted,
            view,
        }
    }

    /// Follows the motion over the rest of the schedule, and hands wanted instants on in the order of time; `reached` hears how many
    /// times were visited.
    ///
    /// # Errors
    /// Those of the sinks, which end it.
    pub fn follow(
        &mut self,
        schedule: &Schedule,
        sinks: &mut [&mut dyn Sink],
        mut reached: impl FnMut(usize),
    ) -> io::Result<()> {
        let Some(mut shell) = self.shell.take() else {
            return Ok(());
        };
        let laws = self.view.input_laws();
        let mut watch = self.view.measures().map(|it| Watch::new(it, laws.clone()));
        let mut end = None;
        let mut approaches = Vec::new();
        let mut earlier: Vec<(Instant, Vec<f64>)> = Vec::new();
        let start = shell.frame().clone();
        if schedule.backward.length() > 0 {
            let (mut shell, mut watch) = (shell.clone(), watch.clone());
            if let Some(watch) = &mut watch {
                watch.see(&shell);
            }
            end = follow(&mut shell, &laws, &schedule.backward, |shell, wanted| {
                let instant = shell.frame();
                let sizes = watch.as_mut().map_or(Vec::new(), |watch| watch.see(shell));
                if wanted {
                    earlier.push((instant.clone(), sizes));
                }
                self.visits += 1;
                reached(self.visits);
                Ok::<(), io::Error>(())
            })?;
            approaches.extend(watch.map_or(Vec::new(), |watch| watch.finish(&shell)));
        }
        for (instant, sizes) in earlier.iter().rev() {
            self.show(instant, sizes, sinks)?;
        }
        let sizes = watch.as_mut().map_or(Vec::new(), |watch| watch.see(&shell));
        if schedule.start.wanted {
            self.show(&start, &sizes, sinks)?;
        }
        if end.is_none() {
            end = follow(&mut shell, &laws, &schedule.forward, |shell, wanted| {
                let instant = shell.frame();
                let sizes = watch.as_mut().map_or(Vec::new(), |watch| watch.see(shell));
                self.visits += 1;
                reached(self.visits);
                match wanted {
                    true => self.show(instant, &sizes, sinks),
                    false => Ok(()),
                }
            })?;
            approaches.extend(watch.map_or(Vec::new(), |watch| watch.finish(&shell)));
        }
        self.warnings = warnings(&approaches, self.view.singular_poses(), CLOSE);
        self.error = end.map(|end| self.view.ended(&end.failure, &end.last));
        self.finish();
        self.view = shell.blocks().clone();
        Ok(())
    }

    /// What is said once all instants have been seen.
    fn finish(&mut self) {
        let pulls = self.force_names.iter().zip(&self.pulls);
        let pulls = pulls.filter_map(|((name, _), t)| Some((name, (*t)?)));
        let parted = pulls.map(|(name, t)| {
            let t = time(t);
            format!(
                "{name} is negative at t = {t} s: the bodies would have to pull there, and part"
            )
        });
        self.warnings.extend(parted);
        if let (Some(last), Some(number)) = (&self.last, self.count.checked_sub(1)) {
            let row = self.row(number, last, self.motions(last), self.forces(last));
            self.rows.end(row);
        }
    }

    fn show(
        &mut self,
        instant: &Instant,
        sizes: &[f64],
        sinks: &mut [&mut dyn Sink],
    ) -> io::Result<()> {
        self.residuals.see(instant);
        self.pressure.see(instant);
        let is_row = self.rows.keeps(self.count);
        let measures: Vec<f64> = match self.wanted.monitor {
            true => sizes
                .iter()
                .zip(&self.measured)
                .map(|(size, part)| part.bounded(*size))
                .collect(),
            false => Vec::new(),
        };
        for (place, measure) in measures.iter().enumerate() {
            if self
                .smallest_measure
                .is_none_or(|(_, _, smallest)| *measure < smallest)
            {
                self.smallest_measure = Some((place, instant.t(), *measure));
            }
        }
        let forces = self.forces(instant);
        for (largest, force) in self.largest_forces.iter_mut().zip(forces.iter().flatten()) {
            if force.abs() > largest.0.abs() {
                *largest = (*force, instant.t());
            }
        }
        let pressures = self.force_names.iter().zip(forces.iter().flatten());
        for (pulls, ((name, _), force)) in self.pulls.iter_mut().zip(pressures) {
            if name.ends_with("_pressure") && *force < 0.0 {
                pulls.get_or_insert(instant.t());
            }
        }
        if is_row || self.course.is_some() || !sinks.is_empty() {
            let motions = self.motions(instant);
            if let Some(course) = &mut self.course {
                let forces = forces.as_deref().unwrap_or_default();
                course.push(instant, &motions, &self.wanted.coordinates, forces);
            }
            if !sinks.is_empty() {
                let asked = !self.derivative_names.is_empty();
                let derivatives = match (asked, self.is_changed) {
                    (false, _) => Some(Vec::new()),
                    (true, true) => None,
                    (true, false) => self.view.derivatives(instant),
                };
                let shown = Shown {
                    instant,
                    motions: &motions,
                    derivatives: derivatives.as_deref(),
                    forces: forces.as_deref(),
                    measures: &measures,
                };
                for sink in sinks.iter_mut() {
                    sink.take(&shown)?;
                }
            }
            if is_row {
                let row = self.row(self.count, instant, motions, forces);
                self.rows.push(row);
            }
        }
        self.last = Some(match self.last.take() {
            Some(mut last) => {
                last.clone_from(instant);
                last
            }
            None => instant.clone(),
        });
        self.count += 1;
        Ok(())
    }

    fn motions(&self, instant: &Instant) -> Vec<PointMotion> {
        let all = self.view.points(instant);
        self.wanted.points.iter().map(|&point| all[point]).collect()
    }

    /// The forces that are asked for; `None` where they are not known.
    fn forces(&self, instant: &Instant) -> Option<Vec<f64>> {
        match self.force_names.is_empty() {
            true => Some(Vec::new()),
            false => self.view.forces(instant),
        }
    }

    fn row(
        &self,
        number: usize,
        instant: &Instant,
        motions: Vec<PointMotion>,
        forces: Option<Vec<f64>>,
    ) -> Row {
        let coordinates = self.wanted.coordinates.iter();
        Row {
            number,
            t: instant.t(),
            motions,
            coordinates: coordinates.map(|it| of_coordinate(instant, *it)).collect(),
            forces: forces.unwrap_or_else(|| vec![f64::NAN; self.force_names.len()]),
        }
    }

    /// The equations.
    pub fn system(&self) -> &System {
        self.view.system()
    }

    /// The name of the mechanism.
    pub fn name(&self) -> &str {
        &self.system().mechanism.name
    }

    /// The name of the motion, where the mechanism has several.
    pub fn motion(&self) -> Option<&str> {
        let motion = self.system().mechanism.motion.as_ref();
        motion.map(|motion| motion.name.as_str())
    }

    /// How a person names it: with its motion, where it has several.
    pub fn title(&self) -> String {
        self.system().mechanism.title()
    }

    /// The names of the shown points.
    pub fn point_names(&self) -> impl Iterator<Item = &str> {
        let points = self.wanted.points.iter();
        points.map(|&point| self.system().outputs[point].name.as_str())
    }

    /// The names of the shown coordinates.
    pub fn coordinate_names(&self) -> impl Iterator<Item = &str> {
        let coordinates = self.wanted.coordinates.iter();
        coordinates.map(|&it| self.system().coordinates[it].name.as_str())
    }
}

/// A coordinate, its rate and its acceleration.
fn of_coordinate(instant: &Instant, coordinate: usize) -> [f64; 3] {
    [instant.q(), instant.qd(), instant.qdd()].map(|level| level[coordinate])
}
