//! System and Program of each motion → a Rust file.
//!
//! The file needs `linkwright` and nothing else, neither allocates nor panics, and is the same bytes on every run.

mod coordinates;
mod docs;
mod equations;
mod expression;
mod file;
mod given;
mod layout;
mod lints;
mod literal;
mod module;
mod scalar;
mod solved;
mod solver;
mod tables;

pub use file::file;
pub use scalar::Scalar;
