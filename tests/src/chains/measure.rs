//! *A compiled chain, followed* → *how far off it is*, by way of the tears and by all equations at once.

use super::compiled::{Chain, Followed};
use super::truth::exact;
use crate::pantograph::Pantograph;
use crate::stability::precise::Precise;
use crate::stability::verdict::Scalar;

/// The instants at which a chain is solved, and at which of them it is measured.
#[derive(Clone, Copy, Debug)]
pub struct Sweep {
    /// The time between two instants (s).
    pub step: f64,
    /// How many there are.
    pub frames: u32,
    /// Which of them are measured: one in so many.
    pub stride: usize,
}

/// The whole of the drive, in steps that are short beside it.
pub const FINE: Sweep = Sweep {
    step: 0.003_141_6,
    frames: 2000,
    stride: 1,
};

/// The same in long steps.
pub const COARSE: Sweep = Sweep {
    step: 0.05,
    frames: 126,
    stride: 1,
};

/// Errors of all bars in all frames.
#[derive(Clone, Copy, Debug, Default)]
pub struct Errors {
    /// The root of the mean square.
    pub mean: f64,
    /// The largest.
    pub largest: f64,
}

/// What is measured of a pose, of its rates and of its accelerations: the angles of the bars (rad), which are what is solved for, and
/// the places of their beginnings, in the length of the chain, which follow from them.
pub const QUANTITIES: [&str; 2] = ["angle", "place"];

/// The errors of a chain by one way of solving it.
#[derive(Clone, Debug)]
pub struct Way {
    /// Of each quantity at each level.
    pub errors: [[Errors; 3]; 2],
    /// How many frames were found by way of the tears.
    pub by_tears: usize,
    /// Why frames were refused.
    pub refused: Vec<String>,
}

/// A chain solved both ways.
#[derive(Clone, Debug)]
pub struct Measured {
    /// How many cells it has.
    pub cells: usize,
    /// How many times as large as the one before it each cell is.
    pub growth: f64,
    /// The scalar.
    pub scalar: Scalar,
    /// When it was solved.
    pub sweep: Sweep,
    /// By way of the tears.
    pub torn: Way,
    /// By all equations at once.
    pub dense: Way,
}

impl Measured {
    /// How many times as large the errors by way of the tears are, of a quantity at a level: in the mean, and the largest.
    pub fn ratios(&self, quantity: usize, level: usize) -> [f64; 2] {
        let [torn, dense] = [&self.torn, &self.dense].map(|way| way.errors[quantity][level]);
        [torn.mean / dense.mean, torn.largest / dense.largest]
    }

    /// The largest of these ratios of all quantities and levels.
    pub fn largest_ratios(&self) -> [f64; 2] {
        let all = (0..QUANTITIES.len())
            .flat_map(|quantity| (0..3).map(move |level| self.ratios(quantity, level)));
        all.fold([0.0; 2], |[mean, largest], [a, b]| {
            [mean.max(a), largest.max(b)]
        })
    }
}

/// Follows a chain both ways. Frames that one of them was refused are measured of neither.
pub fn measure(chain: &Chain, scalar: Scalar, sweep: Sweep) -> Measured {
    let ways = match scalar {
        Scalar::F64 => &chain.double,
        Scalar::F32 => &chain.single,
    };
    let times = (1..=sweep.frames).map(|frame| scalar.round(sweep.step * f64::from(frame)));
    let times: Vec<f64> = times.collect();
    let found = [(ways.torn)(&times), (ways.dense)(&times)];
    let pantograph = Pantograph::new(chain.cells, chain.growth);
    let mut sums = [Sums::default(); 2];
    for (place, &t) in times.iter().enumerate().step_by(sweep.stride) {
        let [Some(torn), Some(dense)] =
            [&found[0], &found[1]].map(|way| way.frames[place].as_ref())
        else {
            continue;
        };
        let exact = exact(&pantograph, t);
        for (level, exact) in exact.iter().enumerate() {
            for (sums, frame) in sums.iter_mut().zip([torn, dense]) {
                sums.add(level, &frame[level], exact, pantograph.end);
            }
        }
    }
    let [torn, dense] = found;
    Measured {
        cells: chain.cells,
        growth: chain.growth,
        scalar,
        sweep,
        torn: sums[0].way(torn),
        dense: sums[1].way(dense),
    }
}

/// Squares of errors added up, how many they are, and the largest error, of each quantity at each level.
#[derive(Clone, Copy, Debug, Default)]
struct Sums([[(f64, u32, f64); 3]; 2]);

impl Sums {
    fn add(&mut self, level: usize, found: &[f64], exact: &[Precise], length: f64) {
        for (coordinate, (found, exact)) in found.iter().zip(exact).enumerate() {
            let error = Precise::from_f64(*found).minus(exact).to_f64().abs();
            let (quantity, error) = match coordinate % 3 {
                2 => (0, error),
                _ => (1, error / length),
            };
            let (squares, count, largest) = &mut self.0[quantity][level];
            *squares += error * error;
            *count += 1;
            // What is no number stays.
            if *largest < error || error.is_nan() {
                *largest = error;
            }
        }
    }

    fn way(self, followed: Followed) -> Way {
        let errors = self.0.map(|levels| {
            levels.map(|(squares, count, largest)| Errors {
                mean: (squares / f64::from(count)).sqrt(),
                largest,
            })
        });
        Way {
            errors,
            by_tears: followed.by_tears,
            refused: followed.refused,
        }
    }
}
