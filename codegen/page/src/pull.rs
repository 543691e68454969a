//! Pulls a point of a mechanism toward a position, by its inputs and its time.
//!
//! A damped Newton method minimizes half the squared distance. Derivatives of the position by inputs and time are exact: velocities are
//! linear in the rates of inputs, accelerations quadratic, and both are solved at the pose. Every trial is reached along the path from
//! the last pose, so that the assembly stays.

use std::convert::Infallible;

use linkwright::{PointMotion, Settings, Shell, Signal};
use linkwright_solver::{
    InputLaws, InputSignals, Instant, Interpreted, Modes, Numbers, Schedule, View as _, follow,
};
use nalgebra::{DMatrix, DVector, Vector2};
use serde::Serialize;

use crate::controls::unit_of;
use crate::question::{Pull, Question, Range};
use crate::recorded::at_start;

/// Largest number of steps.
const MAX_STEPS: usize = 40;

/// Largest number of trials of a step.
const MAX_TRIALS: usize = 16;

/// Largest change of a variable in a step, in parts of its range.
const MAX_STEP_LENGTH: f64 = 0.05;

/// Number of attempts of a trial: a path that needs more is rejected at once, and a shorter one is tried.
const ATTEMPTS: u16 = 1;

/// First damping, relative to the largest second derivative.
const FIRST_DAMPING: f64 = 1e-4;

/// Least damping, which decides among inputs that move the point alike.
const LEAST_DAMPING: f64 = 1e-12;

/// Factors of the damping after steps that succeed and that fail.
const RELAXATION: [f64; 2] = [0.1, 4.0];

/// Distance from the goal that counts as zero, in characteristic lengths.
const RESOLUTION: f64 = 1e-12;

/// Distance between two solutions of one pose, in characteristic lengths.
const AGREEMENT: f64 = 1e-6;

/// Inputs, starts of free coordinates and time to which a pull leads.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Pulled {
    /// Names of inputs and free coordinates with their values, in the unit of their controls.
    pub values: Vec<(String, f64)>,
    /// Time (s).
    pub t: f64,
    /// Distance that remains (m).
    pub distance: f64,
    /// True if a motion under forces starts at the pose when the point is released.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub starts: bool,
    /// Label of the assembly; `None` for that of the question.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub assembly: Option<String>,
}

/// Mechanism with its values, and the start of its motion.
pub struct Scene {
    /// Mechanism.
    pub view: Interpreted,
    /// Pose and modes at the start; `None` for those of the drawing.
    pub chosen: Option<(Instant, Modes)>,
}

/// Point, its goal and what may move it.
struct Puller<'a> {
    view: &'a Interpreted,
    laws: InputLaws,
    point: usize,
    goal: Vector2<f64>,
    /// Indices of the inputs.
    inputs: Vec<usize>,
    /// Ends of the inputs and of the time.
    ends: Vec<[f64; 2]>,
    /// Times of the motion.
    range: Range,
    /// Characteristic length (m).
    length: f64,
}

/// Pose with its inputs and its time.
#[derive(Clone)]
struct Pose {
    shell: Shell<Interpreted>,
    /// Values of the inputs, then the time.
    values: Vec<f64>,
    /// Position of the point relative to its goal.
    residual: Vector2<f64>,
}

/// Derivatives of the position by the variables, in parts of their ranges.
struct Derivatives {
    first: Vec<Vector2<f64>>,
    second: Vec<Vec<Vector2<f64>>>,
}

/// Returns the inputs and the time to which a point is pulled, from the pose of the question; those of the question if nothing is nearer.
///
/// The inputs move first, and the time with them if they do not reach the position.
///
/// `scene_with` returns the scene for other values of inputs: a pose counts only if the motion of its scene leads to it, too.
///
/// # Errors
/// A sentence: the point does not exist, or the motion does not reach the time.
pub fn pulled(
    scene: &Scene,
    question: &Question,
    pull: &Pull,
    scene_with: impl Fn(&[(String, f64)]) -> Result<Scene, String>,
) -> Result<Pulled, String> {
    let puller = Puller::new(&scene.view, question, pull)?;
    let start = puller.start(scene, pull.t)?;
    let by_inputs = match puller.inputs.is_empty() {
        true => start.clone(),
        false => puller.nearest(start.clone(), false),
    };
    let by_all = puller.nearest(by_inputs.clone(), true);
    let is_in_motion = |pose: &Pose| {
        let result = puller.result(pose);
        let scene = scene_with(&result.values);
        let pose_of_scene = scene.and_then(|scene| puller.start(&scene, result.t));
        pose_of_scene
            .is_ok_and(|it| (it.residual - pose.residual).norm() <= AGREEMENT * puller.length)
    };
    let poses = [by_all, by_inputs];
    let pose = poses.iter().find(|it| is_in_motion(it)).unwrap_or(&start);
    Ok(puller.result(pose))
}

