//! Compares the C and the Rust modules of descriptions on equal calls, number by number as bits.
//!
//! Both are generated as a user would, compiled, and run with one script: the C files by every C compiler of the
//! machine, the Rust modules in a package of their own under the target folder. The programs print every number of
//! every frame as its bits.

pub mod case;
pub mod device;
pub mod elementary;
pub mod groups;
mod header;
mod program_c;
mod program_rust;
pub mod run;
