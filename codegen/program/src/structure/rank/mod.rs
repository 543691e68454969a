//! Determines the numerical rank of a system's equations.
//!
//! The structure gives the unknowns of each equation; only values show that equations repeat one another. The rank of Φ_q is
//! determined at poses in which the equations hold, near the design configuration and off it along free motions. Properties that
//! all these poses share count as properties of the mechanism. One pose of full rank excludes repetition.

mod arms;
mod blocks;
mod functions;
mod independence;
mod least_squares;
mod marks;
mod motion;
mod pose;
mod survey;

pub(super) use blocks::{Singular, singular};
pub use marks::released;
pub(super) use marks::{misfit, shared_line};
pub use motion::{FreeMotion, Moves};
pub use survey::{Dependence, Survey};

/// Largest number of coordinates with a rank of all equations; larger systems are judged block by block.
pub const LARGEST_SURVEY: usize = 150;

/// Balances rows and columns of a matrix, which preserves rank and dependence. Returns the factor of each column too.
fn balanced(mut rows: Vec<Vec<f64>>) -> (Vec<Vec<f64>>, Vec<f64>) {
    let columns = rows.first().map_or(0, Vec::len);
    let mut factors = vec![1.0; columns];
    for _ in 0..2 {
        for row in &mut rows {
            let size = independence::norm(row);
            if size > 0.0 {
                row.iter_mut().for_each(|entry| *entry /= size);
            }
        }
        for (column, factor) in factors.iter_mut().enumerate() {
            let size = rows
                .iter()
                .fold(0.0_f64, |most, row| most.max(row[column].abs()));
            if size > 0.0 {
                rows.iter_mut().for_each(|row| row[column] /= size);
                *factor /= size;
            }
        }
    }
    (rows, factors)
}

#[cfg(test)]
mod tests;
