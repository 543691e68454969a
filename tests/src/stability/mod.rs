//! The study of stability: *hard cases of compiled mechanisms* → *errors against high precision beside predicted bounds*.
//!
//! [`families`] lists the cases, [`truth`] solves them in 384 bits and predicts how far floating point may be off,
//! [`verdict`] compares, [`report`] prints.

pub mod bounded;
pub mod chart;
pub mod compiled;
pub mod families;
pub mod precise;
pub mod report;
pub mod sample;
pub mod texts;
pub mod truth;
pub mod verdict;
