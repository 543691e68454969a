//! The study of chains that are solved by tearing, beside equal chains solved by all equations at once.
//!
//! [`compiled`] chains are followed over the whole range of their drive, [`truth`] gives their exact frames,
//! [`measure`] the errors, and [`report`] the tables.

pub mod compiled;
pub mod measure;
pub mod report;
pub mod truth;
