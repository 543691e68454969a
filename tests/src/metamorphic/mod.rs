//! Rewrites descriptions of a mechanism, and predicts the results.
//!
//! Every rewriting edits the text at the positions of the syntax tree, so that the whole pipeline runs again.

pub mod edits;
pub mod frames;
pub mod lengths;
pub mod naming;
pub mod order;
pub mod rewriting;
pub mod roles;
pub mod swapping;
