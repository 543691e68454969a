//! The repository's mechanisms, generated in single precision.

macro_rules! modules {
    ($($(#[$text:meta])+ $name:ident;)+) => {
        $($(#[$text])+ pub mod $name {
            linkwright::include_mechanism!($name);
        })+
    };
}

modules! {
    /// The exam's mechanism.
    two_body;
    /// The excavator with frames at the centers of mass.
    excavator;
    /// The excavator with frames at pins.
    excavator_pins;
    /// The excavator's tool alone.
    excavator_tool;
    /// The arm of the ADAMS exports.
    arm;
    /// A four-bar linkage.
    four_bar;
    /// A slider-crank.
    slider_crank;
    /// An inverted slider-crank.
    inverted_slider_crank;
    /// A platform on three driven legs.
    platform_3rpr;
    /// A six-stage scissor lift.
    scissor;
    /// A Stephenson six-bar driven at its far link.
    stephenson;
}
