//! What the tests share: descriptions, solvers, reference tables, random numbers and error bounds.
//!
//! One thing per module. Nothing here asserts what a test is about; the files under `tests/` do.

pub mod ankle;
pub mod baseline;
pub mod c;
pub mod calibration;
pub mod chains;
pub mod damped_chain;
pub mod description;
pub mod deviation;
pub mod dyad_chain;
pub mod elementary;
pub mod embedded;
pub mod files;
pub mod forces;
pub mod free_motion;
pub mod generated;
pub mod hunt;
pub mod jet;
pub mod large;
pub mod law;
pub mod magnitude;
pub mod majorant;
pub mod metamorphic;
pub mod method;
pub mod multipliers;
pub mod pantograph;
pub mod plan;
pub mod printed;
pub mod proofs;
pub mod random;
pub mod reference;
pub mod sample;
pub mod simulated;
pub mod single;
pub mod sled;
pub mod solver;
pub mod stability;
pub mod starts;
pub mod stencil;
pub mod stiff;
pub mod study;
pub mod swing;
pub mod table;
pub mod user_package;
pub mod values;
