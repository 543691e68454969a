//! Makes sets of values of parameters and inputs, and summarizes what they lead to.
//!
//! A value depends only on its index: sets can be made in any order and in pieces.

mod axis;
mod extremes;
mod normal;
mod random;
mod sobol;

pub use axis::Axis;
pub use extremes::Extremes;
pub use normal::normal_quantile;
pub use random::random_coordinate;
pub use sobol::{BITS, MAX_DIMENSIONS, Sobol};
