//! The described mechanisms of the repository, generated at build time.
//!
//! Each `.mech` file beside this package's manifest becomes a module. The modules need neither the standard library nor an
//! allocator.
//!
//! ```
//! use linkwright_mechanisms::excavator::Excavator;
//!
//! let mut arm = Excavator::assemble(0.0)?;
//! let frame = arm.advance(0.01)?;
//! let tool = frame.point_k();
//! assert!((tool.position[0] + 1.2).abs() < 0.01);
//! # Ok::<(), linkwright::Failure>(())
//! ```
#![no_std]

linkwright::include_mechanism! {
    /// The two-body mechanism of the ME 451 midterm.
    pub mod two_body;
}

linkwright::include_mechanism! {
    /// The excavator-like arm with ten bodies and two actuators, frames at the centers of mass.
    pub mod excavator;
}

linkwright::include_mechanism! {
    /// Excavator-like arm with every body's frame at one of its pins.
    pub mod excavator_pins;
}

linkwright::include_mechanism! {
    /// Excavator-like arm with only the motion of its tool as output.
    pub mod excavator_tool;
}

linkwright::include_mechanism! {
    /// Excavator-like arm driven from either end: from its actuators, or from its tool.
    pub mod excavator_motions;
}

linkwright::include_mechanism! {
    /// The ten-body arm whose motion MSC ADAMS has computed.
    pub mod arm;
}

linkwright::include_mechanism! {
    /// A four-bar linkage whose crank turns all the way round.
    pub mod four_bar;
}

linkwright::include_mechanism! {
    /// An offset slider-crank.
    pub mod slider_crank;
}

linkwright::include_mechanism! {
    /// A rod on a crank that slides through a turning sleeve.
    pub mod inverted_slider_crank;
}

linkwright::include_mechanism! {
    /// A platform on three legs of driven length, whose pose no construction with two circles gives.
    pub mod platform_3rpr;
}

linkwright::include_mechanism! {
    /// A scissor lift of six stages.
    pub mod scissor;
}

linkwright::include_mechanism! {
    /// A six-bar driven at its far link, which keeps four links coupled.
    pub mod stephenson;
}

linkwright::include_mechanism! {
    /// Theo Jansen's walking leg.
    pub mod jansen;
}

linkwright::include_mechanism! {
    /// Peaucellier's cell, whose point R moves on a straight line.
    pub mod peaucellier;
}

linkwright::include_mechanism! {
    /// The quick return of a shaping machine.
    pub mod quick_return;
}

linkwright::include_mechanism! {
    /// A Scotch yoke, whose motion is exactly harmonic.
    pub mod scotch_yoke;
}

linkwright::include_mechanism! {
    /// A double wishbone suspension, moved at the wheel.
    pub mod double_wishbone;
}

linkwright::include_mechanism! {
    /// A pantograph, traced by its two coordinates.
    pub mod pantograph;
}

linkwright::include_mechanism! {
    /// A planetary gear with its ring held.
    pub mod planetary_gear;
}

linkwright::include_mechanism! {
    /// Rack and pinion steering.
    pub mod rack_steering;
}

linkwright::include_mechanism! {
    /// A disc cam with a roller follower.
    pub mod disc_cam;
}

linkwright::include_mechanism! {
    /// A cam designed from the motion of its follower.
    pub mod cam_dwell;
}

linkwright::include_mechanism! {
    /// The ankle of a humanoid, from its joint to its motors and back.
    pub mod ankle;
}

linkwright::include_mechanism! {
    /// The differential of a wrist, from its motors to its joint and back.
    pub mod differential_wrist;
}

/// Andrews' squeezing mechanism, with its masses and its spring.
pub mod andrews {
    linkwright::include_mechanism!(andrews);
}
