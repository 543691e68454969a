//! Assembles mechanisms from estimates with random errors, and measures success and cost.

pub mod measure;
pub mod perturbation;
pub mod report;
