//! Bounds what rounding adds to a motion beside poses in which the constraints lose rank.
//!
//! At a distance m from losing rank a pose is known to ε/m along what the constraints lose, its tangent to ε/m², and what γ leaves of the
//! accelerations to ε/m³, in squares of the speed. The sum of that over the steps beside one pose is held against the tolerances.

use crate::tolerances::Tolerances;

/// Number of tolerances by which rounding may change the rates beside one pose.
const ALLOWED: f64 = 1e3;

/// Multiple of the least distance from losing rank beyond which the next pose begins.
const BEYOND: f64 = 10.0;

/// Sum of the rounding of the steps beside one pose so far, in parts of the speed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rounding {
    missed: f64,
    /// Least distance from losing rank beside that pose.
    least: f64,
}

impl Rounding {
    /// At the start.
    pub fn new() -> Rounding {
        Rounding {
            missed: 0.0,
            least: f64::INFINITY,
        }
    }

    /// Adds a step: its length (s), the largest rate (rad/s) and the distances from losing rank at its ends. True if the sum is allowed.
    pub fn see(&mut self, length: f64, rate: f64, ends: [f64; 2], tolerances: &Tolerances) -> bool {
        let [first, last] = ends;
        // The integral of ε m⁻³ where m changes evenly.
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
