//! Keeps a readable, evenly spread number of instants of a motion of unknown length.

use linkwright::PointMotion;

/// Largest number of instants.
const MAX_ROWS: usize = 1000;

/// Quantities that are kept of an instant.
#[derive(Clone, Debug)]
pub struct Row {
    /// Index among all instants of the motion.
    pub number: usize,
    /// Time (s).
    pub t: f64,
    /// Motion of each selected point.
    pub motions: Vec<PointMotion>,
    /// Value, rate and acceleration of each selected coordinate.
    pub coordinates: Vec<[f64; 3]>,
    /// Requested forces and measures; NaN if they are undetermined.
    pub reported: Vec<f64>,
}

/// Every instant of a short motion; of a long one every tenth, every hundredth, …
#[derive(Clone, Debug, Default)]
pub struct Rows {
    rows: Vec<Row>,
    /// Exponent of ten: an instant is kept if its index is a multiple of this power.
    power: u32,
}

impl Rows {
    /// True if the instant of this index is kept.
    pub fn keeps(&self, number: usize) -> bool {
        number.is_multiple_of(10_usize.pow(self.power))
    }

    /// Adds an instant; indices ascend.
    pub fn push(&mut self, row: Row) {
        self.rows.push(row);
        if self.rows.len() > MAX_ROWS {
            self.power += 1;
            let rows = std::mem::take(&mut self.rows);
            self.rows = rows
                .into_iter()
                .filter(|row| self.keeps(row.number))
                .collect();
        }
    }

    /// Adds the last instant, which is always kept.
    pub fn end(&mut self, row: Row) {
        if self
            .rows
            .last()
            .is_none_or(|last| last.number != row.number)
        {
            self.rows.push(row);
        }
    }

    /// Returns the instants with these indices, if they are kept.
    pub fn numbered(&self, numbers: &[usize]) -> Vec<&Row> {
        let rows = self.rows.iter();
        rows.filter(|row| numbers.binary_search(&row.number).is_ok())
            .collect()
    }
}
