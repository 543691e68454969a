//! System and Program of each motion → a Rust file.
//!
//! The file needs `linkwright` and nothing else, neither allocates nor panics, and is the same bytes on every run.

mod accessors;
mod assemblies;
mod block;
mod code;
mod coordinates;
mod docs;
mod equation;
mod explained;
mod expression;
mod file;
mod frame;
mod functions;
mod lints;
mod loads;
mod markdown;
mod module;
mod names;
mod newton;
mod normalized_determinant;
mod page;
mod parameters;
mod path;
mod points;
mod scope;
mod sensitivity;
mod shell;
mod statement;
mod tables;
mod textbook;
mod torn;
mod transmission;

pub use docs::documentation;
pub use file::file;
pub(super) use names::WORDS;
pub(in crate::emit) use names::not_a_type;
pub use names::{NAMING, type_name};
pub use page::page;
