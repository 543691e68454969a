//! Bounds the effect of rounding on a motion beside poses in which the constraints lose rank.
//!
//! At a distance m from the loss of rank, a pose is known to ε/m along the lost directions, and its tangent to ε/m². Accelerations from γ
//! are known to ε/m³, in squares of the speed. The sum of that over the steps beside one pose is compared with the tolerances.

use crate::tolerances::Tolerances;

/// Permitted change of the rates by rounding beside one pose, in tolerances.
const ALLOWED: f64 = 1e3;

/// Multiple of the least distance from the loss of rank beyond which the next pose begins.
const BEYOND: f64 = 10.0;

/// Sum of the rounding of the steps beside one pose so far, in parts of the speed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rounding {
    missed: f64,
    /// Least distance from the loss of rank beside that pose.
    least: f64,
}

impl Rounding {
    /// Creates the sum at the start.
    pub fn new() -> Rounding {
        Rounding {
            missed: 0.0,
            least: f64::INFINITY,
        }
    }

    /// Adds a step: its length (s), the largest rate (rad/s) and the distances from the loss of rank at its ends.
    ///
    /// Returns true if the sum is permitted.
    pub fn see(&mut self, length: f64, rate: f64, ends: [f64; 2], tolerances: &Tolerances) -> bool {
        let [first, last] = ends;
        // Integral of ε m⁻³ if m changes linearly.
        let cubes = 0.5 * (first + last) / (first * last).powi(2);
        self.missed += f64::EPSILON * rate * length * cubes;
        self.least = self.least.min(first).min(last);
        let allowed = tolerances.relative + tolerances.absolute / rate.max(f64::MIN_POSITIVE);
        let is_allowed = self.missed <= ALLOWED * allowed;
        if last > BEYOND * self.least {
            *self = Rounding::new();
        }
        is_allowed
    }
}
