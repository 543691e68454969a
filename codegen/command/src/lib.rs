//! Runs the command `linkwright`: parses arguments, prints and writes results, and returns an exit code.
//!
//! `linkwright-solver` solves, and `linkwright-codegen` has equations and diagnostics. This package has arguments, reports, pictures and
//! the language server. The package `linkwright-cli` is its binary.
//!
//! # Features
//!
//! All features are on by default. `--help` lists all commands in every build; one whose feature is missing exits with 2 and names it.
//!
//! | feature | use | dependencies |
//! |---|---|---|
//! | `png` | `draw` with `--png`, or with a file that ends in `.png` | `epaint_default_fonts`, `resvg` |
//! | `lsp` | `lsp` | `linkwright-editing`, `lsp-server`, `lsp-types` |
//! | `calibrate` | `calibrate` | `linkwright-calibrate` |
//! | `live` | `view` with `--live`; needs the page that `codegen/web/build` builds | |
//! | `man` | `man` | `clap_mangen` |

pub mod arguments;
pub mod colors;
pub mod command;
mod interruption;
#[cfg(feature = "lsp")]
pub mod language_server;
pub mod output;
pub mod progress;
pub mod report;
pub mod sweep;
pub mod terminal;

pub use command::run;
