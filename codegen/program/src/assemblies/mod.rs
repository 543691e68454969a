//! *A block that Newton-Raphson solves, and what is known before it* → *every pose in which it can be assembled, with a proof that there
//! are no others*.
//!
//! The poses of a block are the zeros of one or two functions over a turn of each of their arguments. Bounds of these functions over
//! intervals isolate all zeros, and exclude everything else. Deliberately unknown here: what came before the block, whether a pose
//! can be reached, and how it is written.

mod boxes;
mod elementary;
mod enclosed;
mod interval;
mod isolation;
mod meeting;
mod poses;
mod sought;
mod stored;
mod turns;

pub use enclosed::{Enclosed, Enclosing, Place};
pub use interval::Interval;
pub use meeting::never_meet;
pub use poses::{Pose, Poses, order, poses};
pub use sought::read;
pub use stored::{StoredAssemblies, StoredAssembly, stored};
pub use turns::counts_turns;
