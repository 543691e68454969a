//! System and Program of each motion → a header and a source of C99, and the runtime that they are compiled with.
//!
//! The mechanism's files need `linkwright.h` and `linkwright.c`, which are written beside them, and the C library's <math.h>. They are
//! the same bytes on every run, allocate nothing, hold no state and call nothing by recursion; the header can be included from C++.
//! What is computed, and in which order, is what the Rust module computes.

mod accessors;
mod api;
mod ascii;
mod assemblies;
mod assembly;
mod block;
mod block_names;
mod comment;
mod coordinates;
mod equations;
mod expression;
mod file;
mod frame;
mod isolation;
mod loads;
mod newton;
mod normalized_determinant;
mod parameters;
mod path;
mod points;
mod printer;
mod runtime;
mod sensitivity;
mod shell;
mod statement;
mod tables;
mod textbook;
mod torn;
mod transmission;
mod words;

pub use file::texts;
pub use words::NAMING;
