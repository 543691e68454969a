//! The factorization against known solutions, nalgebra's determinant, and its own verdict in other units.

use linkwright::FailureKind;
use linkwright::generated::{Factorization, Scales};
use linkwright::math::Real;
use linkwright::nalgebra::allocator::Allocator;
use linkwright::nalgebra::{
    Const, DMatrix, DVector, DefaultAllocator, Dim, Dyn, OMatrix, OVector, SMatrix,
};

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

fn limit<T: Real>() -> T {
    T::EPSILON * T::from_f64(64.0)
}

fn random_matrix<T: Real, D: Dim>(dimension: D, sequence: &mut Sequence) -> OMatrix<T, D, D>
where
    DefaultAllocator: Allocator<D, D>,
{
    OMatrix::from_fn_generic(dimension, dimension, |_, _| T::from_f64(sequence.next()))
}

/// max |b - A x| / (n ε max|A| max|x|), accumulated in `f64`: the backward error in units of rounding.
///
/// `x` solves A x = b backward-stably if this is of order 1 to the growth factor of the elimination.
fn backward_error<T: Real, D: Dim>(
    a: &OMatrix<T, D, D>,
    x: &OVector<T, D>,
    b: &OVector<T, D>,
) -> f64
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let n = b.len();
    let largest = |values: &[T]| values.iter().fold(0.0, |m: f64, v| m.max(v.to_f64().abs()));
    let mut residual: f64 = 0.0;
    for i in 0..n {
        let product: f64 = (0..n).map(|j| a[(i, j)].to_f64() * x[j].to_f64()).sum();
        residual = residual.max((b[i].to_f64() - product).abs());
    }
    residual / (n as f64 * T::EPSILON.to_f64() * largest(a.as_slice()) * largest(x.as_slice()))
}

/// Factorizes 50 random matrices, solves for known solutions and checks the backward error.
fn solves_random_systems<T: Real, D: Dim>(dimension: D)
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let mut sequence = Sequence(0x9E37_79B9_7F4A_7C15);
    let mut accepted = 0;
    for _ in 0..50 {
        let a: OMatrix<T, D, D> = random_matrix(dimension, &mut sequence);
        let known: OVector<T, D> =
            OVector::from_fn_generic(dimension, Const::<1>, |_, _| T::from_f64(sequence.next()));
        // The right-hand side is rounded once, from f64.
        let b = OVector::from_fn_generic(dimension, Const::<1>, |i, _| {
            let terms = (0..dimension.value()).map(|j| a[(i, j)].to_f64() * known[j].to_f64());
            T::from_f64(terms.sum())
        });
        let Ok(factorization) = Factorization::new(&a, &Scales::unit(dimension), limit()) else {
            continue;
        };
        accepted += 1;
        let mut x = b.clone();
        factorization.solve(&mut x);
        assert!(backward_error(&a, &x, &b) < 4.0);
        // The pivot ratio bounds the distance to singularity from above only. This is therefore a loose forward bound,
        // which holds for random matrices, whose condition is of the order n².
        let error = (0..b.len())
            .map(|i| (x[i] - known[i]).abs().to_f64())
            .fold(0.0, f64::max);
        let n = dimension.value() as f64;
        let bound = 100.0 * n * n * T::EPSILON.to_f64() / factorization.pivot_ratio().to_f64();
        assert!(error < bound, "{error:e} > {bound:e}");
    }
    assert!(
        accepted >= 49,
        "random matrices are hardly ever singular: {accepted}"
    );
}

#[test]
fn random_systems_of_static_size_are_solved() {
    solves_random_systems::<f64, _>(Const::<1>);
    solves_random_systems::<f64, _>(Const::<2>);
    solves_random_systems::<f64, _>(Const::<6>);
    solves_random_systems::<f64, _>(Const::<30>);
    solves_random_systems::<f32, _>(Const::<6>);
    solves_random_systems::<f32, _>(Const::<30>);
}

#[test]
fn random_systems_of_dynamic_size_are_solved() {
    for n in [1, 2, 3, 17, 60] {
        solves_random_systems::<f64, _>(Dyn(n));
        solves_random_systems::<f32, _>(Dyn(n));
    }
}

