//! *A checked System and a schedule → what can be said about its assemblies and its singular poses.*
//!
//! What the text and JSON of `linkwright check` have in common, worked out once. The module does not know how it is printed.

use linkwright_codegen::emit::{Notation, derivation};
use linkwright_codegen::model::Role;
use linkwright_codegen::system::System;

use crate::assemblies::{Assemblies, assemblies};
use crate::closeness::{Approach, Closeness};
use crate::condition::{Condition, dimensionless, jacobian};
use crate::diagnosis::time;
use crate::number::scientific;
use crate::schedule::Schedule;
use crate::solution::Solution;
use crate::solved_interpreter::SolvedInterpreter;

/// A measure below this is worth a warning: links within about half a degree of being in line.
pub const CLOSE: f64 = 0.01;

/// One step of the plan.
#[derive(Clone, Debug)]
pub struct CheckedStep {
    /// Where it is singular, in words.
    pub pose: derivation::SingularPose,
    /// How many solutions its closed form has; `None` for Newton-Raphson.
    pub solutions: Option<usize>,
    /// Where it comes closest to singular; `None` where it never is singular or the motion could not be followed.
    pub approach: Option<Approach>,
    /// The reciprocal condition of the dimensionless Φ_q there.
    pub reciprocal: Option<f64>,
}

/// Everything that is checked.
#[derive(Clone, Debug)]
pub struct Check {
    /// The motion that was followed.
    pub solution: Solution,
    /// KDOF: coordinates less the equations of joints.
    pub kinematic_freedom: i64,
    /// NDOF: the same less the equations of drivers.
    pub net_freedom: i64,
    /// The steps in solve order.
    pub steps: Vec<CheckedStep>,
    /// The assemblies at the start; `None` where there is no order in which blocks could be solved.
    pub assemblies: Option<Assemblies>,
    /// What to look at.
    pub warnings: Vec<String>,
}

impl Check {
    /// Checks `system`, which must have passed `linkwright_codegen::check`, over a schedule whose times are all wanted.
    pub fn new(system: System, schedule: &Schedule, reached: impl FnMut(usize)) -> Check {
        let solved = SolvedInterpreter::new(&system);
        let solution = Solution::new(system, solved, Vec::new(), schedule, None, reached);
        let solved = solution.solved.as_ref();
        let coordinates = solution.system.coordinates.len() as i64;
        let kinematic_freedom = coordinates - solution.equation_count(Role::Constraint) as i64;
        let net_freedom = kinematic_freedom - solution.equation_count(Role::Driver) as i64;
        let mut warnings = solution.warnings.clone();
        let steps = match solved {
            Some(solved) => steps(solved, &solution),
            None => Vec::new(),
        };
        for step in &steps {
            warnings.extend(step.warning());
        }
        Check {
            kinematic_freedom,
            net_freedom,
            assemblies: solved
                .map(|solved| assemblies(solved, &solution.interpreter, schedule.start.t)),
            steps,
            warnings,
            solution,
        }
    }

    /// The step that comes closest to singular.
    pub fn closest(&self) -> Option<&CheckedStep> {
        let measured = self.steps.iter().filter(|it| it.approach.is_some());
        measured.min_by(|a, b| {
            let measure = |it: &CheckedStep| it.approach.as_ref().map_or(1.0, |it| it.measure);
            measure(a).total_cmp(&measure(b))
        })
    }
}

impl CheckedStep {
    fn warning(&self) -> Option<String> {
        let approach = self.approach.as_ref().filter(|it| it.measure < CLOSE)?;
        Some(format!(
            "block {}, {}: only {} from a singular pose at t = {} s; {}",
            self.pose.block + 1,
            self.pose.unknowns,
            scientific(approach.measure, 2),
            time(approach.t),
            self.pose.sentence()
        ))
    }
}

fn steps(solved: &SolvedInterpreter, solution: &Solution) -> Vec<CheckedStep> {
    let mut times: Vec<f64> = solution.frames().iter().map(|frame| frame.t).collect();
    // Where a motion ends its last pose counts too.
    let stop = solution.trajectory.stop.as_ref();
    times.extend(stop.and_then(|stop| stop.last.as_ref()).map(|last| last.t));
    let approaches = Closeness::new(solved).approaches(&times);
    let poses = derivation::singular_poses(&solved.system, &solved.plan, Notation::Ascii);
    let checked = poses.into_iter().map(|pose| {
        let approach = approaches
            .iter()
            .find(|it| (it.block, it.step) == (pose.block, pose.step));
        CheckedStep {
            solutions: solutions(solved, pose.block, pose.step),
            approach: approach.cloned(),
            reciprocal: approach.map(|it| reciprocal(solution, it)),
            pose,
        }
    });
    checked.collect()
}

/// Two for what has an assembly mode, one for what is linear.
fn solutions(solved: &SolvedInterpreter, block: usize, step: usize) -> Option<usize> {
    use linkwright_codegen::structure::Step;
    match &solved.plan.blocks[block].steps[step] {
        Step::Newton { .. } => None,
        Step::Linear { .. } | Step::TwoSlides { .. } => Some(1),
        _ => Some(2),
    }
}

/// The reciprocal condition of the dimensionless Φ_q at the closest approach.
fn reciprocal(solution: &Solution, approach: &Approach) -> f64 {
    let interpreter = &solution.interpreter;
    let matrix = jacobian(interpreter, &approach.q, approach.t);
    Condition::of(&dimensionless(interpreter, matrix)).reciprocal
}
