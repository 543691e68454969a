//! The order of modules, the documentation and the thresholds of the repository itself.

mod affected;
mod english;
mod failure_kinds;
mod links;
mod modules;
mod rooms;
mod stages;
mod thresholds;
