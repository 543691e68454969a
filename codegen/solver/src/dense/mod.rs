//! Solves all equations of a system at once: the textbook formulation as one block.

#[doc(hidden)]
pub mod diagnosis;

use std::cell::Cell;
use std::sync::Arc;

use linkwright::generated::{Conditions, Pair, Start, TimeWindow, block, path};
use linkwright::{BlockName, Blocks, Equations, Failure, PointMotion, ValueRange};
use linkwright_codegen::stages::emit::derivation::SingularPose;
use linkwright_codegen::stages::system::Derived;
use nalgebra::{DMatrix, DVector, Dyn};

use crate::forces::DenseForces;
use crate::instant::{Instant, Layout};
use crate::measures::Measures;
use crate::number::time;
use crate::ranges::Ranges;
use crate::reported::DenseMeasures;
use crate::supplied::{InputSignals, ModeName, Modes, Numbers, ParameterValues, Pose};
use crate::textbook::TextbookEquations;
use crate::view::View;
use diagnosis::cause;

/// Φ(q, t) = 0 as one dense system in SI units: m, rad, s.
#[derive(Clone, Debug)]
pub struct Dense {
    derived: Arc<Derived>,
    layout: Arc<Layout>,
    equations: TextbookEquations,
    forces: Option<DenseForces>,
    measured: Option<DenseMeasures>,
    residuals: Cell<u64>,
    solves: Cell<u64>,
    ranges: Ranges,
}

/// Name of the block.
const ALL: BlockName<'static> = BlockName {
    name: "all equations",
    singular: "Φ_q is singular",
};

impl Dense {
    /// Creates the equations of `system`, which must have as many rows as coordinates; `linkwright_codegen::Read::check` verifies that.
    ///
    /// # Panics
    /// If the system is not square.
    pub fn new(derived: &Derived) -> Dense {
        let Derived { pool, system } = derived;
        let layout = Layout::new(system, &[]);
        Dense {
            forces: DenseForces::new(pool, system, &layout),
            measured: DenseMeasures::new(pool, system),
            layout: Arc::new(layout),
            equations: TextbookEquations::new(pool, system),
            derived: Arc::new(derived.clone()),
            residuals: Cell::new(0),
            solves: Cell::new(0),
            ranges: Ranges::of(system),
        }
    }

    /// Creates the equations of a mechanism that forces move.
    ///
    /// Multipliers of free coordinates vanish, so that forces are determined wherever the joints are regular.
    ///
    /// # Panics
    /// If the system is not square.
    pub fn moved_by_forces(derived: &Derived) -> Dense {
        let Derived { pool, system } = derived;
        let mut view = Dense::new(derived);
        let mechanism = &system.mechanism;
        let free = &mechanism.forces.free;
        let is_free = |joint: usize| free.iter().any(|it| it.joint == joint);
        // Drivers that depend on a free one have driving forces.
        let mut others = system.rows.iter().filter(|row| !is_free(row.joint));
        let is_followed = others.any(|row| {
            let symbols = pool.graph.symbols(row.residual);
            let mut values = free.iter().map(|it| mechanism.inputs[it.input].symbols[0]);
            values.any(|value| symbols.contains(&value))
        });
        if let Some(forces) = view.forces.as_mut().filter(|_| !is_followed) {
            let rows = system.rows.iter().enumerate();
            let free_rows = rows.filter(|(_, row)| is_free(row.joint));
            forces.release(free_rows.map(|(row, _)| row).collect());
        }
        view
    }

    /// Returns the failure of an instant with an input outside of its range; `None` without one.
    pub(crate) fn refused(&self, instant: &Instant) -> Option<Failure> {
        let inputs = self.layout.inputs(instant);
        let values = inputs.0.iter().map(|signal| signal.value);
        self.ranges.refused(values, instant.t())
    }

    /// Equations.
    #[doc(hidden)]
    pub fn equations(&self) -> &TextbookEquations {
        &self.equations
    }
}

