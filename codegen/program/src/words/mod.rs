//! System and SolvedPlan → what a person calls the parts of a mechanism.
//!
//! Links are called by the bodies and pins that they lie between, blocks by the pins of their loops, and a singular pose by what
//! is in line there. The same words stand in messages, documentation, derivations and generated code. Afterwards a text is a
//! [`Phrase`]: names and formulas keep their places until somebody prints it. Deliberately unknown here: how formulas look, and
//! any output language.

mod bearings;
mod constraint;
mod coupled;
mod ends;
mod known;
mod link;
mod lists;
mod loops;
mod phrase;
mod pins;
mod singular;

pub use bearings::not_carried;
pub use constraint::constraint;
pub use known::Known;
pub use lists::{counted, enumerated};
pub use loops::loop_name;
pub use phrase::{Phrase, Piece};
pub use pins::pin;
pub use singular::Singular;

pub(crate) use link::Triangle;
pub(crate) use phrase::phrase;
