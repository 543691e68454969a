//! Which equation mentions which unknown.

use crate::system::System;

/// The pattern of a matrix: for every row its columns, ascending.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Incidence {
    /// The columns of each row.
    pub rows: Vec<Vec<usize>>,
    /// How many columns there are.
    pub columns: usize,
}

impl Incidence {
    /// The pattern of Φ_q.
    pub fn of(system: &System) -> Incidence {
        let pattern =
            |row: &crate::system::Row| row.jacobian.iter().map(|entry| entry.coordinate).collect();
        Incidence {
            rows: system.rows.iter().map(pattern).collect(),
            columns: system.coordinates.len(),
        }
    }

    /// The rows of each column, ascending.
    pub fn transposed(&self) -> Vec<Vec<usize>> {
        let mut columns = vec![Vec::new(); self.columns];
        for (row, pattern) in self.rows.iter().enumerate() {
            for &column in pattern {
                columns[column].push(row);
            }
        }
        columns
    }
}
