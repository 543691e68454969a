//! Formulas and whole systems in LaTeX, for amsmath.

mod formula;
mod inspect;

pub use inspect::inspect;
