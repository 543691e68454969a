//! Position, velocity and acceleration of one point → one value that carries the three together.
//!
//! The module does not know which point or which mechanism it describes.

/// The motion of a point of a body, in the ground's frame.
///
/// Units are those of the description it came from: SI (m, m/s, m/s²) for generated mechanisms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointMotion<T = f64> {
    /// The position (x, y).
    pub position: [T; 2],
    /// The first time derivative of the position.
    pub velocity: [T; 2],
    /// The second time derivative of the position.
    pub acceleration: [T; 2],
}
