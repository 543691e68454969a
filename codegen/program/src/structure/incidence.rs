//! Records the unknowns that each equation mentions.

use crate::system::System;

/// Sparsity pattern of a matrix: the columns of every row, ascending.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Incidence {
    /// Columns of each row.
    pub rows: Vec<Vec<usize>>,
    /// Number of columns.
    pub columns: usize,
}

impl Incidence {
    /// Returns the pattern of Φ_q.
    pub fn of(system: &System) -> Incidence {
        let pattern =
            |row: &crate::system::Row| row.jacobian.iter().map(|entry| entry.coordinate).collect();
        Incidence {
            rows: system.rows.iter().map(pattern).collect(),
            columns: system.coordinates.len(),
        }
    }

    /// Returns the rows of each column, ascending.
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
