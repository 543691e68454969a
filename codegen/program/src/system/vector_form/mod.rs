//! Derives constraints in vector form, the basis of the solved formulation.
//!
//! Every rotated local vector R s is a pair of symbols of the pool, an *arm*, so that rows are linear in positions and arms. A sliding joint
//! has its displacement ℓ as an unknown, a link without a body its angle ψ.
//!
//! Unknowns that can be eliminated by inspection have constant coefficients. Time derivatives follow from the rotation of an arm
//! with its body: d(R s)/dt = φ̇ Ω R s.

pub(super) mod making;
mod operands;

use super::Unknown;
use super::mark_names::MarkNames;
use super::orientation::Orientations;
use crate::expr::ExprId;
use crate::joint::Quantity;
use crate::joint::geometry::{BodyId, Vector};

/// Vector form of a mechanism.
#[derive(Clone, Debug)]
pub struct VectorForm {
    /// Coordinates in their order, then the auxiliary unknowns of the joints.
    pub unknowns: Vec<Unknown>,
    /// Rows, as many as unknowns if the mechanism is driven.
    pub rows: Vec<VectorRow>,
    /// Bodies that share their sine and cosine.
    pub orientations: Orientations,
    /// Position r + arm of each declared point, in the mechanism's order.
    pub points: Vec<Vector>,
    /// For each joint, true for each textbook row that is monitored and not solved.
    pub(super) dropped: Vec<Vec<bool>>,
    // The angle of each body; `None` for the ground.
    angles: Vec<Option<usize>>,
    pub(super) mark_names: MarkNames,
}

/// Scalar equation of the vector form.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VectorRow {
    /// Index into the mechanism's joints.
    pub joint: usize,
    /// Residual, zero if the equation is satisfied.
    pub residual: ExprId,
    /// Quantity of the residual.
    pub quantity: Quantity,
    /// Component of the joint's equation: `x`, `angle`; empty if there is only one.
    pub component: &'static str,
}

impl VectorForm {
    /// Returns the unknown angle of a body.
    pub fn angle_of(&self, body: usize) -> usize {
        let Some(angle) = self.angles[body] else {
            unreachable!("the ground has no angle")
        };
        angle
    }

    /// True if a body rotates with the angle `unknown`.
    pub fn turns(&self, body: BodyId, unknown: usize) -> bool {
        let (leader, _) = self.orientations.leader(body);
        leader != BodyId::GROUND && self.angle_of(leader.0) == unknown
    }
}
