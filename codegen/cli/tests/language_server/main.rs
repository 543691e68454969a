//! The language server from the outside: an editor that speaks with the real command.

mod client;
mod diagnostics;
mod editing;
mod grammar;
mod lifecycle;
mod names;
mod robustness;
mod speed;
