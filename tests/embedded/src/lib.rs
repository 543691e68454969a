//! Mechanisms of the repository, moved in the same way on every machine: what they print is compared bit by bit.
//!
//! The program is the same everywhere but for its [`Machine`]: firmware for Cortex-M, a program of the host, a module of WebAssembly.
#![no_std]

mod digest;
mod machine;
mod motion;
mod variants;
#[cfg(target_arch = "wasm32")]
mod wasm;

pub use machine::Machine;
pub use variants::run;
