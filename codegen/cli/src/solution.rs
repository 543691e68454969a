//! *A checked System and a schedule → the motion with everything that is to be said about it.*
//!
//! What the three outputs (text, JSON, files) have in common, worked out once. The module does not know how it is printed.

use std::path::PathBuf;

use linkwright::{Frame, Motion, Settings};
use linkwright_codegen::diagnostic::nearest;
use linkwright_codegen::model::Role;
use linkwright_codegen::system::System;
use nalgebra::{DVector, Dyn};

use crate::branches;
use crate::condition::{Condition, dimensionless, jacobian};
use crate::derivatives::Derivatives;
use crate::diagnosis;
use crate::interpreter::Interpreter;
use crate::monitor::Monitor;
use crate::pressure::{self, LargestPressureAngle};
use crate::residuals::Residuals;
use crate::schedule::Schedule;
use crate::solved_interpreter::SolvedInterpreter;
use crate::trajectory::{Trajectory, follow};

/// The motion of a mechanism over a schedule, as far as it goes.
#[derive(Clone, Debug)]
pub struct Solution {
    /// The equations.
    pub system: System,
    /// The same equations as functions.
    pub interpreter: Interpreter,
    /// The same loop by loop; `None` where there is no order in which blocks could be solved.
    pub solved: Option<SolvedInterpreter>,
    /// Which points are shown: indices into the system's outputs.
    pub points: Vec<usize>,
    /// The motion.
    pub trajectory: Trajectory,
    /// How well-conditioned Φ_q is at the start, in SI units; of the drawing if it cannot be assembled.
    pub condition: Condition,
    /// The same with all lengths in characteristic lengths of the mechanism.
    pub dimensionless_condition: Condition,
    /// The largest residuals over all frames.
    pub residuals: Residuals,
    /// The largest pressure angle of every contact.
    pub pressure_angles: Vec<LargestPressureAngle>,
    /// What transmissions and sensitivities ask for, at each frame.
    pub derivatives: Derivatives,
    /// How close each block is to singular at each frame, where it is asked for.
    pub monitor: Option<Monitor>,
    /// One sentence for each thing to look at.
    pub warnings: Vec<String>,
    /// Why the motion ends early, if it does.
    pub error: Option<String>,
}

impl Solution {
    /// Solves `system`, which must have passed `linkwright_codegen::check` and whose view loop by loop is `solved`, from the
    /// `estimate` (n) of its first pose, or else from the pose with every loop in its drawn mode; `reached` hears how many
    /// times were visited.
    ///
    /// Where that pose does not exist, Newton-Raphson on all equations may still lead from the drawing to another assembly:
    /// a warning says so.
    pub fn new(
        system: System,
        solved: Option<SolvedInterpreter>,
        points: Vec<usize>,
        schedule: &Schedule,
        estimate: Option<DVector<f64>>,
        reached: impl FnMut(usize),
    ) -> Solution {
        let interpreter = Interpreter::new(&system);
        let as_drawn = estimate.map(Ok).or_else(|| {
            let solved = solved.as_ref()?;
            Some(branches::assembled(solved, schedule.start.t, &[]))
        });
        let (estimate, not_as_drawn) = match as_drawn {
            Some(Ok(pose)) => (pose, None),
            Some(Err(why)) => (interpreter.estimate().clone(), Some(why)),
            None => (interpreter.estimate().clone(), None),
        };
        let settings = Settings::default();
        let trajectory = follow(&interpreter, &estimate, schedule, &settings, reached);
        let (q, t) = match &trajectory.start {
            Some(frame) => (&frame.q, frame.t),
            None => (&estimate, schedule.start.t),
        };
        let matrix = jacobian(&interpreter, q, t);
        let mut warnings = diagnosis::warnings(&system, &interpreter, &trajectory);
        if let (Some(why), Some(_)) = (not_as_drawn, &trajectory.start) {
            warnings.push(format!(
                "not assembled as it is drawn ({why}): Newton-Raphson on all equations found this pose, which may be of another assembly mode"
            ));
        }
        let end = |stop| diagnosis::end(&system, &interpreter, solved.as_ref(), &trajectory, stop);
        Solution {
            condition: Condition::of(&matrix),
            dimensionless_condition: Condition::of(&dimensionless(&interpreter, matrix)),
            residuals: Residuals::over(&interpreter, &trajectory.frames),
            derivatives: Derivatives::over(&system, &interpreter, &trajectory.frames),
            pressure_angles: pressure::largest(&system, &interpreter, &trajectory.frames),
            warnings,
            error: trajectory.stop.as_ref().map(end),
            monitor: None,
            trajectory,
            points,
            interpreter,
            solved,
            system,
        }
    }

    /// The same with a measure of each block at each frame.
    #[must_use]
    pub fn monitored(mut self) -> Solution {
        let times: Vec<f64> = self.frames().iter().map(|frame| frame.t).collect();
        let solved = self.solved.as_ref();
        let monitor = solved.map(|solved| Monitor::over(solved, &times));
        self.monitor = Some(monitor.unwrap_or_default());
        self
    }

    /// The name of the mechanism.
    pub fn name(&self) -> &str {
        &self.system.mechanism.name
    }

    /// The name of the motion, where the mechanism has several.
    pub fn motion(&self) -> Option<&str> {
        let motion = self.system.mechanism.motion.as_ref();
        motion.map(|motion| motion.name.as_str())
    }

    /// How a person names it: with its motion, where it has several.
    pub fn title(&self) -> String {
        self.system.mechanism.title()
    }

    /// The folder for its files, below one for all mechanisms: `excavator`, `excavator/reach`.
    pub fn folder(&self) -> PathBuf {
        std::iter::once(self.name()).chain(self.motion()).collect()
    }

    /// The frames that were wanted and could be solved.
    pub fn frames(&self) -> &[Frame<f64, Dyn>] {
        &self.trajectory.frames
    }

    /// The name and the motion of each shown point at `frame`.
    pub fn motions<'a>(
        &'a self,
        frame: &Frame<f64, Dyn>,
    ) -> impl Iterator<Item = (&'a str, Motion<f64>)> {
        let motions = self.interpreter.points(frame);
        self.points
            .iter()
            .map(move |point| (self.point_name(*point), motions[*point]))
    }

    /// The name of an output.
    pub fn point_name(&self, point: usize) -> &str {
        &self.system.outputs[point].name
    }

    /// How many scalar equations come from joints of `role`.
    pub fn equation_count(&self, role: Role) -> usize {
        let joints = &self.system.mechanism.joints;
        let rows = self.system.rows.iter();
        rows.filter(|row| joints[row.joint].role == role).count()
    }
}

/// The indices of the named outputs, in the order of the names; all outputs if none is named.
///
/// # Errors
/// A sentence that names the first unknown point and the known ones.
pub fn select(system: &System, names: &[String]) -> Result<Vec<usize>, String> {
    if names.is_empty() {
        return Ok((0..system.outputs.len()).collect());
    }
    let known = || system.outputs.iter().map(|output| output.name.as_str());
    let mut selected = Vec::with_capacity(names.len());
    for name in names {
        match known().position(|known| known == name) {
            Some(point) if selected.contains(&point) => {}
            Some(point) => selected.push(point),
            None => {
                let guess = match nearest(name, known()) {
                    Some(guess) => format!("; did you mean `{guess}`?"),
                    None => String::new(),
                };
                let list: Vec<&str> = known().collect();
                return Err(format!(
                    "no point `{name}` in `{}`{guess}\n  its points are: {}",
                    system.mechanism.name,
                    list.join(", ")
                ));
            }
        }
    }
    Ok(selected)
}
