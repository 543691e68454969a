//! Pressure angle of a follower at its contact, from its velocity.

use crate::math::Real;

/// Returns the pressure angle in [0, π/2] rad: between the common normal at a contact and the velocity of the
/// follower's point there.
///
/// `along` and `across` are the components of that velocity along the normal and across it, in m/s; `sliding` is the
/// square of the speed with which the contact runs along the curve, in m²/s². Without friction, the cam applies its
/// force along the normal, so its share cos α does the work (Norton 2009, Cam Design and Manufacturing Handbook).
///
/// `None` while the follower rests: its speed is then less than √ε of the sliding speed. A direction computed from it,
/// if any, would be off by more than √ε rad. `None` also for arguments that are not finite.
///
/// ```
/// use linkwright::generated::pressure_angle;
/// assert_eq!(pressure_angle(1.0, -1.0, 4.0), Some(core::f64::consts::FRAC_PI_4));
/// assert_eq!(pressure_angle(1e-17, 2e-17, 4.0), None);
/// ```
#[inline]
pub fn pressure_angle<T: Real>(along: T, across: T, sliding: T) -> Option<T> {
    let speed = along * along + across * across;
    let moves = speed.is_finite() && speed > T::EPSILON * sliding && speed > T::ZERO;
    moves.then(|| across.abs().atan2(along.abs()))
}

#[cfg(test)]
mod tests {
    use super::pressure_angle;

    #[test]
    fn the_angle_has_no_sign_and_needs_a_motion() {
        for (along, across) in [(3.0, 4.0), (-3.0, 4.0), (3.0, -4.0), (-3.0, -4.0)] {
            let angle: f64 = pressure_angle(along, across, 1.0).expect("it moves");
            assert!((angle.tan() - 4.0 / 3.0).abs() < 1e-15, "{angle}");
        }
        assert_eq!(pressure_angle(0.0, 0.0, 0.0), None);
        assert_eq!(pressure_angle(0.0, 1e-9, 1.0), None);
        assert_eq!(pressure_angle(f64::NAN, 1.0, 1.0), None);
        assert_eq!(pressure_angle(1.0, 1.0, f64::NAN), None);
        assert_eq!(pressure_angle(1e-4_f32, 0.0, 1.0), None);
        assert_eq!(pressure_angle(1e-3_f32, 0.0, 1.0), Some(0.0));
    }
}