impl Blocks for Dense {
    type Scalar = f64;
    type Frame = Instant;
    type Coordinates = Pose;
    type Branches = Modes;
    type Parameters = ParameterValues;
    type Inputs = InputSignals;
    type PathEnclosures = ();

    /// False, since each step verifies its path itself, as [`linkwright::Frame::follow`] does.
    fn is_guarded(&self) -> bool {
        false
    }

    fn enclosures(&self) {}

    fn verify_path(&self, _: &Pair<'_, Dense>, _: &TimeWindow, (): &mut ()) -> Result<(), u16> {
        Ok(())
    }

    fn is_within(&self, _: &Instant, (): &(), _: f64) -> bool {
        true
    }

    fn nominal_parameters(&self) -> ParameterValues {
        Numbers::nominal_parameters(self.pool(), self.system())
    }

    fn initial_inputs(&self) -> InputSignals {
        InputSignals::initial(self.pool(), self.system())
    }

    fn drawn_branches(&self) -> Modes {
        Modes {
            closed: Vec::new(),
            iterated: vec![None],
        }
    }

    fn exchanged(&self, _: &Modes, _: u16) -> Option<Modes> {
        None
    }

    fn drawn_pose(&self, _parameters: &ParameterValues) -> Pose {
        Numbers(self.equations.estimate().as_slice().to_vec())
    }

    fn estimate(&self, pose: &Pose, parameters: &ParameterValues, t: f64) -> Instant {
        let mut instant = self.layout.empty();
        let rest = DVector::zeros(pose.0.len());
        instant.set_frame(&linkwright::Frame {
            t,
            q: DVector::from_column_slice(&pose.0),
            qd: rest.clone(),
            qdd: rest,
        });
        instant.set_given(parameters, &self.initial_inputs());
        instant
    }

    fn time(frame: &Instant) -> f64 {
        frame.t()
    }

    fn set_time(frame: &mut Instant, t: f64) {
        frame.values_mut()[0] = t;
    }

    fn add(&self, sum: &mut Instant, multiple: f64, frame: &Instant, base: &Instant) {
        sum.add(multiple, frame, base);
    }

    fn solve(
        &self,
        at: &mut Instant,
        last: &Instant,
        modes: &mut Modes,
        conditions: &Conditions<'_, f64, ParameterValues, InputSignals>,
    ) -> Result<(), Failure> {
        self.equations
            .supply(conditions.parameters, conditions.inputs);
        self.solves.set(self.solves.get() + 1);
        let (counted, last) = (Counted(self), last.frame());
        let mode = &mut modes.iterated[0];
        let Conditions {
            t, start, settings, ..
        } = *conditions;
        let frame = match (start, *mode) {
            (Start::LastFrame, Some(branch)) => path::step(&counted, &last, branch, t, settings)?,
            _ => block::solve(&counted, &last, Start::Estimate, mode, t, settings)?,
        };
        at.set_frame(&frame);
        at.set_given(conditions.parameters, conditions.inputs);
        Ok(())
    }

    fn name(&self) -> &str {
        &self.system().mechanism.name
    }

    fn coordinate_name(&self, index: usize) -> Option<&str> {
        self.system()
            .coordinates
            .get(index)
            .map(|it| it.name.as_str())
    }

    fn parameter_name(&self, index: usize) -> Option<&str> {
        let parameters = &self.system().mechanism.parameters;
        parameters.get(index).map(|it| it.name.as_str())
    }

    fn input_name(&self, index: usize) -> Option<&str> {
        let inputs = &self.system().mechanism.inputs;
        inputs.get(index).map(|it| it.name.as_str())
    }

    fn parameter_range(&self, index: usize) -> Option<ValueRange<'_>> {
        self.ranges.parameter(index)
    }

    fn input_range(&self, index: usize) -> Option<ValueRange<'_>> {
        self.ranges.input(index)
    }

    fn coordinate(&self, frame: &Instant, index: usize) -> Option<[f64; 3]> {
        frame.coordinate(index)
    }

    fn point_name(&self, index: usize) -> Option<&str> {
        self.system().outputs.get(index).map(|it| it.name.as_str())
    }

    fn point(&self, frame: &Instant, index: usize) -> Option<PointMotion<f64>> {
        self.points(frame).get(index).copied()
    }

    fn block_name(&self, index: usize) -> Option<BlockName<'_>> {
        (index == 0).then_some(ALL)
    }
}

