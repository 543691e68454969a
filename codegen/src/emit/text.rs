//! Formulas and whole systems in plain text.

mod formula;
mod inspect;
mod table;

pub use inspect::inspect;
