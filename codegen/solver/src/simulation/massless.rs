//! Finds the free coordinates that no mass resists, in the null space of a mass.

use nalgebra::{DMatrix, SymmetricEigen};

use crate::singular_participants::SHARE;

/// Limits below which a mass carries no digit: of a squared pivot relative to its diagonal entry, of an eigenvalue to the largest.
pub(super) const SMALLEST_PIVOT: f64 = 64.0 * f64::EPSILON;

/// Returns the indices of the coordinates that move without moving a mass.
///
/// `rates` has a row for each coordinate and a column for each direction of the mass. Masses in different directions are comparable.
pub(super) fn unresisted(mass: DMatrix<f64>, rates: &DMatrix<f64>) -> Vec<usize> {
    let eigen = SymmetricEigen::new(mass);
    let (least, limit) = (
        eigen.eigenvalues.imin(),
        SMALLEST_PIVOT * eigen.eigenvalues.amax(),
    );
    let directions = eigen.eigenvalues.iter().enumerate();
    let null = directions.filter(|&(place, value)| place == least || *value <= limit);
    let null = null.map(|(place, _)| eigen.eigenvectors.column(place));
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

    /// One mass has the null vector (1, −1, 0), and two coordinates of another mass have none.
    #[test]
    fn coordinates_of_the_null_space_are_found() {
        let identity = DMatrix::identity(3, 3);
        let mass = [2.0, 2.0, 0.0, 2.0, 2.0, 0.0, 0.0, 0.0, 1.0];
        let mass = DMatrix::from_row_slice(3, 3, &mass);
        assert_eq!(unresisted(mass, &identity), [0, 1]);
        let mass = DMatrix::from_diagonal(&nalgebra::DVector::from_vec(vec![0.0, 3.0, 0.0]));
        assert_eq!(unresisted(mass.clone(), &identity), [0, 2]);
        // Directions are turned against the coordinates: the null vectors (1, 0, 0) and (0, 0, 1) move (0, 1, 0) and (1, 0, 0).
        let turned = [0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
        let turned = DMatrix::from_row_slice(3, 3, &turned);
        assert_eq!(unresisted(mass, &turned), [0, 1]);
    }
}
