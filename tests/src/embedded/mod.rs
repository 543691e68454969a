//! Mechanisms as firmware: the output, the cost and the contents of the programs of `tests/embedded`.
//!
//! The programs move equal mechanisms in equal ways; see `tests/embedded/src/motion.rs`. All others must match those
//! of the host, bit by bit.

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
