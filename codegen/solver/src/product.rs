//! Multiplies matrices with the same bits on every processor.

use nalgebra::DMatrix;

/// Returns the product of two matrices. Products of large matrices by nalgebra depend on the vectors that a processor has.
pub(crate) fn product(left: &DMatrix<f64>, right: &DMatrix<f64>) -> DMatrix<f64> {
    let mut product = DMatrix::zeros(left.nrows(), right.ncols());
    for (mut column, factor) in product.column_iter_mut().zip(right.column_iter()) {
        column.gemv(1.0, left, &factor, 0.0);
    }
    product
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_are_rounded_in_the_order_of_the_columns() {
        let entry = |row: usize, column: usize| 1.0 / (1.0 + (7 * row + 3 * column) as f64);
        let [left, right] = [
            DMatrix::from_fn(9, 11, entry),
            DMatrix::from_fn(11, 8, entry),
        ];
        let product = product(&left, &right);
        for row in 0..9 {
            for column in 0..8 {
                let terms = (0..11).map(|it| left[(row, it)] * right[(it, column)]);
                let sum = terms.reduce(|sum, term| sum + term);
                assert_eq!(Some(product[(row, column)]), sum, "{row} {column}");
            }
        }
    }
}