#[test]
fn static_and_dynamic_sizes_give_the_same_bits() {
    let mut sequence = Sequence(7);
    let a: SMatrix<f64, 9, 9> = random_matrix(Const, &mut sequence);
    let b = DVector::from_fn(9, |i, _| i as f64 - 3.5);
    let fixed = Factorization::new(&a, &Scales::unit(Const::<9>), limit()).expect("regular");
    let dynamic = DMatrix::from_column_slice(9, 9, a.as_slice());
    let dynamic = Factorization::new(&dynamic, &Scales::unit(Dyn(9)), limit()).expect("regular");
    let mut x = OVector::<f64, Const<9>>::from_column_slice(b.as_slice());
    let mut y = b;
    fixed.solve(&mut x);
    dynamic.solve(&mut y);
    assert_eq!(x.as_slice(), y.as_slice());
    assert_eq!(
        fixed.determinant().to_bits(),
        dynamic.determinant().to_bits()
    );
}

#[test]
fn empty_matrix_is_regular() {
    let a = DMatrix::<f64>::zeros(0, 0);
    let factorization = Factorization::new(&a, &Scales::unit(Dyn(0)), limit()).expect("regular");
    factorization.solve(&mut DVector::zeros(0));
    assert_eq!(factorization.determinant(), 1.0);
    assert_eq!(factorization.pivot_ratio(), 1.0);
}

/// The n × n Hilbert matrix, the standard example of a condition that grows like e^(3.5 n).
fn hilbert(n: usize) -> DMatrix<f64> {
    DMatrix::from_fn(n, n, |i, j| 1.0 / (i + j + 1) as f64)
}

#[test]
fn ill_conditioned_matrices_are_solved_stably_or_rejected() {
    for n in 2..=9 {
        let a = hilbert(n);
        let factorization =
            Factorization::new(&a, &Scales::unit(Dyn(n)), limit()).expect("still regular");
        let b = &a * DVector::from_element(n, 1.0);
        let mut x = b.clone();
        factorization.solve(&mut x);
        assert!(backward_error(&a, &x, &b) < 2.0, "n = {n}");
    }
    // The last pivot of n = 12 is 2e-15.
    let verdict = Factorization::new(&hilbert(12), &Scales::unit(Dyn(12)), limit());
    assert!(matches!(
        verdict,
        Err(FailureKind::Singular { column: 11, .. })
    ));
}

#[test]
fn singular_matrices_are_rejected_at_the_dependent_column() {
    let mut sequence = Sequence(11);
    for dependent in 1..8 {
        let mut a: SMatrix<f64, 8, 8> = random_matrix(Const, &mut sequence);
        let combination = a.columns(0, dependent).column_sum() * 0.7;
        a.set_column(dependent, &combination);
        let verdict = Factorization::new(&a, &Scales::unit(Const), limit());
        let Err(FailureKind::Singular {
            pivot_ratio,
            column,
        }) = verdict
        else {
            panic!("a dependent column was accepted");
        };
        assert_eq!(usize::from(column), dependent);
        assert!(pivot_ratio < limit());
    }
}

#[test]
fn nearly_singular_matrices_are_judged_by_the_given_limit() {
    // The second pivot is exactly 2^-30.
    let gap = (2.0_f64).powi(-30);
    let a = SMatrix::<f64, 2, 2>::new(1.0, 1.0, 1.0, 1.0 + gap);
    let scales = Scales::unit(Const);
    let accepted = Factorization::new(&a, &scales, gap / 2.0).expect("above the limit");
    assert_eq!(accepted.pivot_ratio(), gap / (1.0 + gap));
    assert_eq!(accepted.determinant(), gap);
    let verdict = Factorization::new(&a, &scales, gap * 2.0);
    assert!(matches!(
        verdict,
        Err(FailureKind::Singular { column: 1, .. })
    ));
}

#[test]
fn entries_that_are_not_finite_are_rejected_wherever_they_are() {
    for position in 0..16 {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut a = SMatrix::<f64, 4, 4>::identity();
            a[position] = value;
            let verdict = Factorization::new(&a, &Scales::unit(Const), limit());
            assert!(matches!(verdict, Err(FailureKind::NotFinite)));
        }
    }
}

#[test]
fn overflow_within_the_elimination_is_rejected() {
    let large = f64::MAX;
    let a = SMatrix::<f64, 3, 3>::new(
        large, large, 0.0, //
        -large, large, 0.0, //
        0.0, 0.0, large,
    );
    let verdict = Factorization::new(&a, &Scales::unit(Const), limit());
    assert!(matches!(verdict, Err(FailureKind::NotFinite)));
}

