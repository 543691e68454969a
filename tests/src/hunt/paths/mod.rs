//! The hunt for frames off the path: families of mechanisms that are hard to follow, moved in steps of every size.
//!
//! *A seed* → [`families`] → [`course`] (a description, how it is driven, and for how long) → [`stepping`] (what `advance` makes of it)
//! and [`trace`] (where the smooth path goes) → [`judge`] → [`tally`]. An `Ok` frame off the path is wrong, and so is one where the
//! path has ended.

pub mod course;
pub mod families;
pub mod judge;
pub mod report;
pub mod run;
pub mod schedule;
pub mod stepping;
pub mod tally;
pub mod trace;
