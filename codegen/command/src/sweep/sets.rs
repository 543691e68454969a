//! Makes sets of values by their index: of a grid, of the rows of a file, or of a sequence of samples.

use linkwright_solver::sets::{Axis, BITS, MAX_DIMENSIONS, Sobol};

use super::varied::{Range, Varied};

/// Sets of values of what is varied.
#[derive(Clone, Debug)]
pub enum Sets {
    /// All combinations of values.
    Grid(Grid),
    /// Rows of a file.
    Rows {
        /// Parameter or input of each column.
        varied: Vec<Varied>,
        /// Given values, row by row.
        values: Vec<f64>,
    },
    /// Samples within ranges.
    Samples(Samples),
}

/// All combinations of the values of some axes, of which the last one varies fastest.
#[derive(Clone, Debug)]
pub struct Grid {
    varied: Vec<Varied>,
    /// Ends and number of values of each axis.
    pub axes: Vec<Axis>,
    count: u64,
}

/// Samples of a sequence that fills ranges evenly.
#[derive(Clone, Debug)]
pub struct Samples {
    varied: Vec<Varied>,
    ends: Vec<[f64; 2]>,
    sobol: Sobol,
    count: u64,
}

impl Grid {
    /// Creates the grid of some ranges.
    ///
    /// # Errors
    /// The printed message: a range has no number of values, or there are too many sets.
    pub fn new(ranges: Vec<Range>) -> Result<Grid, String> {
        let (mut varied, mut axes) = (Vec::new(), Vec::new());
        let mut count: u64 = 1;
        for range in ranges {
            let Some(own) = range.count else {
                return Err(format!(
                    "error: `--vary {}` has no number of values\n  = help: write it behind the range, as in `0..1:101`, or pass `--samples`",
                    range.varied.name
                ));
            };
            count = count
                .checked_mul(own)
                .filter(|it| usize::try_from(*it).is_ok())
                .ok_or("error: there are more sets than can be counted\n  = help: write fewer values behind `:`")?;
            axes.push(Axis {
                ends: range.ends,
                count: own,
            });
            varied.push(range.varied);
        }
        Ok(Grid {
            varied,
            axes,
            count,
        })
    }

    /// Returns the index of a set on each axis.
    pub fn places(&self, set: u64) -> Vec<u64> {
        let mut rest = set;
        let mut places: Vec<u64> = self
            .axes
            .iter()
            .rev()
            .map(|axis| {
                let place = rest % axis.count;
                rest /= axis.count;
                place
            })
            .collect();
        places.reverse();
        places
    }
}

impl Samples {
    /// Creates samples within some ranges.
    ///
    /// # Errors
    /// The printed message: a range has a number of values, or there are too many samples or ranges.
    pub fn new(ranges: Vec<Range>, count: u64, seed: Option<u64>) -> Result<Samples, String> {
        if let Some(range) = ranges.iter().find(|it| it.count.is_some()) {
            return Err(format!(
                "error: `--vary {}` has a number of values, but `--samples` chooses the values\n  = help: leave out `:` and the number",
                range.varied.name
            ));
        }
        let most = 1_u64 << BITS;
        if count == 0 || count > most {
            return Err(format!(
                "error: `--samples {count}` is not a number of samples from 1 to {most}"
            ));
        }
        let sobol = Sobol::new(ranges.len(), seed).ok_or_else(|| {
            format!("error: `--samples` varies at most {MAX_DIMENSIONS} parameters and inputs")
        })?;
        let (varied, ends) = ranges.into_iter().map(|it| (it.varied, it.ends)).unzip();
        Ok(Samples {
            varied,
            ends,
            sobol,
            count,
        })
    }
}

impl Sets {
    /// Varied parameters and inputs, in the order of values.
    pub fn varied(&self) -> &[Varied] {
        match self {
            Sets::Grid(grid) => &grid.varied,
            Sets::Rows { varied, .. } => varied,
            Sets::Samples(samples) => &samples.varied,
        }
    }

    /// Number of sets.
    pub fn count(&self) -> u64 {
        match self {
            Sets::Grid(grid) => grid.count,
            Sets::Rows { varied, values } => (values.len() / varied.len().max(1)) as u64,
            Sets::Samples(samples) => samples.count,
        }
    }

    /// Returns the ranges in words, exactly; empty for rows of a file.
    pub fn ranges(&self) -> String {
        match self {
            Sets::Grid(grid) => format!("{:?}", grid.axes),
            Sets::Rows { .. } => String::new(),
            Sets::Samples(samples) => format!("{:?} {:?}", samples.ends, samples.sobol.seed()),
        }
    }

    /// Appends the values of a set, in the units in which they are given.
    pub fn extend(&self, set: u64, given: &mut Vec<f64>) {
        match self {
            Sets::Grid(grid) => {
                let places = grid.places(set);
                given.extend(
                    grid.axes
                        .iter()
                        .zip(places)
                        .map(|(axis, it)| axis.value(it)),
                );
            }
            Sets::Rows { varied, values } => {
                let first = set as usize * varied.len();
                given.extend_from_slice(&values[first..first + varied.len()]);
            }
            Sets::Samples(samples) => {
                let ends = samples.ends.iter().enumerate();
                given.extend(
                    ends.map(|(dimension, ends)| {
                        samples.sobol.within(set as u32, dimension, *ends)
                    }),
                );
            }
        }
    }
}
