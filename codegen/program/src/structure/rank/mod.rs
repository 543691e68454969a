//! A system → how many of its equations say something, by numbers.
//!
//! The structure says which equation mentions which unknown; that equations repeat one another only shows in their values. The
//! rank of Φ_q is determined at poses in which the equations hold, near the drawing and off it along whatever can move, and what
//! is found in all of them is taken for a property of the mechanism. One pose of full rank settles that there is none.
//! Deliberately unknown here: messages, and how equations are solved.

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

/// Above this many coordinates equations are only looked at block by block.
pub const LARGEST_SURVEY: usize = 150;

/// A matrix with rows and columns of comparable size, by which neither rank nor dependence changes; and the factor of each
/// column.
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
