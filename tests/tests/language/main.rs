//! Descriptions and tables of data: reading, errors, layout, and what stays the same when they are written otherwise.

mod bounds;
mod coloring;
mod columns;
mod corpora;
mod diagnostics;
mod dragging;
mod format;
mod fuzz;
mod metamorphic;
mod mutations;
mod names;
mod repetition;
#[path = "../../fuzz/src/lib.rs"]
mod targets;
mod units;
