//! The repository's mechanisms, generated in single precision.

include!(concat!(env!("OUT_DIR"), "/single_modules.rs"));

/// The excavator's tool alone.
pub mod excavator_tool {
    linkwright::include_mechanism!(excavator_tool);
}
