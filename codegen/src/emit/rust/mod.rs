//! System and Program → a Rust module.
//!
//! The module needs `linkwright` and nothing else, neither allocates nor panics, and is the same bytes on every run.

mod coordinates;
mod docs;
mod equations;
mod expression;
mod given;
mod layout;
mod lints;
mod literal;
mod module;
mod scalar;
mod solved;
mod solver;

pub use module::module;
pub use scalar::Scalar;
