//! Samples: the inputs of a mechanism along a motion, and the outcomes of its solution.

use std::rc::Rc;

use super::truth::Levels;

/// Signals at a time: value, rate and acceleration of each.
pub type Signals = Rc<dyn Fn(f64) -> Vec<[f64; 3]>>;

/// Motion of a mechanism: assembled at the first time, moved to each of the others.
#[derive(Clone)]
pub struct Sample {
    /// Varied quantity of the family.
    pub x: f64,
    /// Parameters, in written order.
    pub parameters: Vec<f64>,
    /// Times (s).
    pub times: Vec<f64>,
    /// Number of steps of the exact solution between two times.
    pub fine: u32,
    /// Signals.
    pub signals: Signals,
    /// Pose from which the mechanism is assembled.
    pub estimate: Vec<f64>,
    /// Pose from which the exact solution starts.
    pub start: Vec<f64>,
    /// Size of the mechanism (m).
    pub length: f64,
}

/// Levels at the instants of a sample, up to the first failure of a solver.
pub type Outcomes = Vec<Result<Levels<f64>, String>>;

/// Name of a failure in a table.
pub fn named<T>(kind: linkwright::FailureKind<T>) -> &'static str {
    use linkwright::FailureKind as Kind;
    match kind {
        Kind::Singular { .. } => "singular",
        Kind::Diverged => "diverged",
        Kind::Cycling => "cycling",
        Kind::Stalled => "stalled",
        Kind::IterationLimit => "iteration limit",
        Kind::OutOfReach { .. } => "out of reach",
        Kind::WrongBranch => "wrong branch",
        Kind::StepTooLarge => "step too large",
        Kind::Undecided => "undecided branch",
        Kind::NotFinite => "not finite",
        _ => "another failure",
    }
}
