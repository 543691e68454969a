//! Short versions of the studies whose reports are committed.

mod baseline;
mod calibration;
mod chains;
mod growth;
mod hunt;
mod instruments;
mod proofs;
mod reports;
mod stability;
mod study;
mod synthesis;
