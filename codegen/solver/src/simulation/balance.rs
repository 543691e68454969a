//! Compares changes of energy along a motion with the work that is done.
//!
//! Each step may cause an error of energy in proportion to its tolerance; the total error is compared with the sum of these. The unit is
//! the largest energy that the motion has moved so far. In addition, rates may be off by their absolute tolerance, which matters while
//! a motion creeps.

use crate::tolerances::Tolerances;

/// Permitted error of energy per step, in tolerances.
const ALLOWED: f64 = 100.0;

/// Largest permitted error as a part of the energy, however coarse tolerances are.
const MAX_ERROR: f64 = 0.01;

/// Rounding relative to the energies that are summed.
const ROUNDING: f64 = 1e3 * f64::EPSILON;

/// Energy of a motion so far.
#[derive(Clone, Debug)]
pub(super) struct Balance {
    /// Kinetic and potential energy at the start (J).
    start: [f64; 2],
    /// Largest energy that was moved, and largest that was summed (J).
    moved: f64,
    summed: f64,
    /// Sum of permitted errors, in tolerances times parts of the moved energy.
    allowed: f64,
    /// Error of energy from rates that are off by their absolute tolerance (J).
    beside: f64,
    /// Current error of energy (J).
    pub drift: f64,
}

impl Balance {
    /// Creates the balance at the start.
    pub fn new(start: [f64; 2]) -> Balance {
        Balance {
            start,
            moved: 0.0,
            summed: 0.0,
            allowed: 0.0,
            beside: 0.0,
            drift: 0.0,
        }
    }

    /// Records the energies and the work at the end of a step, and the norm of its rates; returns true if they balance.
    pub fn see(
        &mut self,
        energies: [f64; 2],
        work: f64,
        rate: f64,
        tolerances: &Tolerances,
    ) -> bool {
        let [kinetic, potential] = energies;
        let stored = potential - self.start[1];
        let parts = [kinetic, self.start[0], stored, work];
        self.moved = parts.iter().map(|it| it.abs()).fold(self.moved, f64::max);
        self.summed = self.summed.max(self.moved).max(potential.abs());
        self.allowed += ALLOWED * (tolerances.relative + tolerances.absolute);
        if rate > 0.0 {
            let mass = 2.0 * kinetic / (rate * rate);
            let off = ALLOWED * tolerances.absolute;
            self.beside = self.beside.max(mass * off * (rate + 0.5 * off));
        }
        self.drift = (kinetic - self.start[0]) + stored - work;
        let allowed =
            self.allowed.min(MAX_ERROR) * self.moved + self.beside + ROUNDING * self.summed;
        self.drift.abs() <= allowed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TOLERANCES: Tolerances = Tolerances {
        relative: 1e-10,
        absolute: 1e-12,
    };

    /// A falling body keeps its energy, and the losses of a damper are accounted for; other losses are not.
    #[test]
    fn energy_that_is_lost_is_seen() {
        let mut balance = Balance::new([1.0, 3.0]);
        assert!(balance.see([3.0, 1.0], 0.0, 2.0, &TOLERANCES));
        assert!(balance.see([2.0, 1.5], -0.5, 2.0, &TOLERANCES));
        assert!(!balance.see([2.0, 1.5 - 1e-6], -0.5, 2.0, &TOLERANCES));
        assert!((balance.drift + 1e-6).abs() < 1e-12);
        assert!(!balance.see([f64::NAN, 1.0], 0.0, 2.0, &TOLERANCES));
    }

    /// In a creeping motion, rates below their absolute tolerance carry no energy.
    #[test]
    fn rates_may_be_off_by_their_absolute_tolerance() {
        let creeping = [0.5e-18, 0.0];
        let mut balance = Balance::new([0.0, 0.0]);
        assert!(balance.see(creeping, 0.45e-18, 1e-9, &TOLERANCES));
        assert!(!balance.see(creeping, 0.2e-18, 1e-9, &TOLERANCES));
    }
}
