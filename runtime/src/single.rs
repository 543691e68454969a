//! Names the types of this package in f32.

/// Failure of a solve.
pub type Failure = crate::Failure<f32>;

/// Distance of a block from a singular pose.
pub type NormalizedDeterminant = crate::NormalizedDeterminant<f32>;

/// Position, velocity and acceleration of a point.
pub type PointMotion = crate::PointMotion<f32>;

/// Limits within which a solve must succeed.
pub type Settings = crate::Settings<f32>;

/// Quantity that is supplied with its rate and acceleration.
pub type Signal = crate::Signal<f32>;
