//! *A description and its motion* → *one HTML file that needs nothing else*.
//!
//! The text comes from the rooms that say the same elsewhere: drawings, formulas and derivations from the generator, motions from
//! the solver. Here it gets its places. The page moves the drawing and draws curves by itself, from the numbers that it holds;
//! it asks nobody for anything. Every name and every line of documentation is escaped where it enters the page, and numbers are
//! JSON in which no tag can end.

mod constraints;
mod equations;
mod given;
mod number;
mod players;
mod recorded;
mod shown_units;
mod solution;
mod start;
mod whole;

pub use whole::{Live, Page, page, problem};
