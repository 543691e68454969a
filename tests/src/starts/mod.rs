//! *Estimates that are off at random* → *where a mechanism is assembled from them*, and at what cost.

pub mod measure;
pub mod perturbation;
pub mod report;
