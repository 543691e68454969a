//! Moves poses along the constraints, and to equilibria.

use nalgebra::{DMatrix, DVector};

use super::statics::{PoseForces, StaticEquations};

/// Largest number of corrections of a pose.
const CORRECTIONS: usize = 24;

/// Scaled correction below which a pose needs only one more.
const SMALL: f64 = 1e-7;

/// Largest scaled length of one correction of an estimate, and turn of one step to an equilibrium.
pub(super) const MAX_STEP: f64 = 0.5;

/// Largest number of steps to an equilibrium.
pub(super) const MAX_STEPS: usize = 200;

/// Smallest, first and largest damping of a step, relative to the square of the stiffness.
const DAMPING: [f64; 3] = [1e-16, 1e-3, 1e8];

/// Scaled step at which an equilibrium counts as reached.
const PRECISE: f64 = 1e-11;

/// Scaled distance at which the stiffness beside a pose is compared.
const BESIDE: f64 = 1e-8;

/// Pose in which forces nearly vanish.
#[derive(Clone, Debug)]
pub(super) struct Settled {
    pub pose: PoseForces,
    /// True if Newton's steps have become as small as rounding.
    pub is_precise: bool,
}

impl StaticEquations {
    /// Returns the pose on the constraints next to an estimate; `None` if none is reached.
    pub fn closed(&self, estimate: Vec<f64>) -> Option<PoseForces> {
        let mut unknowns = estimate;
        let mut is_close = false;
        for _ in 0..CORRECTIONS {
            let pose = self.forces(&unknowns)?;
            let rows = pose.residual.len();
            let step = -(pose.inverse.columns(0, rows) * &pose.residual);
            let size = step.norm();
            if !size.is_finite() {
                return None;
            }
            if is_close || rows == 0 {
                unknowns = self.stepped(&unknowns, &step);
                return self.forces(&unknowns);
            }
            is_close = size <= SMALL;
            let step = step * (MAX_STEP / size).min(1.0);
            unknowns = self.stepped(&unknowns, &step);
        }
        None
    }

    /// Returns the pose that a step along the constraints leads to; `None` if it is not near.
    pub fn moved(&self, from: &PoseForces, along: &DVector<f64>) -> Option<PoseForces> {
        let step = &from.basis * along;
        let estimate = self.stepped(&from.unknowns, &step);
        let pose = self.closed(estimate.clone())?;
        let correction = self.difference(&pose.unknowns, &estimate).norm();
        (correction <= step.norm().max(SMALL)).then_some(pose)
    }

    /// True if loads are smooth in a pose: a spring whose ends meet has a stiffness that falls at once beside it.
    pub fn is_smooth(&self, pose: &PoseForces) -> bool {
        let stiffness = pose.stiffness(self);
        let largest = stiffness.magnitude.amax();
        (0..self.freedom()).all(|place| {
            [BESIDE, -BESIDE].iter().all(|distance| {
                let mut along = DVector::zeros(self.freedom());
                along[place] = *distance;
                let beside = self.moved(pose, &along);
                beside.is_some_and(|it| it.stiffness(self).magnitude.amax() >= 0.5 * largest)
            })
        })
    }

    /// Returns the norm of the turns of all angles in a step along the constraints.
    pub fn turn(&self, pose: &PoseForces, along: &DVector<f64>) -> f64 {
        let step = &pose.basis * along;
        let angles = step.iter().enumerate();
        let turns = angles.filter(|(place, _)| self.is_angle(*place));
        turns.map(|(_, turn)| turn * turn).sum::<f64>().sqrt()
    }

    /// Moves from a pose on the constraints to one in which forces vanish, or nearly so where the stiffness is singular: by damped
    /// steps of Newton's method, and of Levenberg and Marquardt where these lead away. `None` if the forces have another minimum, or no pose is reached.
    pub fn settled(&self, from: PoseForces) -> Option<Settled> {
        let mut pose = from;
        let mut damping = DAMPING[1];
        for _ in 0..MAX_STEPS {
            let stiffness = pose.stiffness(self);
            let matrix = &stiffness.reduced;
            if matrix.iter().any(|it| !it.is_finite()) {
                return None;
            }
            let newton = matrix.clone().lu().solve(&pose.force);
            if let Some(step) = newton.filter(|it| it.norm() <= PRECISE) {
                let last = self.moved(&pose, &step);
                return Some(Settled {
                    pose: last.unwrap_or(pose),
                    is_precise: true,
                });
            }
            let quiet = (0..self.freedom()).all(|place| {
                let along = pose.basis.column(place).into_owned();
                pose.force[place].abs() <= pose.rounding(&along, &stiffness)
            });
            if quiet {
                return Some(Settled {
                    pose,
                    is_precise: false,
                });
            }
            if let Some(next) = self.newton_step(&pose, matrix) {
                pose = next;
                continue;
            }
            let square = matrix.tr_mul(matrix);
            let scale = square.diagonal().amax();
            if scale == 0.0 {
                return None;
            }
            let slope = matrix.tr_mul(&pose.force);
            loop {
                let damped =
                    &square + DMatrix::identity(square.nrows(), square.ncols()) * (damping * scale);
                let step = damped.cholesky().map(|it| it.solve(&slope));
                let step = step.map(|it| &it * (MAX_STEP / self.turn(&pose, &it)).min(1.0));
                let next = step.and_then(|it| self.moved(&pose, &it));
                match next.filter(|it| it.force.norm() < pose.force.norm()) {
                    Some(next) => {
                        pose = next;
                        damping = (damping * 0.1).max(DAMPING[0]);
                        break;
                    }
                    None if damping > DAMPING[2] => return None,
                    None => damping *= 8.0,
                }
            }
        }
        None
    }

    /// Returns the pose of a damped step of Newton's method that comes nearer to the equilibrium, in the step that the old stiffness
    /// estimates from there (Deuflhard's natural test, which no scaling of forces changes); `None` if none does.
    fn newton_step(&self, pose: &PoseForces, matrix: &DMatrix<f64>) -> Option<PoseForces> {
        let factors = matrix.clone().lu();
        let step = factors.solve(&pose.force)?;
        let longest = (MAX_STEP / self.turn(pose, &step)).min(1.0);
        let parts = [1.0, 0.25, 0.0625].map(|it| it * longest);
        parts.into_iter().find_map(|part| {
            let next = self.moved(pose, &(&step * part))?;
            let force = pose.basis.tr_mul(&(&next.basis * &next.force));
            let remaining = factors.solve(&force)?;
            (remaining.norm() <= (1.0 - 0.25 * part) * step.norm()).then_some(next)
        })
    }
}
