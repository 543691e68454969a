//! Checks of the fuzz targets; `tests/tests/language/fuzz.rs` of the repository runs them on a stable compiler.

pub mod expressions;
pub mod format;
pub mod language;
pub mod numbers;
pub mod outcome;
