//! System and Program of each motion → a Rust file.
//!
//! The file needs `linkwright` and nothing else, neither allocates nor panics, and is the same bytes on every run.

mod block;
mod closeness;
mod coordinates;
mod docs;
mod explained;
mod expression;
mod file;
mod frame;
mod functions;
mod given;
mod layout;
mod lints;
mod literal;
mod markdown;
mod module;
mod newton;
mod path;
mod points;
mod scope;
mod sensitivity;
mod shell;
mod tables;
mod textbook;
mod transmission;

pub use file::file;
pub use literal::Scalar;
