//! Error against run time, and growth with size: measurements and the reports on them.
//!
//! The binaries `work-precision` and `growth` call this; what is measured is behind [`crate::method::Method`].

pub mod chart;
pub mod committed;
pub mod destination;
pub mod environment;
pub mod exponent;
pub mod growth;
pub mod measurement;
pub mod outputs;
pub mod table;
