//! Compares a solver with a reference table of q, q̇, q̈, column by column.

use crate::solver::Solver;
use crate::table::Table;

/// Magnitude for a column of zeros. A coordinate at rest in the reference may carry the rounding of its equations:
/// 1e-15, if others may be wrong by 1e-12 of their magnitude.
pub const REST_MAGNITUDE: f64 = 1e-3;

/// Largest difference in a column.
#[derive(Clone, Debug)]
pub struct Deviation {
    /// Name of the column.
    pub column: String,
    /// Time of the largest difference (s).
    pub t: f64,
    /// Largest difference.
    pub error: f64,
    /// Largest absolute value in the column.
    pub magnitude: f64,
}

impl Deviation {
    /// Difference in magnitudes of the column, but at least [`REST_MAGNITUDE`].
    pub fn relative(&self) -> f64 {
        self.error / self.magnitude.max(REST_MAGNITUDE)
    }
}

/// Deviations of a solver that sweeps through the times of the table by steps of 0.01 s. Columns: t, then q, q̇, q̈.
///
/// # Panics
/// If the table has another number of columns, or the mechanism cannot be solved.
pub fn deviations(solver: &mut dyn Solver, table: &Table) -> Vec<Deviation> {
    solver.assemble(table.rows[0][0]);
    let mut deviations: Vec<Deviation> = table.names[1..]
        .iter()
        .enumerate()
        .map(|(index, name)| Deviation {
            column: name.clone(),
            t: f64::NAN,
            error: 0.0,
            magnitude: table.magnitude(index + 1),
        })
        .collect();
    for row in &table.rows {
        solver.sweep_to(row[0]);
        let frame = solver.frame();
        let levels: Vec<f64> = [&frame.q, &frame.qd, &frame.qdd]
            .into_iter()
            .flatten()
            .copied()
            .collect();
        assert_eq!(
            levels.len(),
            deviations.len(),
            "a column for each coordinate, rate and acceleration"
        );
        for ((deviation, levels), wanted) in deviations.iter_mut().zip(levels).zip(&row[1..]) {
            let error = (levels - wanted).abs();
            if error > deviation.error || error.is_nan() {
                (deviation.error, deviation.t) = (error, row[0]);
            }
        }
    }
    deviations
}

/// Largest relative deviation.
///
/// # Panics
/// If the list is empty.
pub fn worst(deviations: &[Deviation]) -> &Deviation {
    let by_size = |a: &&Deviation, b: &&Deviation| a.relative().total_cmp(&b.relative());
    deviations.iter().max_by(by_size).expect("a column")
}
