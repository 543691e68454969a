//! The order of modules, the documentation and the thresholds of the repository itself.

mod affected;
mod alike;
mod english;
mod failure_kinds;
mod links;
mod modules;
mod pipeline_table;
mod public;
mod rooms;
mod stages;
mod thresholds;
