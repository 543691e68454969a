//! Writes a system and its program as Rust, C, text, LaTeX, MathML and pictures.
//!
//! [`Language`] lists the languages of modules. Each has a folder of its own, and the parts common to all are in
//! `module/`. Another language is another folder and a line in that list.
//!
//! All except for pictures print the same nodes in one order of terms: that in which the joint names its bodies, then
//! constants, then functions of time.

mod c;
mod code;
pub mod derivation;
pub mod drawing;
mod formula;
pub mod inspection;
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

pub(crate) use language::Form;
pub use language::{Conventions, Language, OutputFile};
pub use notation::Notation;
pub use scalar::Scalar;
