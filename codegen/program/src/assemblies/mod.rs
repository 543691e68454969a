//! Finds all poses in which a block of Newton-Raphson can be assembled, with a proof of completeness.
//!
//! The poses of a block are the zeros of one or two functions over a turn of each argument. Bounds of these functions over
//! intervals isolate all zeros and exclude all other poses.

mod boxes;
mod elementary;
mod enclosed;
mod exchanges;
mod interval;
mod isolation;
mod meeting;
mod poses;
mod sought;
mod stored;
mod turns;

pub use enclosed::{Enclosed, Enclosing, Place};
pub use exchanges::exchanges;
pub use interval::Interval;
pub use meeting::never_meet;
pub use poses::{Pose, Poses, order, poses};
pub use sought::read;
pub use stored::{StoredAssemblies, StoredAssembly, stored};
pub use turns::counts_turns;
