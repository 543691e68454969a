//! Inverts matrices of numbers, and bounds determinants of matrices of intervals.

use linkwright_codegen::stages::assemblies::Interval;
use nalgebra::DMatrix;

use super::functions::{is_bounded, magnitude};

/// Returns an approximate inverse of the midpoints of a matrix; `None` if there is none.
pub(super) fn inverse(matrix: &[Vec<Interval>]) -> Option<DMatrix<f64>> {
    let order = matrix.len();
    if !matrix.iter().flatten().all(|&it| is_bounded(it)) {
        return None;
    }
    let middle = DMatrix::from_fn(order, order, |row, column| matrix[row][column].middle());
    let approximate = middle.try_inverse()?;
    approximate
        .iter()
        .all(|it| it.is_finite())
        .then_some(approximate)
}

/// Returns C · A of a matrix in numbers.
pub(super) fn product(inverse: &DMatrix<f64>, matrix: &[Vec<Interval>]) -> Vec<Vec<Interval>> {
    let order = matrix.len();
    let entry = |row: usize, column: usize| {
        (0..order).fold(Interval::point(0.0), |sum, k| match inverse[(row, k)] {
            0.0 => sum,
            factor => sum.plus(Interval::point(factor).times(matrix[k][column])),
        })
    };
    let row = |row: usize| (0..order).map(|column| entry(row, column)).collect();
    (0..order).map(row).collect()
}

/// Returns a lower bound of the normalized determinant's magnitude of each matrix of these entries; 0 if nothing is known.
///
/// The determinant is divided by the lengths of its columns. With an inverse C, det A = det (C A) / det C, and |det (C A)| is at least
/// the product over all rows of the diagonal entry minus the sum of the others (Ostrowski 1937).
pub(super) fn normalized_determinant(matrix: &[Vec<Interval>]) -> f64 {
    let order = matrix.len();
    let Some(inverse) = inverse(matrix) else {
        return 0.0;
    };
    let one = Interval::point(1.0);
    let mut least = one;
    for (place, row) in product(&inverse, matrix).iter().enumerate() {
        let others = row
            .iter()
            .enumerate()
            .filter(|(column, _)| *column != place);
        let others = others.fold(Interval::point(0.0), |sum, (_, &entry)| {
            sum.plus(Interval::point(magnitude(entry)))
        });
        let left = Interval::point(row[place].low).minus(others);
        // Negated comparisons would accept NaN.
        let is_dominant = left.low > 0.0;
        if !is_dominant {
            return 0.0;
        }
        least = least.times(Interval::point(left.low));
    }
    let Some(of_inverse) = determinant(&inverse) else {
        return 0.0;
    };
    let mut divisor = of_inverse;
    for column in 0..order {
        let squares = matrix.iter().map(|row| row[column].power(2));
        let square = squares.fold(Interval::point(0.0), Interval::plus);
        divisor = divisor.times(Interval::point(square.root().high));
    }
    let ratio = least.times(divisor.reciprocal());
    match is_bounded(ratio) {
        true => ratio.low.max(0.0),
        false => 0.0,
    }
}

/// Returns the magnitude of the determinant of a matrix of numbers; `None` if it cannot be bounded.
fn determinant(matrix: &DMatrix<f64>) -> Option<Interval> {
    let order = matrix.nrows();
    let row = |row: usize| (0..order).map(move |column| Interval::point(matrix[(row, column)]));
    let mut rows: Vec<Vec<Interval>> = (0..order).map(|it| row(it).collect()).collect();
    let mut product = Interval::point(1.0);
    for k in 0..order {
        let size = |row: &usize| rows[*row][k].middle().abs();
        let pivot = (k..order).max_by(|a, b| size(a).total_cmp(&size(b)))?;
        rows.swap(k, pivot);
        let (above, below) = rows.split_at_mut(k + 1);
        let pivot_row = &above[k];
        let reciprocal = pivot_row[k].reciprocal();
        if !is_bounded(reciprocal) {
            return None;
        }
        product = product.times(pivot_row[k]);
        for row in below {
            let factor = row[k].times(reciprocal);
            for column in k + 1..order {
                row[column] = row[column].minus(factor.times(pivot_row[column]));
            }
        }
    }
    let size = match product.low > 0.0 {
        true => product,
        false => product.negated(),
    };
    (is_bounded(size) && size.low > 0.0).then_some(size)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn about(rows: [[f64; 2]; 2], off: f64) -> Vec<Vec<Interval>> {
        let entry = |value: f64| Interval::new(value - off, value + off);
        rows.map(|row| row.map(entry).to_vec()).to_vec()
    }

    /// Two unit vectors at an angle of 30° have the ratio ½.
    #[test]
    fn a_determinant_is_bounded_from_below() {
        let sine = 0.75_f64.sqrt();
        let exact = normalized_determinant(&about([[3.0, 2.0 * sine], [0.0, 2.0 * 0.5]], 0.0));
        assert!(exact <= 0.5 && exact > 0.499_999_999, "{exact}");
        let wide = normalized_determinant(&about([[3.0, 2.0 * sine], [0.0, 1.0]], 0.01));
        assert!(wide < 0.5 && wide > 0.45, "{wide}");
        let singular = normalized_determinant(&about([[1.0, 2.0], [2.0, 4.0]], 0.0));
        assert_eq!(singular, 0.0);
        let unknown = normalized_determinant(&about([[1.0, 0.0], [0.0, 1.0]], f64::NAN));
        assert_eq!(unknown, 0.0);
    }
}
