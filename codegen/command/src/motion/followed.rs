//! *A mechanism, and what is wanted of it* → *its motion from the start on*: everything that reports and pictures are made of.

use linkwright::Shell;
use linkwright_codegen::stages::system::System;
use linkwright_solver::condition::{Condition, dimensionless, jacobian};
use linkwright_solver::instant::Instant;
use linkwright_solver::measures::MeasuredPart;
use linkwright_solver::pressure::PressureCheck;
use linkwright_solver::residuals::ResidualCheck;
use linkwright_solver::supplied::{Modes, Numbers};
use linkwright_solver::textbook::TextbookEquations;
use linkwright_solver::view::View;
use nalgebra::DVector;

use super::{Course, Rows, Simulated, Wanted};

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
    /// Names of what transmissions and sensitivities request, each with its unit of SI.
    pub derivative_names: Vec<(String, String)>,
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
    /// The first load that is not finite, and when (s).
    pub(super) infinite_load: Option<(String, f64)>,
    /// The last wanted instant.
    pub(super) last: Option<Instant>,
    pub(super) shell: Option<Shell<V>>,
    pub(super) measured: Vec<MeasuredPart>,
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
            infinite_load: None,
            last: None,
            measured,
            error,
            shell,
            wanted,
            view,
        }
    }

    /// The same before its first instant, seen by another view of the same mechanism.
    pub(super) fn seen_by<W: View>(self, view: W) -> Followed<W> {
        Followed {
            residuals: ResidualCheck::new(view.system(), view.layout()),
            pressure: PressureCheck::new(view.system(), view.layout()),
            wanted: self.wanted,
            condition: self.condition,
            dimensionless_condition: self.dimensionless_condition,
            start: self.start,
            is_assembled: self.is_assembled,
            count: self.count,
            visits: self.visits,
            rows: self.rows,
            course: self.course,
            derivative_names: self.derivative_names,
            force_names: self.force_names,
            largest_forces: self.largest_forces,
            pulls: self.pulls,
            measure_names: self.measure_names,
            smallest_measure: self.smallest_measure,
            warnings: self.warnings,
            error: self.error,
            simulated: self.simulated,
            infinite_load: self.infinite_load,
            last: self.last,
            shell: None,
            measured: self.measured,
            view,
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
