//! The study of stability: *hard cases of compiled mechanisms* → *errors against high precision beside predicted bounds*.
//!
//! [`families`] lists the cases, [`truth`] solves them in 384 bits, [`bounded`], [`dense`] and [`blocks`] predict how far floating
//! point may be off, [`verdict`] compares, [`cause`] says why there is no answer, [`report`] prints.

mod allowance;
pub mod blocks;
pub mod bounded;
pub mod cause;
pub mod chart;
pub mod compiled;
pub mod dense;
pub mod families;
pub mod poses;
pub mod precise;
pub mod report;
pub mod sample;
pub mod texts;
pub mod truth;
pub mod verdict;
