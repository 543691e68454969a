//! Checks a mechanism over a schedule: its assemblies and its singular poses.

use std::convert::Infallible;

use linkwright::{Blocks, Shell};
use linkwright_codegen::stages::model::Role;
use linkwright_codegen::stages::system::System;
use nalgebra::DVector;

use crate::approach::{Approach, Watch};
use crate::assemblies::{Assemblies, assemblies};
use crate::checked_part::CheckedPart;
use crate::condition::{Condition, dimensionless, jacobian};
use crate::interpreted::Interpreted;
use crate::losses::Losses;
use crate::measure_watch::{MeasureRanges, MeasureWatch};
use crate::proof::Proof;
use crate::schedule::Schedule;
use crate::textbook::TextbookEquations;
use crate::trajectory::follow;
use crate::view::View;
use crate::warnings::warnings;

/// Measure below which a warning is given: links within about half a degree of collinear.
pub(crate) const WARNING_MEASURE: f64 = 0.01;

/// Results of all checks.
///
/// ```
/// use linkwright_codegen::Source;
/// use linkwright_solver::{Check, Interpreted, Schedule};
///
/// let text = "
///     mechanism four_bar {
///         point A = (0, 0), D = (100mm, 0);
///         body crank   at (0, 0, 40deg)       { A: (0, 0), B: (40mm, 0) }
///         body coupler at (30mm, 25mm, 20deg) { B: (0, 0), C: (120mm, 0) }
///         body rocker  at (100mm, 0, 57deg)   { D: (0, 0), C: (80mm, 0) }
///         revolute A(ground, crank);
///         revolute B(crank, coupler);
///         revolute C(coupler, rocker);
///         revolute D(ground, rocker);
///         drive phi(crank) = 40deg + 3*t;
///     }";
/// let read = linkwright_codegen::read(&Source::new("four_bar.mech", text)).expect("no errors");
/// let blocks = Interpreted::new(&read.motions[0]).expect("the equations determine the motion");
/// let schedule = Schedule::range(0.0, 2.0, 0.1).expect("a step");
/// let check = Check::new(blocks, &schedule, |_| ());
/// assert_eq!((check.kinematic_freedom, check.net_freedom), (1, 0));
/// assert_eq!(check.range, Some([0.0, 2.0]));
/// // Coupler and rocker meet at either side of the diagonal BD.
/// assert_eq!(check.assemblies.found.len(), 2);
/// // They are closest to collinear while the crank points to D: BD = 60 mm, and the law of cosines gives 0.8958.
/// let sine = check.smallest_measure().expect("a loop");
/// assert!((sine - (1.0 - (0.0172_f64 / 0.0192).powi(2)).sqrt()).abs() < 1e-6);
/// ```
#[derive(Clone, Debug)]
pub struct Check {
    /// Mechanism.
    pub interpreted: Interpreted,
    /// KDOF: number of coordinates minus number of joint equations.
    pub kinematic_freedom: i64,
    /// NDOF: KDOF minus number of driver equations.
    pub net_freedom: i64,
    /// Subsystems in solve order.
    #[doc(hidden)]
    pub parts: Vec<CheckedPart>,
    /// Time of the assembly (s).
    pub start: f64,
    /// First and last time that could be solved (s); `None` if the mechanism cannot be assembled.
    pub range: Option<[f64; 2]>,
    /// Assemblies at the start.
    pub assemblies: Assemblies,
    /// Extremes of measures, and broken limits.
    #[doc(hidden)]
    pub measured: MeasureRanges,
    /// Losses by friction at the visited times; `None` without friction.
    #[doc(hidden)]
    pub losses: Option<Losses>,
    /// Warnings.
    pub warnings: Vec<String>,
    /// Reason of an early end of the motion; `None` if it is complete.
    pub error: Option<String>,
    /// True if a length, a ratio or a mass that must be positive is not, so that no assembly exists.
    pub is_refused: bool,
}

