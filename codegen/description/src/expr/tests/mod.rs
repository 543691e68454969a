//! Tests of the symbolic core. All random input comes from a fixed seed, named in every message.

mod bounds;
mod cancellation;
mod canonical;
mod choices;
mod estimate;
mod exactness;
mod generator;
mod identities;
mod numbers;
mod scale;
mod tidy;
mod tree;
mod values;
