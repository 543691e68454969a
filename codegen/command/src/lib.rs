//! *The command line's arguments* → *what is printed and written, and an exit code*.
//!
//! Everything that is solved is solved by `linkwright-solver`, equations and diagnostics come from `linkwright-codegen`: this
//! package holds arguments, reports and pictures.

pub mod arguments;
pub mod colors;
pub mod command;
pub mod data;
pub mod language_server;
pub mod motion;
pub mod output;
pub mod page;
pub mod progress;
pub mod report;
pub mod terminal;

pub use command::run;
