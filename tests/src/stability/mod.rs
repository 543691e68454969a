//! The study of stability: errors of compiled mechanisms on hard cases, against high precision and beside predicted
//! bounds.
//!
//! [`families`] lists the cases, [`truth`] solves them in 384 bits, [`bounded`], [`dense`] and [`blocks`] predict the
//! error in floating point, [`verdict`] compares, [`cause`] finds the causes of failures, [`report`] prints.

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
