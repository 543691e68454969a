//! The exam's mechanism by hand: the answers of its worked solution, and motion over time.

use core::f64::consts::{FRAC_PI_3, FRAC_PI_6};

use crate::exam_equations::Exam;
use linkwright::generated::{Factorization, Scales, newton};
use linkwright::nalgebra::{SMatrix, SVector};
use linkwright::{Equations, Frame, Settings};

type Vector = SVector<f64, 6>;

fn estimate() -> Vector {
    Vector::from([0.0, 0.0, 0.5, 1.7, 2.0, 1.0].map(f64::from))
}

fn assembled(t: f64) -> Frame<f64, linkwright::nalgebra::Const<6>> {
    Frame::assemble(&Exam, &estimate(), t, &Settings::default())
        .expect("the exam's mechanism assembles")
}

/// Pose, velocity and acceleration in closed form: the exam's rows solved by hand one after the other, then
/// differentiated.
fn exact(t: f64) -> [Vector; 3] {
    let root = 3.0_f64.sqrt();
    let phi1 = FRAC_PI_6 + (2.0 * t).sin();
    let phi1d = 2.0 * (2.0 * t).cos();
    let phi1dd = -4.0 * (2.0 * t).sin();
    let (sin1, cos1) = phi1.sin_cos();
    let phi2 = ((root - cos1) / root).acos();
    let (sin2, cos2) = phi2.sin_cos();
    let phi2d = -sin1 * phi1d / (root * sin2);
    let phi2dd =
        -(cos1 * phi1d * phi1d + sin1 * phi1dd + root * cos2 * phi2d * phi2d) / (root * sin2);
    let y2 = sin1 + root * sin2;
    let y2d = cos1 * phi1d + root * cos2 * phi2d;
    let y2dd =
        -sin1 * phi1d * phi1d + cos1 * phi1dd - root * sin2 * phi2d * phi2d + root * cos2 * phi2dd;
    [
        Vector::from([0.0, 0.0, phi1, root, y2, phi2]),
        Vector::from([0.0, 0.0, phi1d, 0.0, y2d, phi2d]),
        Vector::from([0.0, 0.0, phi1dd, 0.0, y2dd, phi2dd]),
    ]
}

fn exact_pose(t: f64) -> Vector {
    let [q, _, _] = exact(t);
    q
}

fn assert_close(found: &Vector, expected: &Vector, bound: f64) {
    let error = (found - expected).amax();
    assert!(
        error <= bound,
        "{found} differs from {expected} by {error:e}"
    );
}

#[test]
fn answers_at_the_start_are_the_exams() {
    let root = 3.0_f64.sqrt();
    let frame = assembled(0.0);
    let q = Vector::from([0.0, 0.0, FRAC_PI_6, root, 2.0, FRAC_PI_3]);
    let qd = Vector::from([0.0, 0.0, 2.0, 0.0, 2.0 * root / 3.0, -2.0 / 3.0]);
    assert_close(&frame.q, &q, 1e-14);
    assert_close(&frame.qd, &qd, 1e-14);
    // Q is the middle of body 2, at (-√3/2, 0) in its frame.
    let [_, _, _, x2, y2, phi2] = frame.q.data.0[0];
    let [_, _, _, x2d, y2d, phi2d] = frame.qd.data.0[0];
    let (sin, cos) = phi2.sin_cos();
    let local = -root / 2.0;
    assert!((x2 + local * cos - 3.0 * root / 4.0).abs() <= 1e-14);
    assert!((y2 + local * sin - 1.25).abs() <= 1e-14);
    assert!((x2d - local * sin * phi2d + 0.5).abs() <= 1e-14);
    assert!((y2d + local * cos * phi2d - 5.0 * root / 6.0).abs() <= 1e-14);
}

