//! *What a mechanism is given along a motion* → *what each way to solve it makes of it*.

use std::rc::Rc;

use super::truth::Levels;

/// The signals at a time: value, rate and acceleration of each.
pub type Signals = Rc<dyn Fn(f64) -> Vec<[f64; 3]>>;

/// A motion that a mechanism is to be taken through: assembled at the first time, moved to each of the others.
#[derive(Clone)]
pub struct Sample {
    /// What varies within a family.
    pub x: f64,
    /// The parameters, in written order.
    pub parameters: Vec<f64>,
    /// The times (s).
    pub times: Vec<f64>,
    /// In how many steps the exact solution goes from one time to the next.
    pub fine: u32,
    /// The signals.
    pub signals: Signals,
    /// The pose from which the mechanism is assembled.
    pub estimate: Vec<f64>,
    /// A pose from which the exact solution is found.
    pub start: Vec<f64>,
    /// The size of the mechanism (m).
    pub length: f64,
}

/// What a solver made of the instants of a sample, up to its first failure.
pub type Outcomes = Vec<Result<Levels<f64>, String>>;

/// What a failure is called in a table.
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
