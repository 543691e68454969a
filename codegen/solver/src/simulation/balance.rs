//! *Energies and work along a motion* → *what of a change of the energy the work does not account for, and how much of that is an error*.
//!
//! Each step may miss by what its tolerance allows; what is missed altogether is held against the sum of that. The unit is the largest
//! energy that the motion has moved so far. Beside that, rates may be off by their absolute tolerance, which is much where a motion creeps.

use crate::tolerances::Tolerances;

/// How many tolerances a step may miss the energy by.
const ALLOWED: f64 = 100.0;

/// Which part of the energy may be missed at most, however coarse tolerances are.
const MOST: f64 = 0.01;

/// What rounding may miss beside the energies that are summed.
const ROUNDING: f64 = 1e3 * f64::EPSILON;

/// The energy of a motion so far.
#[derive(Clone, Debug)]
pub(super) struct Balance {
    /// Kinetic and potential energy at the start (J).
    start: [f64; 2],
    /// The largest energy that was moved, and the largest that was summed (J).
    moved: f64,
    summed: f64,
    /// How many tolerances were allowed, in parts of what was moved.
    allowed: f64,
    /// Energy that rates off by their absolute tolerance may miss (J).
    beside: f64,
    /// What is missed (J).
    pub drift: f64,
}

impl Balance {
    /// At the start.
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

    /// Sees the energies and the work at the end of a step, and the norm of its rates; true if they are in balance.
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
        let allowed = self.allowed.min(MOST) * self.moved + self.beside + ROUNDING * self.summed;
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

    /// What falls keeps its energy, and what a damper takes is accounted for; what is lost is not.
    #[test]
    fn energy_that_is_lost_is_seen() {
        let mut balance = Balance::new([1.0, 3.0]);
        assert!(balance.see([3.0, 1.0], 0.0, 2.0, &TOLERANCES));
        assert!(balance.see([2.0, 1.5], -0.5, 2.0, &TOLERANCES));
        assert!(!balance.see([2.0, 1.5 - 1e-6], -0.5, 2.0, &TOLERANCES));
        assert!((balance.drift + 1e-6).abs() < 1e-12);
        assert!(!balance.see([f64::NAN, 1.0], 0.0, 2.0, &TOLERANCES));
    }

    /// Of what creeps, rates below their absolute tolerance show no energy.
    #[test]
    fn rates_may_be_off_by_their_absolute_tolerance() {
        let creeping = [0.5e-18, 0.0];
        let mut balance = Balance::new([0.0, 0.0]);
        assert!(balance.see(creeping, 0.45e-18, 1e-9, &TOLERANCES));
        assert!(!balance.see(creeping, 0.2e-18, 1e-9, &TOLERANCES));
    }
}