#[test]
fn first_step_is_the_one_that_the_exam_writes_down() {
    let half = 3.0_f64.sqrt() / 2.0;
    let start = exact_pose(0.0);
    let step = newton::step(&Exam, &start, 0.01, &Settings::default()).expect("a regular Jacobian");
    #[rustfmt::skip]
    let jacobian = SMatrix::<f64, 6, 6>::from_row_slice(&[
        1.0, 0.0,  0.0,  0.0,  0.0,  0.0,
        0.0, 1.0,  0.0,  0.0,  0.0,  0.0,
        1.0, 0.0, -0.5, -1.0,  0.0, -1.5,
        0.0, 1.0, half,  0.0, -1.0, half,
        0.0, 0.0,  0.0,  1.0,  0.0,  0.0,
        0.0, 0.0,  1.0,  0.0,  0.0,  0.0,
    ]);
    assert!((step.jacobian - jacobian).amax() <= 1e-15);
    let right_hand_side = Vector::from([0.0, 0.0, 0.0, 0.0, 0.0, 0.02_f64.sin()]);
    assert_close(&step.right_hand_side, &right_hand_side, 1e-15);
    // The solution by hand: Δφ2 = -Δφ1 / 3 from the third row, Δy2 = √3/2 (Δφ1 + Δφ2) from the fourth.
    let turn = 0.02_f64.sin();
    let update = Vector::from([0.0, 0.0, turn, 0.0, half * turn * 2.0 / 3.0, -turn / 3.0]);
    assert_close(&step.update, &update, 1e-15);
    assert_close(&step.pose, &(start + update), 1e-15);
}

#[test]
fn determinant_is_root_three_times_the_sine_of_the_second_angle() {
    for t in [0.0, 0.3, 0.7, 2.0] {
        let q = exact_pose(t);
        let mut jacobian = SMatrix::<f64, 6, 6>::zeros();
        Exam.jacobian(&q, t, &mut jacobian);
        let factorization = Factorization::new(&jacobian, &Scales::of(&Exam), 1e-14)
            .expect("the exam's mechanism is never singular");
        let expected = 3.0_f64.sqrt() * q[5].sin();
        assert!((factorization.determinant().abs() - expected).abs() <= 4e-15);
        assert!((factorization.determinant() - jacobian.determinant()).abs() <= 4e-15);
    }
}

#[test]
fn every_frame_of_two_periods_is_the_closed_form() {
    let settings = Settings::default();
    let mut frame = assembled(0.0);
    for index in 1..=640 {
        let t = f64::from(index) * 0.01;
        frame = frame
            .advance(&Exam, t, &settings)
            .expect("a regular motion");
        let [q, qd, qdd] = exact(t);
        assert_close(&frame.q, &q, 1e-14);
        // Each derivative divides by √3 sin φ2, which goes down to 0.4, and squares the rates of up to 2.
        assert_close(&frame.qd, &qd, 1e-14);
        assert_close(&frame.qdd, &qdd, 1e-13);
    }
}

#[test]
fn single_precision_agrees_to_its_rounding() {
    let estimate = SVector::<f32, 6>::from([0.0, 0.0, 0.5, 1.7, 2.0, 1.0]);
    let settings = Settings::<f32>::default();
    let mut frame = Frame::assemble(&Exam, &estimate, 0.0, &settings).expect("assembles");
    for index in 1..=100_u8 {
        let t = f32::from(index) / 64.0;
        frame = frame
            .advance(&Exam, t, &settings)
            .expect("a regular motion");
        let error = (frame.q.map(f64::from) - exact_pose(f64::from(t))).amax();
        assert!(error <= 4e-6, "t = {t}: {error:e}");
    }
}

#[test]
fn going_back_in_time_returns_to_the_start() {
    let settings = Settings::default();
    let start = assembled(0.0);
    let there = start
        .advance(&Exam, 0.2, &settings)
        .expect("a regular motion");
    let back = there
        .advance(&Exam, 0.0, &settings)
        .expect("a regular motion");
    assert_close(&back.q, &start.q, 2e-15);
}

#[test]
fn failed_advance_leaves_the_frame_as_it_was() {
    let frame = assembled(0.0);
    let before = frame;
    let settings = Settings {
        iterations: 0,
        ..Settings::default()
    };
    assert!(frame.advance(&Exam, 0.1, &settings).is_err());
    assert!(
        frame
            .advance(&Exam, f64::NAN, &Settings::default())
            .is_err()
    );
    assert!(
        frame
            .advance(&Exam, f64::INFINITY, &Settings::default())
            .is_err()
    );
    assert_eq!(frame, before);
}
