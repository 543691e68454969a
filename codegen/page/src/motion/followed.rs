//! Holds a motion from its start on: the source of all reports and pictures.

use linkwright::Failure;
use linkwright_codegen::stages::system::System;
use linkwright_solver::condition::Condition;
use linkwright_solver::condition::{dimensionless, jacobian};
use linkwright_solver::losses::Losses;
use linkwright_solver::measures::{MeasuredPart, Measures};
use linkwright_solver::motors::MotorPeaks;
use linkwright_solver::pressure::PressureCheck;
use linkwright_solver::residuals::ResidualCheck;
use linkwright_solver::textbook::TextbookEquations;
use linkwright_solver::{Instant, Modes, Movable, Moved, Numbers, Stop, View};
use nalgebra::DVector;
use serde::Serialize;

use super::{Course, MeanSquare, Rows, Simulated, Wanted};

/// Failure that ends a motion early, as tables and JSON name it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct EarlyEnd {
    /// Name of the kind of failure: that of [`linkwright::FailureKind::name`] or [`linkwright_solver::Stop::name`].
    pub kind: &'static str,
    /// Time that cannot be reached (s).
    pub t: f64,
    /// Index of the block, of the quantity that is not positive, or of the parameter outside of its range; `None` for a simulated motion.
    pub block: Option<u16>,
}

impl From<&Failure> for EarlyEnd {
    fn from(failure: &Failure) -> EarlyEnd {
        EarlyEnd {
            kind: failure.kind.name(),
            t: failure.time,
            block: Some(failure.block),
        }
    }
}

impl From<&Stop> for EarlyEnd {
    fn from(stop: &Stop) -> EarlyEnd {
        EarlyEnd {
            kind: stop.name(),
            t: stop.time(),
            block: None,
        }
    }
}

/// Motion that is being followed, and its findings.
pub struct Followed<V: View> {
    /// Formulation that is solved.
    pub view: V,
    /// Selection of the user.
    pub wanted: Wanted,
    /// Condition of Φ_q at the start in SI units; in the design configuration if the mechanism cannot be assembled.
    pub condition: Condition,
    /// Condition of Φ_q with all lengths in characteristic lengths of the mechanism.
    pub dimensionless_condition: Condition,
    /// Start of the motion (s).
    pub start: f64,
    /// True if the mechanism could be assembled at the start.
    pub is_assembled: bool,
    /// Number of requested instants that were reached.
    pub count: usize,
    /// Number of visited times.
    pub visits: usize,
    /// Readable number of instants.
    pub rows: Rows,
    /// Data of pictures; `None` if no picture is requested.
    pub course: Option<Course>,
    /// Largest residuals.
    pub residuals: ResidualCheck,
    /// Largest pressure angles.
    pub pressure: PressureCheck,
    /// Names of the requested transmissions and sensitivities, each with its SI unit.
    pub derivative_names: Vec<(String, String)>,
    /// Names of the requested forces and measures, each with its unit.
    pub reported_names: Vec<(String, String)>,
    /// Largest magnitude of each of them, and its time (s).
    pub largest_reported: Vec<(f64, f64)>,
    /// Smallest and largest value of each of them, each with its time (s).
    pub extremes: Vec<[(f64, f64); 2]>,
    /// Root mean squares of them over time.
    pub squares: Vec<MeanSquare>,
    /// Worst points of motors.
    pub motors: Vec<MotorPeaks>,
    /// Losses by friction; `None` without friction.
    pub losses: Option<Losses>,
    /// First time (s) at which bodies that press on one another would have to pull, by index of the force; `None` if there is none.
    pub pulls: Vec<Option<f64>>,
    /// Names of the measures; empty unless they are requested.
    pub measure_names: Vec<String>,
    /// Smallest measure: index of its name, time (s), value.
    pub smallest_measure: Option<(usize, f64, f64)>,
    /// Warnings, one sentence each.
    pub warnings: Vec<String>,
    /// Reason of an early end; `None` if the motion is complete.
    pub error: Option<String>,
    /// Failure of an early end; `None` if the motion is complete, or only its forces are not.
    pub failure: Option<EarlyEnd>,
    /// Cost of the integration; `None` if drivers determine the motion.
    pub simulated: Option<Simulated>,
    /// Reason of the first forces that are not finite, and their time (s).
    pub(super) no_forces: Option<(String, f64)>,
    /// Last requested instant.
    pub(super) last: Option<Instant>,
    pub(super) moved: Option<Moved<V>>,
    pub(super) measures: Option<Measures>,
}

/// Extremes before any value.
const NO_EXTREMES: [(f64, f64); 2] = [(f64::INFINITY, f64::NAN), (f64::NEG_INFINITY, f64::NAN)];

