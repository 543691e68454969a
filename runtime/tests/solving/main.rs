//! Newton-Raphson, factorizations, paths and failures, on equations written by hand.

mod assembly;
mod condition;
mod counted;
mod dimensions;
mod exam;
mod exam_equations;
mod factorization;
mod failures;
mod math;
mod measure;
mod paths;
mod regularity;
mod single;
mod substeps;
mod turning;
