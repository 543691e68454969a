//! The hunt for frames off the path: families of mechanisms that are hard to follow, moved in steps of every size.
//!
//! [`families`] make a [`course`] from a seed: a description, its drivers, and its duration. [`stepping`] records the
//! steps of `advance`, [`trace`] follows the smooth path, [`judge`] compares both, and [`tally`] counts. An `Ok`
//! frame off the path is wrong, and so is one after the end of the path.

pub mod course;
pub mod families;
pub mod judge;
pub mod report;
pub mod run;
pub mod schedule;
pub mod stepping;
pub mod tally;
pub mod trace;
