//! The estimate of the condition, the transposed solve and the sign of the determinant, against nalgebra's inverse.

use linkwright::generated::{Factorization, Scales};
use linkwright::nalgebra::{Const, DMatrix, DVector, Dyn, SMatrix, SVector};
use linkwright::{Branch, FailureKind};

/// A reproducible sequence of numbers in [-1, 1) (xorshift64*, Vigna 2016).
struct Sequence(u64);

impl Sequence {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let bits = self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11;
        bits as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

fn norm(matrix: &DMatrix<f64>) -> f64 {
    let sums = matrix
        .column_iter()
        .map(|column| column.iter().map(|x| x.abs()).sum());
    sums.fold(0.0, f64::max)
}

fn factorize(matrix: &DMatrix<f64>) -> Factorization<f64, Dyn> {
    Factorization::new(matrix, &Scales::unit(Dyn(matrix.nrows())), 1e-15).expect("regular")
}

/// The estimate over the truth: 1 at best, larger where the norm of the inverse is underestimated.
fn overestimate(matrix: &DMatrix<f64>) -> f64 {
    let inverse = matrix.clone().try_inverse().expect("regular");
    let truth = 1.0 / (norm(matrix) * norm(&inverse));
    factorize(matrix).reciprocal_condition(matrix) / truth
}

#[test]
fn reciprocal_condition_is_never_too_small_and_seldom_much_too_large() {
    let mut sequence = Sequence(0x9E37_79B9_7F4A_7C15);
    let mut good = 0;
    let mut all = 0;
    for n in 1..=20 {
        for _ in 0..50 {
            let mut matrix = DMatrix::from_fn(n, n, |_, _| sequence.next());
            // Half of them nearly singular: the last row almost a combination of the others.
            if all % 2 == 0 && n > 1 {
                let combination = matrix.rows(0, n - 1).row_sum();
                let row = combination + 1e-6 * matrix.row(n - 1);
                matrix.set_row(n - 1, &row);
            }
            let ratio = overestimate(&matrix);
            assert!((1.0 - 1e-6..=10.0).contains(&ratio), "n = {n}: {ratio}");
            good += usize::from(ratio <= 1.0 + 1e-6);
            all += 1;
        }
    }
    // Higham found the norm exact for most random matrices.
    assert!(5 * good >= 4 * all, "exact for {good} of {all}");
}

#[test]
fn known_conditions_are_found() {
    assert_eq!(
        factorize(&DMatrix::identity(4, 4)).reciprocal_condition(&DMatrix::identity(4, 4)),
        1.0
    );
    // The Hilbert matrix of order 5 has the condition 943656 in the 1-norm.
    let hilbert = DMatrix::from_fn(5, 5, |i, j| 1.0 / (i + j + 1) as f64);
    let estimate = factorize(&hilbert).reciprocal_condition(&hilbert);
    assert!(
        (1.0 / estimate - 943_656.0).abs() < 1.0,
        "{}",
        1.0 / estimate
    );
    // Kahan's matrix: no pivot is small, and yet it is nearly singular.
    let (sine, cosine) = (0.285_f64.sin(), 0.285_f64.cos());
    let kahan = DMatrix::from_fn(20, 20, |i, j| {
        let height = sine.powi(i32::try_from(i).expect("small"));
        match i.cmp(&j) {
            std::cmp::Ordering::Less => -cosine * height,
            std::cmp::Ordering::Equal => height,
            std::cmp::Ordering::Greater => 0.0,
        }
    });
    assert!((1.0 - 1e-6..=3.0).contains(&overestimate(&kahan)));
    assert_eq!(
        factorize(&DMatrix::zeros(0, 0)).reciprocal_condition(&DMatrix::zeros(0, 0)),
        1.0
    );
}

#[test]
fn condition_does_not_depend_on_units() {
    let mut sequence = Sequence(7);
    let matrix = SMatrix::<f64, 4, 4>::from_fn(|_, _| sequence.next());
    let estimate = Factorization::new(&matrix, &Scales::unit(Const), 1e-14)
        .expect("regular")
        .reciprocal_condition(&matrix);
    // Rows in other units: powers of two, so that nothing is rounded.
    let rows = SVector::from([1024.0, 0.125, 1.0, 4.0]);
    let columns = SVector::from([2.0, 512.0, 0.25, 1.0]);
    let scaled = SMatrix::<f64, 4, 4>::from_fn(|i, j| matrix[(i, j)] * rows[i] / columns[j]);
    let scales = Scales { rows, columns };
    let other = Factorization::new(&scaled, &scales, 1e-14).expect("regular");
    assert_eq!(other.reciprocal_condition(&scaled), estimate);
}

#[test]
fn transposed_system_is_solved() {
    let mut sequence = Sequence(11);
    for n in 1..=12 {
        let matrix = DMatrix::from_fn(n, n, |_, _| sequence.next());
        let rows = DVector::from_fn(n, |_, _| 2.0 + sequence.next());
        let columns = DVector::from_fn(n, |_, _| 2.0 + sequence.next());
        let known = DVector::from_fn(n, |_, _| sequence.next());
        let factorization =
            Factorization::new(&matrix, &Scales { rows, columns }, 1e-14).expect("regular");
        let mut x = matrix.transpose() * &known;
        factorization.solve_transposed(&mut x);
        let inverse = matrix.clone().try_inverse().expect("regular");
        let condition = norm(&matrix) * norm(&inverse);
        let error = (x - known).amax();
        assert!(error <= 16.0 * f64::EPSILON * condition, "{n}: {error:e}");
    }
}

#[test]
fn branch_is_the_sign_of_the_determinant() {
    let mut sequence = Sequence(13);
    let mut negative = 0;
    for n in 1..=9 {
        for _ in 0..30 {
            let matrix = DMatrix::from_fn(n, n, |_, _| sequence.next());
            let branch = match Factorization::new(&matrix, &Scales::unit(Dyn(n)), 1e-14) {
                Ok(factorization) => factorization.branch(),
                Err(kind) => {
                    assert!(matches!(kind, FailureKind::Singular { .. }));
                    continue;
                }
            };
            let expected = matrix.determinant();
            assert_eq!(branch.sign::<f64>(), expected.signum());
            negative += i32::from(branch == Branch::Negative);
            // The sign does not fall to underflow: the determinant of this one is below the least number.
            let tiny = &matrix * 1e-300;
            let scales = Scales {
                rows: DVector::from_element(n, 1e-300),
                columns: DVector::from_element(n, 1.0),
            };
            let tiny = Factorization::new(&tiny, &scales, 1e-14).expect("regular");
            assert_eq!(tiny.branch(), branch);
        }
    }
    assert!((90..=180).contains(&negative), "{negative} of 270");
    assert_eq!(factorize(&DMatrix::zeros(0, 0)).branch(), Branch::Positive);
}
