//! Moves several mechanisms of one description in step, each in a lane of its own.
//!
//! A lane has the bits of the mechanism alone, whatever the other lanes do.
//!
//! `linkwright generate --lanes 8` writes a module `lanes` into the module of a mechanism whose blocks are closed forms. It solves the same
//! equations for [`Lanes`] of numbers, which compilers vectorize. With the feature `simd`, the widest instruction set is chosen at run time.

pub(crate) mod elementary;
mod group;
mod mask;
mod values;
mod vectorized;
mod windows;

#[doc(hidden)]
pub use group::Conditions;
pub use group::{Group, InLanes};
pub use linkwright_math::Lanes;
pub use mask::Mask;
#[doc(hidden)]
pub use vectorized::vectorized;

#[doc(hidden)]
pub use values::{LaneValues, ReadLanes, Zero};
