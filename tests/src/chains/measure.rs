//! Measures the error of a compiled chain, solved by tearing and by all equations at once.

use super::compiled::{Chain, Followed};
use super::truth::exact;
use crate::pantograph::Pantograph;
use crate::stability::precise::Precise;
use crate::stability::verdict::Scalar;

/// Instants at which a chain is solved, and those at which it is measured.
#[derive(Clone, Copy, Debug)]
pub struct Sweep {
    /// Time between two instants (s).
    pub step: f64,
    /// Number of instants.
    pub frames: u32,
    /// Number of instants per measured one.
    pub stride: usize,
}

/// The whole range of the drive, in relatively short steps.
pub const FINE: Sweep = Sweep {
    step: 0.003_141_6,
    frames: 2000,
    stride: 1,
};

/// The whole range of the drive, in long steps.
pub const COARSE: Sweep = Sweep {
    step: 0.05,
    frames: 126,
    stride: 1,
};

/// Errors of all bars in all frames.
#[derive(Clone, Copy, Debug, Default)]
pub struct Errors {
    /// Root of the mean square.
    pub mean: f64,
    /// Largest error.
    pub largest: f64,
}

/// Measured quantities of a pose, its rates and its accelerations: the angles of the bars (rad), which are the
/// unknowns, and the positions of their first ends, in lengths of the chain, which follow from the angles.
pub const QUANTITIES: [&str; 2] = ["angle", "place"];

/// Errors of a chain by one solution method.
#[derive(Clone, Debug)]
pub struct Way {
    /// Of each quantity at each level.
    pub errors: [[Errors; 3]; 2],
    /// Number of frames solved by tearing.
    pub by_tears: usize,
    /// Reasons of refused frames.
    pub refused: Vec<String>,
}

/// Chain solved by both methods.
#[derive(Clone, Debug)]
pub struct Measured {
    /// Number of cells.
    pub cells: usize,
    /// Ratio of the size of each cell to that of the one before.
    pub growth: f64,
    /// The scalar.
    pub scalar: Scalar,
    /// Instants.
    pub sweep: Sweep,
    /// Errors by tearing.
    pub torn: Way,
    /// Errors by all equations at once.
    pub dense: Way,
}

impl Measured {
    /// Ratios of the errors by tearing to those by all equations, for a quantity at a level: mean and largest.
    pub fn ratios(&self, quantity: usize, level: usize) -> [f64; 2] {
        let [torn, dense] = [&self.torn, &self.dense].map(|way| way.errors[quantity][level]);
        [torn.mean / dense.mean, torn.largest / dense.largest]
    }

    /// Largest of these ratios over all quantities and levels.
    pub fn largest_ratios(&self) -> [f64; 2] {
        let all = (0..QUANTITIES.len())
            .flat_map(|quantity| (0..3).map(move |level| self.ratios(quantity, level)));
        all.fold([0.0; 2], |[mean, largest], [a, b]| {
            [mean.max(a), largest.max(b)]
        })
    }
}

/// Follows a chain by both methods. A frame that one of them refuses is not measured.
pub fn measure(chain: &Chain, scalar: Scalar, sweep: Sweep) -> Measured {
    let ways = match scalar {
        Scalar::F64 => &chain.double,
        Scalar::F32 => &chain.single,
    };
    let times = (1..=sweep.frames).map(|frame| scalar.round(sweep.step * f64::from(frame)));
    let times: Vec<f64> = times.collect();
    let solutions = [(ways.torn)(&times), (ways.dense)(&times)];
    let pantograph = Pantograph::new(chain.cells, chain.growth);
    let mut sums = [Sums::default(); 2];
    for (place, &t) in times.iter().enumerate().step_by(sweep.stride) {
        let [Some(torn), Some(dense)] =
            [&solutions[0], &solutions[1]].map(|way| way.frames[place].as_ref())
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
    let [torn, dense] = solutions;
    Measured {
        cells: chain.cells,
        growth: chain.growth,
        scalar,
        sweep,
        torn: sums[0].way(torn),
        dense: sums[1].way(dense),
    }
}

/// Sum of squared errors, their number and the largest error, for each quantity at each level.
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
            // NaN stays.
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