impl<V: View> Followed<V> {
    /// Assembles the mechanism at the start, from the design configuration or from a pose and modes.
    pub fn new(
        view: V,
        wanted: Wanted,
        start: f64,
        chosen: Option<(Instant, Modes)>,
    ) -> Followed<V> {
        let system = view.system();
        let parameters = view.nominal_parameters();
        let (pose, modes) = match chosen {
            Some((instant, modes)) => (Numbers(instant.q().to_vec()), modes),
            None => (view.drawn_pose(&parameters), view.drawn_branches()),
        };
        let assembled = Moved::assemble(view.clone(), &pose, modes, start);
        let q = match &assembled {
            Ok(moved) => DVector::from_column_slice(moved.instant().q()),
            Err(_) => DVector::from_vec(pose.0),
        };
        let textbook = TextbookEquations::new(view.pool(), system);
        let matrix = jacobian(&textbook, &q, start);
        let reported_names = linkwright_solver::reported::names(view.pool(), system);
        let course = wanted
            .curves
            .then(|| Course::of(&wanted, reported_names.len()));
        let measures = view.measures();
        let name =
            |part: &MeasuredPart| format!("normalized_determinant_{}", part.unknowns.join("_"));
        let measured = measures.iter().flat_map(Measures::parts);
        let monitored = measured.filter(|_| wanted.monitor);
        let (moved, refused) = match assembled {
            Ok(moved) => (Some(moved), None),
            Err(refused) => (None, Some(refused)),
        };
        Followed {
            condition: Condition::of(&matrix),
            dimensionless_condition: Condition::of(&dimensionless(&textbook, matrix)),
            start,
            is_assembled: moved.is_some(),
            count: 0,
            visits: usize::from(moved.is_some()),
            rows: Rows::default(),
            course,
            residuals: ResidualCheck::new(view.pool(), system, view.layout()),
            pressure: PressureCheck::new(view.pool(), system, view.layout()),
            derivative_names: linkwright_solver::derivatives::names(system),
            largest_reported: vec![(0.0, start); reported_names.len()],
            extremes: vec![NO_EXTREMES; reported_names.len()],
            squares: vec![MeanSquare::default(); reported_names.len()],
            motors: MotorPeaks::of(&system.mechanism),
            losses: Losses::of(view.pool(), system),
            pulls: vec![None; reported_names.len()],
            reported_names,
            measure_names: monitored.map(name).collect(),
            smallest_measure: None,
            warnings: Vec::new(),
            simulated: None,
            no_forces: None,
            last: None,
            measures,
            failure: refused.as_ref().map(|it| EarlyEnd::from(&it.failure)),
            error: refused.map(|it| it.reason),
            moved,
            wanted,
            view,
        }
    }

    /// Number of requested forces, which precede the measures among [`Followed::reported_names`].
    pub fn force_count(&self) -> usize {
        let measures = self.system().mechanism.measurements.len();
        self.reported_names.len().saturating_sub(measures)
    }

    /// Returns the root mean square of the torque of a motor.
    pub fn rms_torque(&self, motor: &MotorPeaks) -> Option<f64> {
        let torque = self.force_count() + motor.measurements[0];
        self.squares.get(torque).map(MeanSquare::root)
    }

    /// Converts a motion without instants to another formulation of the same mechanism.
    pub(super) fn seen_by<W: View>(self, view: W) -> Followed<W> {
        Followed {
            residuals: ResidualCheck::new(view.pool(), view.system(), view.layout()),
            pressure: PressureCheck::new(view.pool(), view.system(), view.layout()),
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
            reported_names: self.reported_names,
            largest_reported: self.largest_reported,
            extremes: self.extremes,
            squares: self.squares,
            motors: self.motors,
            losses: self.losses,
            pulls: self.pulls,
            measure_names: self.measure_names,
            smallest_measure: self.smallest_measure,
            warnings: self.warnings,
            error: self.error,
            failure: self.failure,
            simulated: self.simulated,
            no_forces: self.no_forces,
            last: self.last,
            moved: None,
            measures: view.measures(),
            view,
        }
    }

    /// Equations of the mechanism.
    pub fn system(&self) -> &System {
        self.view.system()
    }

    /// Name of the mechanism.
    pub fn name(&self) -> &str {
        &self.system().mechanism.name
    }

    /// Name of the motion; `None` if the mechanism has only one.
    pub fn motion(&self) -> Option<&str> {
        let motion = self.system().mechanism.motion.as_ref();
        motion.map(|motion| motion.name.as_str())
    }

    /// Name of the mechanism, followed by that of the motion if there are several.
    pub fn title(&self) -> String {
        self.system().mechanism.title()
    }

    /// Names of the selected points.
    pub fn point_names(&self) -> impl Iterator<Item = &str> {
        let points = self.wanted.points.iter();
        points.map(|&point| self.system().outputs[point].name.as_str())
    }

    /// Names of the selected coordinates.
    pub fn coordinate_names(&self) -> impl Iterator<Item = &str> {
        let coordinates = self.wanted.coordinates.iter();
        coordinates.map(|&it| self.system().coordinates[it].name.as_str())
    }
}
