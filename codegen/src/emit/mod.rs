//! System and Program → Rust, text, LaTeX and drawings.
//!
//! The first three print the same nodes in the same order of terms: that in which the joint names its bodies, then constants, then
//! functions of time. Deliberately unknown here: files, and where an expression came from.

pub mod derivation;
pub mod drawing;
mod formula;
pub mod latex;
mod module;
mod named_parts;
mod notation;
mod parts;
pub mod report;
pub mod rust;
mod scalar;
pub mod text;

pub use notation::Notation;
pub use scalar::Scalar;
