//! Mechanisms as firmware: *the programs of `tests/embedded`* → *what they print, what they cost and what is in them*.
//!
//! The programs move the same mechanisms in the same way; see `tests/embedded/src/motion.rs`. Those of the host are the yardstick of
//! all others, bit by bit.

pub mod build;
pub mod c;
pub mod calls;
pub mod figures;
pub mod limits;
pub mod modules;
pub mod printed;
pub mod program;
pub mod report;
pub mod symbols;
pub mod tools;
pub mod work;
