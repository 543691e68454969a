//! Position, velocity and acceleration of a point, as one value.

/// Motion of a point of a body, in the global frame.
///
/// Units are those of the description: SI (m, m/s, m/s²) for generated mechanisms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointMotion<T = f64> {
    /// Position (x, y).
    pub position: [T; 2],
    /// First time derivative of the position.
    pub velocity: [T; 2],
    /// Second time derivative of the position.
    pub acceleration: [T; 2],
}