impl Check {
    /// Checks a mechanism over a schedule whose times are all requested; `reached` receives the number of visited times.
    pub fn new(
        interpreted: Interpreted,
        schedule: &Schedule,
        mut reached: impl FnMut(usize),
    ) -> Check {
        let system = interpreted.system();
        let coordinates = system.coordinates.len() as i64;
        let kinematic_freedom = coordinates - equation_count(system, Role::Constraint) as i64;
        let net_freedom = kinematic_freedom - equation_count(system, Role::Driver) as i64;
        let start = schedule.start.t;
        let laws = interpreted.input_laws();
        let parameters = interpreted.nominal_parameters();
        let pose = interpreted.drawn_pose(&parameters);
        let modes = interpreted.drawn_branches();
        let (blocks, inputs) = (interpreted.clone(), laws.at(start));
        let assembled = Shell::assemble(
            blocks,
            &parameters,
            &pose,
            modes,
            start,
            &inputs,
            Default::default(),
        );
        let (mut range, mut error, mut approaches) = (None, None, Vec::new());
        let mut measuring = MeasureWatch::new(&interpreted);
        let mut losses = Losses::of(interpreted.pool(), system);
        let failed = assembled.as_ref().err().map(|failure| failure.kind);
        let is_refused = failed.is_some_and(|kind| kind.rejects_values());
        let assemblies = match is_refused {
            true => Assemblies::refused(&interpreted),
            false => assemblies(&interpreted, start),
        };
        match assembled {
            Err(failure) => error = Some(interpreted.not_assembled(&failure)),
            Ok(mut shell) => {
                let mut watch = Watch::new(interpreted.measured(), laws.clone());
                watch.see(&shell);
                measuring.iter_mut().for_each(|it| it.see(&shell));
                see_losses(&mut losses, &shell);
                let (mut count, mut last) = (1, start);
                let seen = |shell: &Shell<Interpreted>, _| {
                    watch.see(shell);
                    measuring.iter_mut().for_each(|it| it.see(shell));
                    see_losses(&mut losses, shell);
                    count += 1;
                    last = shell.frame().t();
                    reached(count);
                    Ok::<(), Infallible>(())
                };
                if let Ok(Some(end)) = follow(&mut shell, &laws, &schedule.forward, seen) {
                    // The last pose of a motion that ends early counts too.
                    watch.see(&shell);
                    measuring.iter_mut().for_each(|it| it.see(&shell));
                    error = Some(interpreted.ended(&end.failure, &end.last));
                }
                range = Some([start, last]);
                approaches = watch.finish(&shell);
            }
        }
        let poses = interpreted.singular_poses();
        Check {
            kinematic_freedom,
            net_freedom,
            losses,
            measured: measuring.map(MeasureWatch::finish).unwrap_or_default(),
            warnings: warnings(&approaches, poses, WARNING_MEASURE),
            parts: parts(&interpreted, &approaches),
            start,
            range,
            assemblies,
            error,
            is_refused,
            interpreted,
        }
    }

    /// Proves the motion over the checked schedule, with bounds of the positions of these outputs.
    #[doc(hidden)]
    pub fn prove(&self, schedule: &Schedule, points: &[usize]) -> Proof {
        Proof::new(&self.interpreted, schedule, &self.parts, points)
    }

    /// Unknowns of a subsystem in words; empty if it is never singular.
    #[doc(hidden)]
    pub fn unknowns_of(&self, block: usize, part: usize) -> &str {
        let mut poses = self.parts.iter().map(|it| &it.pose);
        let singular_pose = poses.find(|it| (it.block, it.part) == (block, part));
        singular_pose.map_or("", |it| &it.unknowns)
    }

    /// Measure of the closest approach to a singular pose over the motion: 0 at a singular pose, 1 at most. It is the sine
    /// of the angle between two links, or of more directions their normalized determinant. `None` if no subsystem is
    /// ever singular.
    pub fn smallest_measure(&self) -> Option<f64> {
        Some(self.closest()?.approach.as_ref()?.measure)
    }

    /// Returns the subsystem that comes closest to singular; `None` if none is ever singular.
    #[doc(hidden)]
    pub fn closest(&self) -> Option<&CheckedPart> {
        let measured = self.parts.iter().filter(|it| it.approach.is_some());
        let measure = |it: &CheckedPart| it.approach.as_ref().map_or(1.0, |it| it.measure);
        measured.min_by(|a, b| measure(a).total_cmp(&measure(b)))
    }
}

/// Adds an instant to the losses by friction.
fn see_losses(losses: &mut Option<Losses>, shell: &Shell<Interpreted>) {
    if let (Some(losses), Some(columns)) = (losses, View::reported(shell.blocks(), shell.frame())) {
        losses.see(shell.frame().t(), &columns);
    }
}

/// Number of scalar equations of joints of `role`.
pub fn equation_count(system: &System, role: Role) -> usize {
    let joints = &system.mechanism.joints;
    system
        .rows
        .iter()
        .filter(|row| joints[row.joint].role == role)
        .count()
}

fn parts(interpreted: &Interpreted, approaches: &[Approach]) -> Vec<CheckedPart> {
    let textbook = TextbookEquations::new(interpreted.pool(), interpreted.system());
    let poses = interpreted.singular_poses().iter();
    let checked = poses.map(|pose| {
        let subsystem = (pose.block, pose.part);
        let approach = approaches
            .iter()
            .find(|it| (it.part.block, it.part.part) == subsystem);
        CheckedPart {
            solutions: interpreted.program().forms[pose.block][pose.part].modes(),
            approach: approach.cloned(),
            reciprocal: approach.map(|it| reciprocal(&textbook, it)),
            pose: pose.clone(),
        }
    });
    checked.collect()
}

/// Returns the reciprocal condition of the dimensionless Φ_q at the closest approach.
fn reciprocal(textbook: &TextbookEquations, approach: &Approach) -> f64 {
    let q = DVector::from_column_slice(approach.instant.q());
    let matrix = jacobian(textbook, &q, approach.instant.t());
    Condition::of(&dimensionless(textbook, matrix)).reciprocal
}
