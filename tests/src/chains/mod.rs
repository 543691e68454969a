//! The study of chains that are solved by way of few tears, beside the same chains solved by all equations at once.
//!
//! [`compiled`] chains are followed over the whole of their drive → their frames, [`truth`] says where they are exactly →
//! [`measure`] says how far off they are → [`report`].

pub mod compiled;
pub mod measure;
pub mod report;
pub mod truth;
