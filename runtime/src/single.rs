//! Names the types of this package in f32.
//!
//! ```
//! use linkwright::single::{Settings, Signal};
//!
//! let settings = Settings::default();
//! // Position, rate and acceleration of an actuator that does not move.
//! let input = Signal::constant(0.25);
//! assert_eq!(settings.tolerance, linkwright::Settings::<f32>::default().tolerance);
//! assert_eq!(input, linkwright::Signal::constant(0.25_f32));
//! ```

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
