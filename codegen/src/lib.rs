//! Derives the constraint equations of a planar mechanism and writes them as specialised Rust.

pub mod diagnostic;
pub mod syntax;
pub mod expr;
pub mod joint;
pub mod model;
pub mod system;
pub mod structure;
pub mod program;
pub mod emit;
