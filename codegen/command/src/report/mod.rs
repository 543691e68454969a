//! Writes a motion and the results of checks as text, JSON, CSV and pictures: one file per output.
//!
//! No output evaluates more than the motion of points.

pub mod aligned;
#[cfg(feature = "calibrate")]
pub mod calibration;
pub mod comparison;
pub mod comparison_json;
pub mod comparison_plot;
pub mod drawing;
pub mod dxf;
pub mod effort;
pub mod equilibrium_json;
pub mod equilibrium_path;
pub mod equilibrium_plot;
pub mod equilibrium_text;
pub mod first_step;
pub mod frame_table;
#[cfg(feature = "png")]
pub mod gif;
mod hatching;
pub mod json;
pub mod measured_data;
pub mod motion_table;
pub mod pairs;
pub mod paths;
pub mod picture;
pub mod plot;
pub mod proof_text;
#[cfg(feature = "png")]
pub mod raster;
pub mod region_picture;
pub mod region_text;
pub mod reported;
pub mod stack_up;
pub mod stack_up_json;
pub mod stack_up_plot;
pub mod summary;
pub mod sweep_plot;
#[cfg(feature = "calibrate")]
pub mod synthesis;
#[cfg(feature = "calibrate")]
pub mod synthesis_json;
pub mod travel_json;
pub mod travel_text;
