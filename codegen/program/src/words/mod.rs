//! Names links, blocks and singular poses.
//!
//! Links are named by their bodies and pins, blocks by the pins of their loops, and singular poses by collinear links. Messages,
//! documentation, derivations and generated code use the same names.
//!
//! A text is a [`Phrase`], in which names and formulas stay symbolic until the text is printed.

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
