//! System and Program → Rust, text, LaTeX, MathML and drawings.
//!
//! [`Language`] lists the languages in which a mechanism becomes a module: each has a room of its own, and what all of them say and
//! compute stands in `module/`. Another one is another room and a line in that list.
//!
//! All but the last print the same nodes in the same order of terms: that in which the joint names its bodies, then constants, then
//! functions of time. Deliberately unknown here: files, and where an expression came from.

mod c;
mod code;
pub mod derivation;
pub mod drawing;
mod formula;
mod language;
pub mod latex;
mod layout;
mod lines;
pub mod markup;
pub mod mathml;
mod module;
mod named_parts;
mod notation;
mod parts;
pub mod report;
pub mod rust;
mod scalar;
pub mod text;
mod typeset;

pub use language::{Language, OutputFile};
pub use notation::Notation;
pub use scalar::Scalar;
