//! Collects the instants of a motion as rows of numbers.

use std::io;

use linkwright_page::motion::{Columns, Shown, Sink};

use crate::interrupt::Interrupt;

/// Rows of a motion in SI units; NaN where Φ_q is singular.
pub struct Frames {
    columns: Columns,
    /// Times of the rows (s).
    pub times: Vec<f64>,
    /// Values, row by row.
    pub values: Vec<f64>,
    interrupt: Interrupt,
}

impl Frames {
    /// Creates an empty table of these columns.
    pub fn new(columns: Columns) -> Frames {
        Frames {
            columns,
            times: Vec::new(),
            values: Vec::new(),
            interrupt: Interrupt::new(),
        }
    }

    /// Returns the rows of these times, which may repeat and be in any order; rows of NaN for times without an instant.
    pub fn at(&self, times: &[f64]) -> Vec<f64> {
        let count = self.columns.columns.len();
        let mut values = Vec::with_capacity(times.len() * count);
        for t in times {
            match self.times.binary_search_by(|it| it.total_cmp(t)) {
                Ok(row) => values.extend(&self.values[row * count..][..count]),
                Err(_) => values.resize(values.len() + count, f64::NAN),
            }
        }
        values
    }
}

impl Sink for Frames {
    fn take(&mut self, shown: &Shown<'_>) -> io::Result<()> {
        self.times.push(shown.instant.t());
        let values = self.columns.values(shown);
        self.values.extend(values.map(|it| it.unwrap_or(f64::NAN)));
        self.interrupt.take(shown)
    }
}
