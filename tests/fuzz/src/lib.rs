//! What the targets do with their input; `tests/tests/language/fuzz.rs` of the repository does the same on a stable compiler.

pub mod expressions;
pub mod format;
pub mod language;
pub mod numbers;
