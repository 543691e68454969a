//! Finds the equilibria of a mechanism with free coordinates at rest: poses in which gravity, springs and loads do no virtual work.
//!
//! Drivers and inputs stand at their values at one time. The pose of one degree of freedom is followed along its curve, and more of them
//! start from many poses. Derivatives are exact, so that the Hessian is. Dampers and inertia do not matter, and stops do not hold.

mod curve;
mod descent;
mod events;
mod follower;
mod path;
mod pose;
mod search;
mod starts;
mod statics;
mod turns;
mod verdict;

pub use crate::simulation::Varied;
pub use curve::CurveEnd;
pub use path::{EquilibriumPath, PathEnd, PathEvent, PathEventKind, PathRow, Unfollowed};
pub use search::{Coverage, Equilibria, Unbalanced};
pub use verdict::{SmallMotion, Stability, Verdict};

use statics::{PoseForces, StaticEquations};

use crate::dense::Dense;
use crate::instant::Instant;
use crate::view::View;

/// Equilibrium of a mechanism.
#[derive(Clone, Debug)]
pub struct Equilibrium {
    /// Pose, at rest.
    pub instant: Instant,
    /// Values of the free coordinates, in m or rad, in the order of the description.
    pub free: Vec<f64>,
    /// Requested forces and measures, in the order of [`crate::reported::names`]; `None` where the equations are singular.
    pub reported: Option<Vec<f64>>,
    /// Potential energy of gravity and springs (J).
    pub potential: f64,
    /// Energy (J) of the loads and the stiffness over a characteristic length or a radian.
    pub energy_unit: f64,
    /// Stability, and small motions.
    pub verdict: Verdict,
    /// True if other equilibria of equal energy are next to it without a gap.
    pub is_of_family: bool,
    /// True if a curve connects it with the design configuration; `None` with several free coordinates.
    pub is_connected: Option<bool>,
    /// True if the assembly modes of the design configuration lead to it from its free coordinates.
    pub has_design_modes: bool,
    /// Limits that it breaks: indices into those of the mechanism.
    pub broken: Vec<usize>,
    pose: PoseForces,
}

impl StaticEquations {
    /// Returns the equilibrium in a pose.
    pub(super) fn equilibrium(
        &self,
        view: &Dense,
        pose: PoseForces,
        verdict: Verdict,
    ) -> Equilibrium {
        let mechanism = &view.system().mechanism;
        let free = self.count() - self.motion.free_count();
        let reported = View::reported(view, &pose.instant);
        let count = mechanism.measurements.len();
        let limits = mechanism.limits.iter().enumerate();
        let broken = limits.filter(|(_, limit)| {
            let values = reported.as_ref();
            let measures = values.map(|it| &it[it.len() - count..]);
            measures.is_some_and(|it| limit.margin(it[limit.measurement]) < 0.0)
        });
        Equilibrium {
            instant: pose.instant.clone(),
            free: pose.unknowns[free..].to_vec(),
            potential: pose.potential,
            energy_unit: pose.magnitude.amax(),
            verdict,
            is_of_family: false,
            is_connected: None,
            has_design_modes: false,
            broken: broken.map(|(place, _)| place).collect(),
            reported,
            pose,
        }
    }
}
