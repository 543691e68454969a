//! Spreads poses over the configurations of a mechanism, from which equilibria are sought.

use std::f64::consts::PI;

use linkwright::{Blocks as _, Shell};
use nalgebra::DVector;

use super::search::Unbalanced;
use super::statics::{PoseForces, StaticEquations};
use crate::interpreted::Interpreted;
use crate::search::POSE_TOLERANCE;
use crate::sets::{Sobol, random_coordinate};
use crate::supplied::Numbers;
use crate::view::View as _;

/// Largest distance of a start from the design configuration: half a turn, or this many characteristic lengths.
const SCATTER: f64 = PI;

/// Seed of starts with too many unknowns for Sobol's sequence.
const SEED: u64 = 1;

/// Number of steps of a walk, and length of each, scaled.
const WALK_STEPS: usize = 8;
const WALK_STEP: f64 = 0.3;

/// Number of walks that continue one another.
const WALKS: u32 = 8;

/// Poses about the design configuration: walks along the constraints, and estimates anywhere that reach other assemblies.
pub(super) struct Starts<'a> {
    equations: &'a StaticEquations,
    center: &'a PoseForces,
    sobol: Option<Sobol>,
    /// End of the last walk.
    walked: PoseForces,
}

/// Number of steps of half a turn.
const STEPS: u32 = 16;

impl StaticEquations {
    /// Turns a free angle by half a turn while the others stand still; `None` for a length, or where the mechanism does not reach it.
    pub fn half_turned(&self, from: &PoseForces, free: usize) -> Option<PoseForces> {
        let count = self.motion.free_count();
        let first = self.count() - count;
        if !self.is_angle(first + free) {
            return None;
        }
        let mut pose = from.clone();
        for _ in 0..STEPS {
            let mut rates = DVector::zeros(count);
            rates[free] = PI / f64::from(STEPS);
            let along = pose.basis.rows(first, count).lu().solve(&rates)?;
            pose = self.moved(&pose, &along)?;
        }
        Some(pose)
    }
}

impl Starts<'_> {
    /// Creates the estimates about a pose.
    pub fn about<'a>(equations: &'a StaticEquations, center: &'a PoseForces) -> Starts<'a> {
        let count = equations.count();
        Starts {
            equations,
            center,
            sobol: Sobol::new(count, None),
            walked: center.clone(),
        }
    }

    /// Returns the pose on the constraints next to the estimate with this index; `None` if none is reached.
    pub fn scattered(&self, index: u32) -> Option<PoseForces> {
        let center = &self.center.unknowns;
        let shares = (0..center.len()).map(|dimension| match &self.sobol {
            // The first point of the sequence is a corner.
            Some(sobol) => sobol.coordinate(index + 1, dimension),
            None => random_coordinate(SEED, index, dimension),
        });
        let scales = &self.equations.motion.coordinate_scales;
        let places = shares.zip(center).zip(scales);
        let estimate =
            places.map(|((share, center), scale)| center + SCATTER * scale * (2.0 * share - 1.0));
        self.equations.closed(estimate.collect())
    }

    /// Returns the end of the walk with this index, which continues the last one or begins in the design configuration.
    pub fn walked(&mut self, index: u32) -> PoseForces {
        if index.is_multiple_of(WALKS) {
            self.walked = self.center.clone();
        }
        let shares = (0..self.equations.freedom())
            .map(|dimension| 2.0 * random_coordinate(SEED, index, dimension) - 1.0);
        let along = DVector::from_iterator(self.equations.freedom(), shares);
        let mut direction = &self.walked.basis * along;
        for _ in 0..WALK_STEPS {
            let along = self.walked.basis.tr_mul(&direction);
            let along = &along * (WALK_STEP / along.norm());
            direction = &self.walked.basis * &along;
            match self.equations.moved(&self.walked, &along) {
                Some(next) => self.walked = next,
                None => break,
            }
        }
        self.walked.clone()
    }
}

/// Returns the design configuration on the constraints.
pub(super) fn assembled(
    interpreted: &Interpreted,
    equations: &StaticEquations,
    t: f64,
) -> Result<PoseForces, Unbalanced> {
    let parameters = interpreted.nominal_parameters();
    let (pose, modes) = (
        interpreted.drawn_pose(&parameters),
        interpreted.drawn_branches(),
    );
    let inputs = interpreted.input_laws().at(t);
    let settings = Default::default();
    let shell = Shell::assemble(
        interpreted.clone(),
        &parameters,
        &pose,
        modes,
        t,
        &inputs,
        settings,
    );
    let shell =
        shell.map_err(|failure| Unbalanced::NotAssembled(interpreted.reported(&failure)))?;
    let mut instant = equations.motion.instant(t);
    instant.set_frame(&shell.frame().frame());
    let unknowns = equations.motion.level(&instant, 0);
    equations.closed(unknowns).ok_or(Unbalanced::Singular)
}

/// True if the blocks, in the modes of the design configuration, assemble a pose from its free coordinates.
pub(super) fn has_design_modes(
    interpreted: &Interpreted,
    equations: &StaticEquations,
    pose: &PoseForces,
) -> bool {
    let inputs = equations.motion.layout().inputs(&pose.instant);
    let shell = Shell::assemble(
        interpreted.clone(),
        &interpreted.nominal_parameters(),
        &Numbers(pose.instant.q().to_vec()),
        interpreted.drawn_branches(),
        pose.instant.t(),
        &inputs,
        Default::default(),
    );
    shell.is_ok_and(|shell| {
        let mut instant = pose.instant.clone();
        instant.set_frame(&shell.frame().frame());
        let unknowns = equations.motion.level(&instant, 0);
        let away = equations.turned_difference(&unknowns, &pose.unknowns);
        away.norm() <= POSE_TOLERANCE
    })
}
