//! Transforms functions independently of their meaning, one transformation per file.

pub mod constants;
pub mod costs;
mod elimination;
pub mod enclosure;
pub(super) mod fields;
pub mod iterations;
pub mod liveness;
pub mod names;
pub(super) mod sharing;
mod usage;
pub mod work;
pub(super) mod zeros;
