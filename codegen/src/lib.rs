//! Derives the constraint equations of a planar mechanism and writes them as specialised Rust.

pub mod diagnostic;
pub mod expr;
pub mod syntax;
