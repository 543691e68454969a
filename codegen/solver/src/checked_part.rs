//! Holds the result of a check for one subsystem of the plan.

use linkwright_codegen::stages::emit::derivation::SingularPose;

use crate::approach::Approach;

/// Subsystem of the plan.
#[derive(Clone, Debug)]
pub struct CheckedPart {
    /// Singular poses in words.
    pub pose: SingularPose,
    /// Number of solutions of its closed form; `None` for Newton-Raphson.
    pub solutions: Option<usize>,
    /// Closest approach to a singular pose; `None` if it is never singular, or if the motion could not be followed.
    pub approach: Option<Approach>,
    /// Reciprocal condition of the dimensionless Φ_q there.
    pub reciprocal: Option<f64>,
}
