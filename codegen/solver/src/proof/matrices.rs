//! Inverses of matrices in numbers, and determinants of matrices of intervals.

use linkwright_codegen::stages::assemblies::Interval;
use nalgebra::DMatrix;

use super::functions::{is_bounded, magnitude};

/// An approximate inverse of what lies in the middle of a matrix; `None` where there is none.
pub(super) fn inverse(matrix: &[Vec<Interval>]) -> Option<DMatrix<f64>> {
    let order = matrix.len();
    if !matrix.iter().flatten().all(|&it| is_bounded(it)) {
        return None;
    }
    let middle = DMatrix::from_fn(order, order, |row, column| matrix[row][column].middle());
    let found = middle.try_inverse()?;
    found.iter().all(|it| it.is_finite()).then_some(found)
}

/// C · A of a matrix in numbers.
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

/// What the determinant of each matrix of these entries is at least in size, divided by the lengths of its columns; 0 where nothing is
/// known.
///
/// With an inverse C, det A = det (C A) / det C, and |det (C A)| is at least the product of what the diagonal has more than the rest of its
/// row (Ostrowski 1937).
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
        // Written so that NaN is refused.
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

/// The size of the determinant of a matrix of numbers.
fn determinant(matrix: &DMatrix<f64>) -> Option<Interval> {
    let order = matrix.nrows();
    let row = |row: usize| (0..order).map(move |column| Interval::point(matrix[(row, column)]));
    let mut rows: Vec<Vec<Interval>> = (0..order).map(|it| row(it).collect()).collect();
    let mut found = Interval::point(1.0);
    for k in 0..order {
        let size = |row: &usize| rows[*row][k].middle().abs();
        let pivot = (k..order).max_by(|a, b| size(a).total_cmp(&size(b)))?;
        rows.swap(k, pivot);
        let (above, below) = rows.split_at_mut(k + 1);
        let own = &above[k];
        let reciprocal = own[k].reciprocal();
        if !is_bounded(reciprocal) {
            return None;
        }
        found = found.times(own[k]);
        for row in below {
            let factor = row[k].times(reciprocal);
            for column in k + 1..order {
                row[column] = row[column].minus(factor.times(own[column]));
            }
        }
    }
    let size = match found.low > 0.0 {
        true => found,
        false => found.negated(),
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

    /// Two unit vectors whose angle is 30° have the ratio ½.
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
