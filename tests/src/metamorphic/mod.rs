//! *A description* → *the same mechanism, written in another way*, and what its results must be then.
//!
//! Every rewriting works on the text, at the places that the syntax tree names, so that the whole pipeline is passed again.

pub mod edits;
pub mod frames;
pub mod lengths;
pub mod naming;
pub mod order;
pub mod rewriting;
pub mod roles;
pub mod swapping;
