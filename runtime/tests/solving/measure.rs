//! Distance of a matrix from singular, against its singular values.

use linkwright::generated::{Factorization, Measure, Scales};
use linkwright::nalgebra::{SMatrix, SVector};

/// A reproducible sequence of numbers in [-1, 1).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

fn scales<const N: usize>(row: f64, column: f64) -> Scales<f64, linkwright::nalgebra::Const<N>> {
    Scales {
        rows: SVector::from_element(row),
        columns: SVector::from_element(column),
    }
}

fn measure<const N: usize>(matrix: &SMatrix<f64, N, N>, row: f64, column: f64) -> Measure
where
    linkwright::nalgebra::Const<N>: linkwright::nalgebra::ToTypenum,
{
    Factorization::new(matrix, &scales(row, column), 0.0)
        .expect("a regular matrix")
        .measure(matrix)
}

/// Determinant ratio and singular values, from a decomposition that is independent of the elimination.
fn reference<const N: usize>(matrix: &SMatrix<f64, N, N>) -> (f64, Vec<f64>) {
    let mut unit = nalgebra::DMatrix::from_column_slice(N, N, matrix.as_slice());
    for mut column in unit.column_iter_mut() {
        let length = column.norm();
        column /= length;
    }
    let singular = unit.singular_values();
    (singular.product(), singular.iter().copied().collect())
}

fn agrees<const N: usize>(seed: u64)
where
    linkwright::nalgebra::Const<N>: linkwright::nalgebra::ToTypenum,
{
    let mut random = Random(seed);
    for _ in 0..200 {
        let matrix = SMatrix::<f64, N, N>::from_fn(|_, _| random.next());
        // Columns in other units.
        let stretched = SMatrix::<f64, N, N>::from_fn(|row, column| {
            matrix[(row, column)] * 10_f64.powi(3 * column as i32 - 4)
        });
        let (determinant, singular) = reference(&matrix);
        let squares: f64 = singular.iter().map(|it| 1.0 / (it * it)).sum();
        let reciprocal = (N as f64 / squares).sqrt();
        let smallest = singular.iter().copied().fold(f64::INFINITY, f64::min);
        for found in [measure(&matrix, 1.0, 1.0), measure(&stretched, 1e-3, 7.0)] {
            assert!((found.determinant.abs() - determinant).abs() < 1e-13);
            let gap = (found.reciprocal_condition - reciprocal).abs();
            assert!(gap < 1e-13, "{gap:e}");
            // Up to rounding, the smallest singular value and its multiple enclose it.
            let above = (N as f64).sqrt() * smallest;
            let condition = found.reciprocal_condition;
            assert!(smallest * (1.0 - 1e-12) <= condition && condition <= above * (1.0 + 1e-12));
        }
    }
}

#[test]
fn both_numbers_are_those_of_the_singular_values() {
    agrees::<2>(1);
    agrees::<3>(2);
    agrees::<4>(3);
    agrees::<6>(4);
}

#[test]
fn two_columns_have_the_sine_of_their_angle_down_to_rounding() {
    for exponent in 0..16 {
        let angle = 1.2 * 10_f64.powi(-exponent);
        // A long link and a short one, turned anyhow.
        let columns = [(1e3, 0.7), (1e-2, 0.7 + angle)];
        let matrix = SMatrix::<f64, 2, 2>::from_fn(|row, column| {
            let (length, at): (f64, f64) = columns[column];
            length * [at.cos(), at.sin()][row]
        });
        let measured = measure(&matrix, 1.0, 1.0);
        // The angle itself is known to rounding of 0.7 only.
        let gap = (measured.determinant - angle.sin()).abs();
        assert!(gap < 4e-16, "{gap:e} at {angle:e}");
        let difference = measured.reciprocal_condition - measured.determinant.abs();
        assert!(difference.abs() < 4e-16, "{difference:e} at {angle:e}");
    }
}

#[test]
fn one_equation_has_its_scaled_slope() {
    let slope = |value: f64| measure(&SMatrix::<f64, 1, 1>::new(value), 2.0, 1.0);
    assert_eq!(slope(-0.5), Measure::sine(-0.25));
    assert_eq!(slope(8.0), Measure::sine(1.0));
}
