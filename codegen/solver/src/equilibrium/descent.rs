//! Follows forces downhill to a stable equilibrium, as a strongly damped motion would.

use nalgebra::{DMatrix, SymmetricEigen};

use super::pose::{MAX_STEP, MAX_STEPS, Settled};
use super::statics::{PoseForces, StaticEquations};

/// Least stiffness that a step assumes, as a part of the largest.
const FLOOR: f64 = 1e-6;

/// Largest number of halvings of a step.
const HALVINGS: usize = 20;

/// Scaled length of a step that Newton's method may take over.
const CAPTURE: f64 = 1e-3;

impl StaticEquations {
    /// Returns the equilibrium below a pose; `None` if forces lead away without end, or to where the mechanism cannot move on.
    pub fn descended(&self, from: PoseForces) -> Option<Settled> {
        let mut pose = from;
        for _ in 0..MAX_STEPS {
            let matrix = pose.stiffness(self).reduced;
            if matrix.iter().any(|it| !it.is_finite()) {
                return None;
            }
            let symmetric = SymmetricEigen::new(0.5 * (&matrix + matrix.transpose()));
            let least = FLOOR * symmetric.eigenvalues.amax();
            if least == 0.0 {
                return None;
            }
            // Against a negative stiffness, a step goes as far as against a positive one.
            let weights = symmetric.eigenvalues.map(|it| 1.0 / it.abs().max(least));
            let is_valley = symmetric.eigenvalues.min() > least;
            let modes = &symmetric.eigenvectors;
            let softened = modes * DMatrix::from_diagonal(&weights) * modes.transpose();
            let step = softened * &pose.force;
            if is_valley && step.norm() <= CAPTURE {
                return self.settled(pose);
            }
            let turn = self.turn(&pose, &step).max(step.norm());
            let mut step = &step * (MAX_STEP / turn).min(1.0);
            let mut halvings = 0;
            pose = loop {
                let next = self.moved(&pose, &step);
                // Beyond the bottom of the valley, forces point back.
                let next = next.filter(|next| {
                    let ahead = &pose.basis * &step;
                    let forward = next.basis.tr_mul(&ahead).dot(&next.force);
                    forward >= -0.5 * step.dot(&pose.force)
                });
                match next {
                    Some(next) => break next,
                    None if halvings < HALVINGS => {
                        halvings += 1;
                        step *= 0.5;
                    }
                    None => return None,
                }
            };
        }
        None
    }
}
