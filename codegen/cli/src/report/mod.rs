//! *A [`Solution`](crate::solution::Solution) → text, JSON, CSV and SVG.*
//!
//! One file per output. None of them evaluates more than the motion of points, and none knows where its output goes.

pub mod assembly_plot;
pub mod check_json;
pub mod check_text;
pub mod comma_separated;
pub mod json;
pub mod motion_table;
pub mod plot;
pub mod summary;
