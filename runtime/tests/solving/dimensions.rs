//! Solves are equal for static and dynamic dimensions, and for any unit of length.

use crate::exam_equations::Exam;
use linkwright::generated::newton;
use linkwright::nalgebra::{Const, DMatrix, DVector, Dyn, OMatrix, OVector, SMatrix, SVector};
use linkwright::{Equations, FailureKind, Frame, Settings};

/// The exam's equations with lengths in a unit of 1 / `per_meter` meters, as an interpreter would present them.
struct Interpreted {
    per_meter: f64,
}

fn is_length(index: usize, angles: [usize; 2]) -> bool {
    !angles.contains(&index)
}

impl Interpreted {
    fn row(&self, row: usize) -> f64 {
        if is_length(row, [5, 5]) {
            self.per_meter
        } else {
            1.0
        }
    }
    fn column(&self, column: usize) -> f64 {
        if is_length(column, [2, 5]) {
            self.per_meter
        } else {
            1.0
        }
    }
    fn in_meters(&self, q: &DVector<f64>) -> SVector<f64, 6> {
        SVector::from_fn(|i, _| q[i] / self.column(i))
    }
    fn fill(&self, target: &mut DVector<f64>, rows: &SVector<f64, 6>) {
        for (row, entry) in target.iter_mut().enumerate() {
            *entry = rows[row] * self.row(row);
        }
    }
}

impl Equations<f64, Dyn> for Interpreted {
    fn dimension(&self) -> Dyn {
        Dyn(6)
    }
    fn residual(&self, q: &DVector<f64>, t: f64, phi: &mut DVector<f64>) {
        let mut rows = SVector::zeros();
        Exam.residual(&self.in_meters(q), t, &mut rows);
        self.fill(phi, &rows);
    }
    fn jacobian(&self, q: &DVector<f64>, t: f64, phi_q: &mut DMatrix<f64>) {
        let mut matrix = SMatrix::zeros();
        Exam.jacobian(&self.in_meters(q), t, &mut matrix);
        for column in 0..6 {
            for row in 0..6 {
                phi_q[(row, column)] = matrix[(row, column)] * self.row(row) / self.column(column);
            }
        }
    }
    fn time_derivative(&self, q: &DVector<f64>, t: f64, phi_t: &mut DVector<f64>) {
        let mut rows = SVector::zeros();
        Exam.time_derivative(&self.in_meters(q), t, &mut rows);
        self.fill(phi_t, &rows);
    }
    fn gamma(&self, q: &DVector<f64>, qd: &DVector<f64>, t: f64, gamma: &mut DVector<f64>) {
        let mut rows = SVector::zeros();
        Exam.gamma(&self.in_meters(q), &self.in_meters(qd), t, &mut rows);
        self.fill(gamma, &rows);
    }
    fn row_scale(&self, row: usize) -> f64 {
        self.row(row)
    }
    fn coordinate_scale(&self, column: usize) -> f64 {
        self.column(column)
    }
}

const ESTIMATE: [f64; 6] = [0.0, 0.0, 0.5, 1.7, 2.0, 1.0];

fn estimate(equations: &Interpreted) -> DVector<f64> {
    DVector::from_fn(6, |i, _| ESTIMATE[i] * equations.column(i))
}

#[test]
fn dynamic_dimension_gives_the_bits_of_the_static_one() {
    let settings = Settings::default();
    let equations = Interpreted { per_meter: 1.0 };
    let fixed = SVector::<f64, 6>::from(ESTIMATE);
    let mut fixed = Frame::assemble(&Exam, &fixed, 0.0, &settings).expect("assembles");
    let mut dynamic =
        Frame::assemble(&equations, &estimate(&equations), 0.0, &settings).expect("assembles");
    for step in 1..=50 {
        let t = 0.02 * f64::from(step);
        fixed = fixed
            .advance(&Exam, t, &settings)
            .expect("a regular motion");
        dynamic = dynamic
            .advance(&equations, t, &settings)
            .expect("a regular motion");
        assert_eq!(fixed.q.as_slice(), dynamic.q.as_slice());
        assert_eq!(fixed.qd.as_slice(), dynamic.qd.as_slice());
        assert_eq!(fixed.qdd.as_slice(), dynamic.qdd.as_slice());
    }
}

#[test]
fn unit_of_length_changes_neither_iterations_nor_motion() {
    let settings = Settings::default();
    let meters = Interpreted { per_meter: 1.0 };
    let mut q = estimate(&meters);
    let expected = newton::solve(&meters, &mut q, 0.1, &settings).expect("converges");
    for per_meter in [1e-9, 1e3, 1e9] {
        let other = Interpreted { per_meter };
        let mut scaled = estimate(&other);
        let convergence = newton::solve(&other, &mut scaled, 0.1, &settings).expect("converges");
        assert_eq!(convergence.iterations, expected.iterations);
        let in_meters = other.in_meters(&scaled);
        assert!((in_meters - meters.in_meters(&q)).amax() <= 4.0 * f64::EPSILON);
    }
}

#[test]
fn unit_of_length_does_not_change_a_failure() {
    // With φ2 = 0 the rod lies level, the mechanism's one singular pose.
    for per_meter in [1e-9, 1.0, 1e9] {
        let equations = Interpreted { per_meter };
        let mut q = estimate(&equations);
        q[5] = 0.0;
        let failure = newton::solve(&equations, &mut q, 0.0, &Settings::default())
            .expect_err("the rod lies level");
        let FailureKind::Singular {
            pivot_ratio,
            column,
        } = failure.kind
        else {
            panic!("{failure}");
        };
        assert_eq!((pivot_ratio, column, failure.iterations), (0.0, 5, 0));
    }
}

#[test]
#[should_panic(expected = "a vector must have the dimension of the equations")]
fn vector_of_another_dimension_is_a_mistake_of_the_caller() {
    let short = DVector::from_element(5, 0.5);
    let _ = Frame::assemble(
        &Interpreted { per_meter: 1.0 },
        &short,
        0.0,
        &Settings::default(),
    );
}

#[test]
fn equations_without_coordinates_are_solved() {
    struct Nothing;
    type Empty = Const<0>;
    impl Equations<f64, Empty> for Nothing {
        fn dimension(&self) -> Empty {
            Const
        }
        fn residual(&self, _: &OVector<f64, Empty>, _: f64, _: &mut OVector<f64, Empty>) {}
        fn jacobian(&self, _: &OVector<f64, Empty>, _: f64, _: &mut OMatrix<f64, Empty, Empty>) {}
        fn time_derivative(&self, _: &OVector<f64, Empty>, _: f64, _: &mut OVector<f64, Empty>) {}
        fn gamma(
            &self,
            _: &OVector<f64, Empty>,
            _: &OVector<f64, Empty>,
            _: f64,
            _: &mut OVector<f64, Empty>,
        ) {
        }
        fn row_scale(&self, _row: usize) -> f64 {
            1.0
        }
        fn coordinate_scale(&self, _column: usize) -> f64 {
            1.0
        }
    }
    let nowhere = OVector::<f64, Empty>::zeros();
    let frame =
        Frame::assemble(&Nothing, &nowhere, 0.0, &Settings::default()).expect("nothing to solve");
    assert_eq!(frame.q.len(), 0);
}
