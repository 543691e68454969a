//! Makes sets of values of parameters and inputs, and summarizes what they lead to.
//!
//! A value depends only on its index: sets can be made in any order and in pieces.

mod axis;
mod extremes;
mod sobol;

pub use axis::Axis;
pub use extremes::Extremes;
pub use sobol::{BITS, MAX_DIMENSIONS, Sobol};
