//! Bounds what rounding adds to a motion beside poses in which the constraints lose rank.
//!
//! At a distance m from losing rank a pose is known to ε/m along what the constraints lose, its tangent to ε/m², and what γ leaves of the
//! accelerations to ε/m³, in squares of the speed. The sum of that over the steps is held against the tolerances.

use crate::tolerances::Tolerances;

/// Number of tolerances by which rounding may change the rates altogether.
const ALLOWED: f64 = 100.0;

/// Sum of the rounding of all steps so far, in parts of the speed.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Rounding {
    missed: f64,
}

impl Rounding {
    /// Adds a step: its length (s), the largest rate (rad/s) and the distances from losing rank at its ends. True if the sum is allowed.
    pub fn see(&mut self, length: f64, rate: f64, ends: [f64; 2], tolerances: &Tolerances) -> bool {
        let [first, last] = ends;
        // The integral of ε m⁻³ where m changes evenly.
        let cubes = 0.5 * (first + last) / (first * last).powi(2);
        self.missed += f64::EPSILON * rate * length * cubes;
        let allowed = tolerances.relative + tolerances.absolute / rate.max(f64::MIN_POSITIVE);
        self.missed <= ALLOWED * allowed
    }
}
