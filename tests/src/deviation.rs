//! *A solver and a reference table of q, q̇, q̈* → *how far apart they are*, column by column.

use crate::solver::Solver;
use crate::table::Table;

/// The magnitude against which a column of zeros is judged: what does not move in the reference may carry the rounding of
/// its equations, 1e-15 where others may be wrong by 1e-12 of their magnitude.
pub const STILL: f64 = 1e-3;

/// The largest difference in a column.
#[derive(Clone, Debug)]
pub struct Deviation {
    /// The name of the column.
    pub column: String,
    /// The time of the largest difference (s).
    pub t: f64,
    /// The largest difference.
    pub error: f64,
    /// The largest absolute value in the column.
    pub magnitude: f64,
}

impl Deviation {
    /// The difference in magnitudes of the column, but at least [`STILL`].
    pub fn relative(&self) -> f64 {
        self.error / self.magnitude.max(STILL)
    }
}

/// The deviations of a solver that sweeps through the times of the table by steps of 0.01 s. Columns: t, then q, q̇, q̈.
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
        let found: Vec<f64> = [&frame.q, &frame.qd, &frame.qdd]
            .into_iter()
            .flatten()
            .copied()
            .collect();
        assert_eq!(
            found.len(),
            deviations.len(),
            "a column for each coordinate, rate and acceleration"
        );
        for ((deviation, found), wanted) in deviations.iter_mut().zip(found).zip(&row[1..]) {
            let error = (found - wanted).abs();
            if error > deviation.error || error.is_nan() {
                (deviation.error, deviation.t) = (error, row[0]);
            }
        }
    }
    deviations
}

/// The one with the largest relative deviation.
///
/// # Panics
/// If there is none.
pub fn worst(deviations: &[Deviation]) -> &Deviation {
    let by_size = |a: &&Deviation, b: &&Deviation| a.relative().total_cmp(&b.relative());
    deviations.iter().max_by(by_size).expect("a column")
}
