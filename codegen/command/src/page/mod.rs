//! Makes one self-contained HTML file of a description and its motion.
//!
//! Drawings, formulas and derivations come from the generator, motions from the solver; this module arranges them. Scripts move the
//! drawing and draw curves from the numbers in the page, and load nothing. Every name and every line of documentation is escaped when
//! it enters the page. Numbers are JSON, in which no tag can end.

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
