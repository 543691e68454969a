//! System and Plan → Program.
//!
//! Straight-line statements for every function of the generated module. Afterwards everything is defined before it is used,
//! nothing is computed that no result needs, every angle has one sine and one cosine, and what several results share has a
//! name. Deliberately unknown here: the syntax of Rust, and what the results mean.

mod addends;
mod constants;
mod lower;
mod names;
mod operations;
pub mod solved;
mod statements;
mod usage;

pub use addends::{Addend, Compared, Power, addends, compared};
pub use constants::{Constant, ConstantPart, Constants};
pub use lower::lower;
pub use operations::{LARGEST_PRODUCT, Operations};
pub use statements::{Inputs, Statement, Straight};

/// What is emitted for a mechanism.
#[derive(Clone, Debug)]
pub struct Program {
    /// The solved view.
    pub solved: Option<solved::SolvedProgram>,
    /// The constants of all functions that are no short decimals, each once.
    pub constants: Constants,
    /// The functions of the textbook view; left out of mechanisms whose dense matrices fit no stack.
    pub textbook: Option<Textbook>,
    /// The drawing's value of every unknown of the vector form, where parameters change it.
    pub drawn: Option<Straight>,
    /// The lengths of [`crate::system::System::lengths`], where there are any.
    pub lengths: Option<Straight>,
    /// The motion of each point: position, velocity, acceleration, x and y each. Empty where single outputs are asked for.
    pub points: Vec<Straight>,
    /// What each pressure angle follows from: the velocity along and across the normal, and the square of the sliding speed.
    /// Empty where single outputs are asked for.
    pub pressures: Vec<Straight>,
}

/// The functions of the textbook view.
#[derive(Clone, Debug)]
pub struct Textbook {
    /// Φ: one result a row.
    pub residual: Straight,
    /// Φ_q: one result for each entry that is not identically zero, row by row.
    pub jacobian: Straight,
    /// Φ_t: one result a row.
    pub time_derivative: Straight,
    /// γ: one result a row.
    pub gamma: Straight,
    /// The residuals of the rows that are monitored instead of solved, where there are any.
    pub monitored: Option<Straight>,
}

/// More coordinates than these make a dense Φ_q of over 175 kB, which no firmware and few threads have room for.
pub const LARGEST_TEXTBOOK: usize = 150;
