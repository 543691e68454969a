//! *Instants of a motion of unknown length* → *a readable number of them, evenly spread*.

use linkwright::PointMotion;

/// How many instants are kept at most.
const KEPT: usize = 1000;

/// What is kept of an instant.
#[derive(Clone, Debug)]
pub struct Row {
    /// Its number among all of the motion.
    pub number: usize,
    /// The time (s).
    pub t: f64,
    /// The motion of each shown point.
    pub motions: Vec<PointMotion>,
    /// Each shown coordinate with its rate and its acceleration.
    pub coordinates: Vec<[f64; 3]>,
    /// The forces that are asked for; NaN where they are not known.
    pub forces: Vec<f64>,
}

/// Every instant of a short motion; of a long one every tenth, every hundredth, …
#[derive(Clone, Debug, Default)]
pub struct Rows {
    rows: Vec<Row>,
    /// Every instant whose number is a multiple of this power of ten is kept.
    power: u32,
}

impl Rows {
    /// Whether the instant of this number is kept.
    pub fn keeps(&self, number: usize) -> bool {
        number.is_multiple_of(10_usize.pow(self.power))
    }

    /// Takes an instant; numbers come in their order.
    pub fn push(&mut self, row: Row) {
        self.rows.push(row);
        if self.rows.len() > KEPT {
            self.power += 1;
            let rows = std::mem::take(&mut self.rows);
            self.rows = rows
                .into_iter()
                .filter(|row| self.keeps(row.number))
                .collect();
        }
    }

    /// Takes the last instant, which is kept whatever its number is.
    pub fn end(&mut self, row: Row) {
        if self
            .rows
            .last()
            .is_none_or(|last| last.number != row.number)
        {
            self.rows.push(row);
        }
    }

    /// The instants with these numbers, as far as they are kept.
    pub fn numbered(&self, numbers: &[usize]) -> Vec<&Row> {
        let rows = self.rows.iter();
        rows.filter(|row| numbers.binary_search(&row.number).is_ok())
            .collect()
    }
}