/// The Jacobian of a crank and a slider of size `length`: two rows and two coordinates are lengths, one each angles.
fn slider_crank(length: f64, angle: f64) -> (SMatrix<f64, 3, 3>, Scales<f64, Const<3>>) {
    let (sin, cos) = angle.sin_cos();
    let a = SMatrix::<f64, 3, 3>::new(
        1.0,
        0.0,
        length * sin, //
        0.0,
        1.0,
        -length * cos, //
        0.0,
        cos / length,
        1.0,
    );
    let mut scales = Scales::unit(Const);
    for magnitudes in [&mut scales.rows, &mut scales.columns] {
        magnitudes[0] = length;
        magnitudes[1] = length;
    }
    (a, scales)
}

#[test]
fn verdict_does_not_depend_on_the_unit_of_length() {
    // With the last entry -1 the determinant is -sin², and so is the last pivot. The limit lies between the squares of
    // 10e-7 and 11e-7, well away from both.
    let mut rejected = 0;
    for step in 0..=200 {
        let angle = 1e-7 * f64::from(step - 100);
        let judge = |length: f64| {
            let (mut a, scales) = slider_crank(length, angle);
            a[(2, 2)] = -1.0;
            Factorization::new(&a, &scales, 1.1e-12).map(|f| f.pivot_ratio())
        };
        let reference = judge(1.0);
        for length in [1e-9, 1e-3, 7.3, 1e9] {
            match (&reference, judge(length)) {
                (Ok(ratio), Ok(other)) => assert!((ratio - other).abs() <= 4.0 * f64::EPSILON),
                (
                    Err(FailureKind::Singular { column, .. }),
                    Err(FailureKind::Singular { column: other, .. }),
                ) => {
                    rejected += 1;
                    assert_eq!(*column, other);
                }
                _ => panic!("the verdict at {angle:e} changes with the length {length:e}"),
            }
        }
    }
    assert!(
        rejected > 0 && rejected < 4 * 201,
        "both verdicts must occur: {rejected}"
    );
}

#[test]
fn without_scales_the_verdict_would_depend_on_the_unit() {
    let (a, scales) = slider_crank(1e9, 0.3);
    assert!(Factorization::new(&a, &scales, 1e-6).is_ok());
    assert!(Factorization::new(&a, &Scales::unit(Const), 1e-6).is_err());
}

#[test]
fn scaled_systems_have_the_solution_of_the_unscaled_ones() {
    for length in [1e-9, 1.0, 1e9] {
        let (a, scales) = slider_crank(length, 0.4);
        let known = OVector::<f64, Const<3>>::new(0.3 * length, -0.7 * length, 0.9);
        let mut x = a * known;
        let factorization = Factorization::new(&a, &scales, limit()).expect("regular");
        factorization.solve(&mut x);
        let error = (x - known).component_div(&scales.columns).amax();
        assert!(error <= 8.0 * f64::EPSILON, "length {length:e}: {error:e}");
        let determinant = 1.0 + 0.4_f64.cos().powi(2);
        assert!((factorization.determinant() / determinant - 1.0).abs() <= 8.0 * f64::EPSILON);
    }
}

#[test]
fn determinant_has_the_sign_of_the_permutation() {
    let mut sequence = Sequence(3);
    for _ in 0..100 {
        let a: SMatrix<f64, 5, 5> = random_matrix(Const, &mut sequence);
        let factorization = Factorization::new(&a, &Scales::unit(Const), limit()).expect("regular");
        let expected = a.determinant();
        assert!((factorization.determinant() - expected).abs() <= 1e-13 * expected.abs().max(0.01));
    }
}

#[test]
fn determinant_does_not_overflow_on_the_way() {
    // The partial products leave the range of the scalar, the determinant does not.
    let diagonal = OVector::<f64, Const<6>>::from([1e150, 1e150, 1e150, 1e-150, 1e-150, 1e-150]);
    let a = SMatrix::from_diagonal(&diagonal);
    let factorization = Factorization::new(&a, &Scales::unit(Const), 0.0).expect("regular");
    assert!((factorization.determinant() - 1.0).abs() <= 1e-14);
    let a = SMatrix::<f64, 6, 6>::identity() * 1e200;
    let factorization = Factorization::new(&a, &Scales::unit(Const), limit()).expect("regular");
    assert_eq!(factorization.determinant(), f64::INFINITY);
}
