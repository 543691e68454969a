//! The language server from the outside: an editor that speaks with the real command.

#![cfg(feature = "lsp")]

mod client;
mod completion;
mod diagnostics;
mod editing;
mod grammar;
mod layout;
mod lifecycle;
mod meaning;
mod names;
mod ranges;
mod renaming;
mod repeated;
mod robustness;
mod speed;
