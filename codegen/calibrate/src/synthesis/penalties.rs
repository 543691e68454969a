//! Holds the multipliers of limits, by the method of multipliers for inequalities (Rockafellar 1973).
//!
//! A limit adds the residual √w · max(0, g + λ/w) of its relative excess g. The multiplier λ grows until no excess is left.

/// Weight of excess in the first round.
const FIRST_WEIGHT: f64 = 1.0;

/// Factor of the weight if the excess decreases too slowly.
const HEAVIER: f64 = 10.0;

/// Largest ratio of successive excesses for which the weight stays.
const DECREASE: f64 = 0.25;

/// Multipliers of all limits in all frames, at both ends.
#[derive(Clone, Debug)]
pub(super) struct Penalties {
    weight: f64,
    multipliers: Vec<f64>,
    largest: f64,
}

impl Penalties {
    pub fn new(count: usize) -> Penalties {
        Penalties {
            weight: FIRST_WEIGHT,
            multipliers: vec![0.0; count],
            largest: f64::INFINITY,
        }
    }

    /// Returns the residual of an excess, and its derivative.
    pub fn residual(&self, place: usize, excess: f64) -> [f64; 2] {
        let shifted = excess + self.multipliers[place] / self.weight;
        match shifted > 0.0 {
            true => [self.weight.sqrt() * shifted, self.weight.sqrt()],
            false => [0.0, 0.0],
        }
    }

    /// Takes the excesses at a minimum into the multipliers; returns the largest excess.
    pub fn update(&mut self, excesses: &[f64]) -> f64 {
        for (multiplier, excess) in self.multipliers.iter_mut().zip(excesses) {
            *multiplier = (*multiplier + self.weight * excess).max(0.0);
        }
        let largest = excesses
            .iter()
            .fold(0.0_f64, |largest, it| largest.max(*it));
        if largest > DECREASE * self.largest {
            self.weight *= HEAVIER;
        }
        self.largest = largest;
        largest
    }
}
