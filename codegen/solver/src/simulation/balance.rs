//! *Energies and work along a motion* → *what of a change of the energy the work does not account for, and how much of that is an error*.
//!
//! Each step may miss by what its tolerance allows; what is missed altogether is held against the sum of that. The unit is the largest
//! energy that the motion has moved so far.

use crate::dormand_prince::Tolerances;

/// How many tolerances a step may miss the energy by.
const ALLOWED: f64 = 100.0;

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
            drift: 0.0,
        }
    }

    /// Sees the energies and the work at the end of a step whose coordinates have this size; whether they are in balance.
    pub fn see(
        &mut self,
        energies: [f64; 2],
        work: f64,
        size: f64,
        tolerances: &Tolerances,
    ) -> bool {
        let [kinetic, potential] = energies;
        let stored = potential - self.start[1];
        let parts = [kinetic, self.start[0], stored, work];
        self.moved = parts.iter().map(|it| it.abs()).fold(self.moved, f64::max);
        self.summed = self.summed.max(self.moved).max(potential.abs());
        self.allowed += ALLOWED * (tolerances.relative * size.max(1.0) + tolerances.absolute);
        self.drift = (kinetic - self.start[0]) + stored - work;
        let allowed = self.allowed * self.moved + ROUNDING * self.summed;
        self.drift.abs() <= allowed
    }
}