impl View for Dense {
    fn derived(&self) -> &Derived {
        &self.derived
    }

    fn layout(&self) -> &Layout {
        &self.layout
    }

    fn mode_names(&self) -> Vec<ModeName> {
        Vec::new()
    }

    fn newton_steps(&self) -> [u64; 2] {
        let solves = self.solves.get();
        [self.residuals.get().saturating_sub(solves), solves]
    }

    fn points(&self, instant: &Instant) -> Vec<PointMotion> {
        self.equations.points(&instant.frame())
    }

    fn derivatives(&self, instant: &Instant) -> Option<Vec<f64>> {
        let frame = instant.frame();
        let responses = self.equations.responses(&frame.q, frame.t).ok()?;
        let mut values = Vec::new();
        for matrix in self.equations.transmissions(&frame.q, frame.t, &responses) {
            values.extend(matrix.transpose().iter());
        }
        let drivers = self.system().driven().count();
        if drivers < self.system().directions.len() {
            let rates = self.equations.sensitivity_rates(&frame, &responses).ok()?;
            let responses = responses.column_iter().skip(drivers);
            for (parameter, (response, rate)) in responses.zip(rates.column_iter()).enumerate() {
                values.extend(response.iter());
                values.extend(rate.iter());
                if let Some(measures) = &self.measured {
                    let moved = [response.iter(), rate.iter()];
                    values.extend(measures.along(instant, parameter, moved));
                }
            }
        }
        Some(values)
    }

    fn reported(&self, instant: &Instant) -> Option<Vec<f64>> {
        let mut reported = match &self.forces {
            Some(forces) => forces.at(instant)?,
            None => Vec::new(),
        };
        if let Some(measures) = &self.measured {
            let values = measures.at(instant, &reported);
            reported.extend(values);
        }
        Some(reported)
    }

    fn measures(&self) -> Option<Measures> {
        None
    }

    fn singular_poses(&self) -> &[SingularPose] {
        &[]
    }

    fn not_assembled(&self, failure: &Failure) -> String {
        let t = time(failure.time);
        format!(
            "cannot be assembled at t = {t} s: {}",
            cause(self, failure, None)
        )
    }

    fn ended(&self, failure: &Failure, last: &Instant) -> String {
        let t = time(last.t());
        format!(
            "cannot be solved beyond t = {t} s: {}",
            cause(self, failure, Some(last))
        )
    }
}

/// Equations that count evaluations of the residual.
struct Counted<'a>(&'a Dense);

impl Equations<f64, Dyn> for Counted<'_> {
    fn dimension(&self) -> Dyn {
        self.0.equations.dimension()
    }

    fn residual(&self, q: &DVector<f64>, t: f64, phi: &mut DVector<f64>) {
        self.0.residuals.set(self.0.residuals.get() + 1);
        self.0.equations.residual(q, t, phi);
    }

    fn jacobian(&self, q: &DVector<f64>, t: f64, phi_q: &mut DMatrix<f64>) {
        self.0.equations.jacobian(q, t, phi_q);
    }

    fn time_derivative(&self, q: &DVector<f64>, t: f64, phi_t: &mut DVector<f64>) {
        self.0.equations.time_derivative(q, t, phi_t);
    }

    fn gamma(&self, q: &DVector<f64>, qd: &DVector<f64>, t: f64, gamma: &mut DVector<f64>) {
        self.0.equations.gamma(q, qd, t, gamma);
    }

    fn row_scale(&self, row: usize) -> f64 {
        self.0.equations.row_scale(row)
    }

    fn coordinate_scale(&self, column: usize) -> f64 {
        self.0.equations.coordinate_scale(column)
    }
}