impl<'a> Puller<'a> {
    fn new(view: &'a Interpreted, question: &Question, pull: &Pull) -> Result<Puller<'a>, String> {
        let mechanism = &view.system().mechanism;
        let point = mechanism.points.iter().position(|it| it.name == pull.point);
        let point = point.ok_or_else(|| format!("no point is named `{}`", pull.point))?;
        pull.require_finite()?;
        let (mut inputs, mut ends) = (Vec::new(), Vec::new());
        let free = &mechanism.forces.free;
        for (index, input) in mechanism.inputs.iter().enumerate() {
            let is_constant = view.pool().graph.constant_value(input.signal[0]).is_some();
            let is_movable = is_constant || free.iter().any(|it| it.input == index);
            if let Some(range) = pull.ranges.get(&input.name).filter(|_| is_movable) {
                let unit = unit_of(view, input.dimension);
                inputs.push(index);
                ends.push(range.map(|it| it / unit.of_si(1.0)));
            }
        }
        ends.push([question.range.from, question.range.to]);
        Ok(Puller {
            view,
            laws: view.input_laws(),
            point,
            goal: Vector2::from(pull.to),
            inputs,
            ends,
            range: question.range,
            length: mechanism.characteristic_length,
        })
    }

    /// Returns the pose at a time (s) of the motion that is shown.
    fn start(&self, scene: &Scene, t: f64) -> Result<Pose, String> {
        let Range { from, to, step } = self.range;
        let laws = scene.view.input_laws();
        let mut moved = at_start(&scene.view, scene.chosen.clone(), from)?;
        let t = t.clamp(from, to);
        let schedule = Schedule::whole(from, t, step)?;
        let end = follow(&mut moved, &laws, &schedule.forward, |_, _| {
            Ok::<(), Infallible>(())
        });
        let Ok(end) = end;
        if let Some(end) = end {
            return Err(moved.ended(&end));
        }
        let (last, signals) = (moved.fuller(), laws.at(t));
        let mut shell = Shell::assemble(
            scene.view.clone(),
            last.parameters(),
            &Numbers(last.frame().q().to_vec()),
            last.branches().clone(),
            t,
            &signals,
            Settings {
                substeps: ATTEMPTS,
                ..Settings::default()
            },
        )
        .map_err(|failure| scene.view.not_assembled(&failure))?;
        shell.resume(last.frame(), last.branches(), &signals);
        let inputs = self.inputs.iter().map(|it| signals.0[*it].value);
        let values = inputs.chain([t]).collect();
        Ok(self.pose(shell, values))
    }

    fn pose(&self, shell: Shell<Interpreted>, values: Vec<f64>) -> Pose {
        let position = self.motion(shell.frame()).position;
        Pose {
            residual: Vector2::from(position) - self.goal,
            shell,
            values,
        }
    }

    fn motion(&self, instant: &Instant) -> PointMotion {
        self.view.points(instant)[self.point]
    }

    /// Returns the signals for values of the variables, with rates of the inputs.
    fn signals(&self, values: &[f64], rates: &[f64]) -> InputSignals {
        let mut signals = self.laws.at(values[self.inputs.len()]);
        for (variable, index) in self.inputs.iter().enumerate() {
            let rate = rates.get(variable).copied().unwrap_or(0.0);
            signals.0[*index] = Signal::new(values[variable], rate, 0.0);
        }
        signals
    }

    /// Returns the pose of other values on the path from a pose; `None` if the path does not lead there.
    fn along(&self, from: &Pose, values: Vec<f64>) -> Option<Pose> {
        let mut shell = from.shell.clone();
        let t = values[self.inputs.len()];
        shell.advance(t, &self.signals(&values, &[])).ok()?;
        Some(self.pose(shell, values))
    }

    /// Returns the derivatives at a pose; `None` if they do not exist.
    fn derivatives(&self, pose: &Pose) -> Option<Derivatives> {
        let count = self.inputs.len();
        let scale = |it: usize| self.ends[it][1] - self.ends[it][0];
        let with = |moving: &[(usize, f64)]| {
            let mut rates = vec![0.0; count];
            for (input, sign) in moving {
                rates[*input] = sign * scale(*input);
            }
            let signals = self.signals(&pose.values, &rates);
            let instant = pose.shell.frame_at(pose.values[count], &signals).ok()?;
            let motion = self.motion(&instant);
            Some([motion.velocity, motion.acceleration].map(Vector2::from))
        };
        let [velocity, acceleration] = with(&[])?;
        let passing = scale(count);
        let mut first = vec![passing * velocity; count + 1];
        let mut second = vec![vec![passing * passing * acceleration; count + 1]; count + 1];
        let mut accelerations = Vec::new();
        for input in 0..count {
            let [ahead, back] = [with(&[(input, 1.0)])?, with(&[(input, -1.0)])?];
            first[input] = 0.5 * (ahead[0] - back[0]);
            second[input][input] = 0.5 * (ahead[1] + back[1]) - acceleration;
            let mixed = 0.25 * passing * (ahead[1] - back[1]);
            (second[input][count], second[count][input]) = (mixed, mixed);
            for (other, of_other) in accelerations.iter().enumerate() {
                let both = with(&[(input, 1.0), (other, 1.0)])?[1];
                let mixed = 0.5 * (both - ahead[1] - of_other + acceleration);
                (second[input][other], second[other][input]) = (mixed, mixed);
            }
            accelerations.push(ahead[1]);
        }
        Some(Derivatives { first, second })
    }

    /// Returns the nearest pose to which steps downhill lead.
    fn nearest(&self, mut pose: Pose, has_time: bool) -> Pose {
        let count = self.inputs.len() + usize::from(has_time);
        let (mut damping, mut steps) = (FIRST_DAMPING, 0);
        while pose.residual.norm() > RESOLUTION * self.length && steps < MAX_STEPS {
            let Some(derivatives) = self.derivatives(&pose) else {
                break;
            };
            let free = self.free(&pose, &derivatives, count);
            // Inputs alone have been moved before.
            if has_time && steps == 0 && free.last() != Some(&self.inputs.len()) {
                break;
            }
            steps += 1;
            let mut next = None;
            for _ in 0..MAX_TRIALS {
                let step = derivatives.step(pose.residual, &free, damping);
                next = step.and_then(|step| self.trial(&pose, &free, &step));
                let factor = RELAXATION[usize::from(next.is_none())];
                damping = (factor * damping).max(LEAST_DAMPING);
                if next.is_some() {
                    break;
                }
            }
            match next {
                Some(next) => pose = next,
                None => break,
            }
        }
        pose
    }

    /// Returns the variables that move: those at an end stay there while the distance falls beyond it.
    fn free(&self, pose: &Pose, derivatives: &Derivatives, count: usize) -> Vec<usize> {
        let moves = |&it: &usize| {
            let ([low, high], value) = (self.ends[it], pose.values[it]);
            let slope = derivatives.first[it].dot(&pose.residual);
            !(low >= high
                || slope == 0.0
                || value <= low && slope >= 0.0
                || value >= high && slope <= 0.0)
        };
        (0..count).filter(moves).collect()
    }

    /// Returns the pose after a step; `None` if it is too long, leaves the path or does not approach the goal.
    fn trial(&self, pose: &Pose, free: &[usize], step: &DVector<f64>) -> Option<Pose> {
        let is_short = step.amax() <= MAX_STEP_LENGTH;
        let mut values = pose.values.clone();
        for (variable, part) in free.iter().zip(step.iter()) {
            let [low, high] = self.ends[*variable];
            let value = values[*variable];
            // A value that lies beyond an end already does not move further away.
            let [least, most] = [low.min(value), high.max(value)];
            values[*variable] = (value + part * (high - low)).clamp(least, most);
        }
        let next = (is_short && values != pose.values).then(|| self.along(pose, values))??;
        (next.residual.norm_squared() < pose.residual.norm_squared()).then_some(next)
    }

    fn result(&self, pose: &Pose) -> Pulled {
        let inputs = &self.view.system().mechanism.inputs;
        let values = self.inputs.iter().zip(&pose.values).map(|(index, value)| {
            let input = &inputs[*index];
            (
                input.name.clone(),
                unit_of(self.view, input.dimension).of_si(*value),
            )
        });
        Pulled {
            values: values.collect(),
            t: pose.values[self.inputs.len()],
            distance: pose.residual.norm(),
            starts: false,
            assembly: None,
        }
    }
}

impl Derivatives {
    /// Returns the damped step of these variables; `None` if the damped second derivatives are not positive definite.
    fn step(&self, residual: Vector2<f64>, free: &[usize], damping: f64) -> Option<DVector<f64>> {
        let count = free.len();
        let largest = free.iter().map(|&it| {
            let curved = residual.norm() * self.second[it][it].norm();
            self.first[it].norm_squared() + curved
        });
        let damping = damping * largest.fold(0.0, f64::max);
        let matrix = DMatrix::from_fn(count, count, |row, column| {
            let [row, column] = [free[row], free[column]];
            let curved = residual.dot(&self.second[row][column]);
            let damped = if row == column { damping } else { 0.0 };
            self.first[row].dot(&self.first[column]) + curved + damped
        });
        let downhill = free.iter().map(|&it| -self.first[it].dot(&residual));
        let downhill = DVector::from_iterator(count, downhill);
        (count > 0).then(|| Some(matrix.cholesky()?.solve(&downhill)))?
    }
}
