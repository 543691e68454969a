//! Finds the free coordinates that no mass resists, in the null space of a mass.

use nalgebra::{DMatrix, SymmetricEigen};

use crate::singular_participants::SHARE;

/// The square of a pivot beside its diagonal entry, or an eigenvalue beside the largest, below which a mass carries no digit.
pub(super) const SMALLEST_PIVOT: f64 = 64.0 * f64::EPSILON;

/// Returns the places of the coordinates that move where nothing with a mass does; `rates` has a row for each coordinate and a column for
/// each direction of the mass. Masses in different directions are comparable.
pub(super) fn unresisted(mass: DMatrix<f64>, rates: &DMatrix<f64>) -> Vec<usize> {
    let found = SymmetricEigen::new(mass);
    let (least, limit) = (
        found.eigenvalues.imin(),
        SMALLEST_PIVOT * found.eigenvalues.amax(),
    );
    let directions = found.eigenvalues.iter().enumerate();
    let null = directions.filter(|&(place, value)| place == least || *value <= limit);
    let null = null.map(|(place, _)| found.eigenvectors.column(place));
    let null = DMatrix::from_columns(&null.collect::<Vec<_>>());
    let moved = rates * null;
    let sizes: Vec<f64> = moved.row_iter().map(|row| row.norm()).collect();
    let largest = sizes.iter().copied().fold(0.0, f64::max);
    let places = sizes.iter().enumerate();
    let moving = places.filter(|&(_, size)| *size > 0.0 && *size >= SHARE * largest);
    moving.map(|(place, _)| place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// (1, −1, 0) is the null vector of one mass, and two coordinates of another have none.
    #[test]
    fn coordinates_of_the_null_space_are_found() {
        let identity = DMatrix::identity(3, 3);
        let mass = [2.0, 2.0, 0.0, 2.0, 2.0, 0.0, 0.0, 0.0, 1.0];
        let mass = DMatrix::from_row_slice(3, 3, &mass);
        assert_eq!(unresisted(mass, &identity), [0, 1]);
        let mass = DMatrix::from_diagonal(&nalgebra::DVector::from_vec(vec![0.0, 3.0, 0.0]));
        assert_eq!(unresisted(mass.clone(), &identity), [0, 2]);
        // Directions that are turned against the coordinates: the null vectors (1, 0, 0) and (0, 0, 1) move (0, 1, 0) and (1, 0, 0).
        let turned = [0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
        let turned = DMatrix::from_row_slice(3, 3, &turned);
        assert_eq!(unresisted(mass, &turned), [0, 1]);
    }
}
