//! Paths: followed to their continuation, never to another path, and to their end with the requested precision.

use crate::counted::Counted;
use crate::exam_equations::Exam;
use crate::turning::{DEAD_POINT, Turning, closed_form};
use linkwright::nalgebra::{Const, SMatrix, SVector};
use linkwright::{Branch, Equations, FailureKind, Frame, Settings};

type Vector = SVector<f64, 6>;

fn with_substeps(substeps: u16) -> Settings {
    Settings {
        substeps,
        ..Settings::default()
    }
}

fn started(sign: f64, t: f64) -> (Frame<f64, Const<6>>, Branch) {
    let settings = Settings::default();
    let frame = Frame::assemble(&Turning, &closed_form(t, sign), t, &settings).expect("assembles");
    let branch = Frame::branch_of(&Turning, &frame.q, t, &settings).expect("regular");
    (frame, branch)
}

#[test]
fn a_short_way_gives_the_bits_of_a_plain_advance() {
    let (mut frame, branch) = started(1.0, 0.0);
    let settings = Settings::default();
    for step in 1..=90 {
        let t = 0.01 * f64::from(step);
        let plain = frame.advance(&Turning, t, &settings).expect("regular");
        frame = frame
            .follow(&Turning, branch, t, &settings)
            .expect("regular");
        assert_eq!(frame, plain);
    }
}

#[test]
fn the_two_ways_to_lay_the_rod_have_different_branches() {
    let (_, above) = started(1.0, 0.5);
    let (_, below) = started(-1.0, 0.5);
    assert_eq!(above, below.opposite());
}

#[test]
fn a_long_way_is_followed_where_a_plain_advance_changes_over() {
    // A path from t = -5.2 s to the same crank angle one turn later would pass the dead points. The path is therefore
    // within one turn of the crank: φ1 from -π/2 + 0.01 to π/2 - 0.01.
    let (first, last) = (0.01 - 2.0 * DEAD_POINT, DEAD_POINT - 0.01);
    let mut changed = 0;
    for sign in [1.0, -1.0] {
        for parts in 1..=40 {
            let start = first + 0.3 * f64::from(parts % 5);
            let (frame, branch) = started(sign, start);
            let t = start + (last - start) * f64::from(parts) / 40.0;
            let expected = closed_form(t, sign);
            let followed = frame
                .follow(&Turning, branch, t, &with_substeps(64))
                .unwrap_or_else(|failure| panic!("from {start} to {t}: {failure}"));
            let condition = 1.0 / expected[5].abs();
            let error = (followed.q - expected).amax();
            assert!(error <= 1e-14 * condition, "from {start} to {t}: {error:e}");
            if let Ok(plain) = frame.advance(&Turning, t, &Settings::default()) {
                changed += i32::from((plain.q - expected).amax() > 1e-6);
            }
        }
    }
    // Otherwise the paths would be too short to be a test.
    assert!(changed >= 20, "{changed}");
}

#[test]
fn the_dead_point_is_named_at_its_time() {
    for (start, budget, precision) in [
        (0.0, 32, 1e-8),
        (0.0, 64, 1e-14),
        (1.0, 64, 1e-14),
        (-2.0, 64, 1e-14),
        (1.04, 64, 1e-14),
    ] {
        for sign in [1.0, -1.0] {
            for target in [1.1, 1.5, 3.0, 1e3] {
                let (frame, branch) = started(sign, start);
                let kept = frame;
                let failure = frame
                    .follow(&Turning, branch, target, &with_substeps(budget))
                    .expect_err("the crank cannot pass");
                let error = (failure.time - DEAD_POINT).abs();
                let case = format!("from {start} to {target} in {budget}: {failure}");
                assert!(error <= precision, "{case}: {error:e}");
                let FailureKind::Singular { column, .. } = failure.kind else {
                    panic!("{case}");
                };
                // φ2 turns by 1 where y2 rises by √3, and y2 is the faster one.
                assert_eq!(column, 4, "{case}");
                assert_eq!(frame, kept);
            }
        }
    }
}

#[test]
fn steps_of_a_loop_end_at_the_dead_point_too() {
    let (mut frame, branch) = started(1.0, 0.0);
    let settings = with_substeps(64);
    let mut step = 0;
    let failure = loop {
        step += 1;
        match frame.follow(&Turning, branch, 0.01 * f64::from(step), &settings) {
            Ok(next) => frame = next,
            Err(failure) => break failure,
        }
    };
    assert_eq!(step, 105);
    assert!((failure.time - DEAD_POINT).abs() <= 1e-14, "{failure}");
    assert!(matches!(failure.kind, FailureKind::Singular { .. }));
    // The path back is regular.
    let back = frame
        .follow(&Turning, branch, 0.0, &settings)
        .expect("regular");
    assert!((back.q - closed_form(0.0, 1.0)).amax() <= 1e-14);
}

#[test]
fn backwards_the_other_dead_point_is_found() {
    // φ1 = -π/2 at t = -2π/3.
    let (frame, branch) = started(1.0, 0.0);
    let failure = frame
        .follow(&Turning, branch, -9.0, &with_substeps(64))
        .expect_err("cannot pass");
    assert!(
        (failure.time + 2.0 * DEAD_POINT).abs() <= 1e-14,
        "{failure}"
    );
    assert!(matches!(failure.kind, FailureKind::Singular { .. }));
}

#[test]
fn another_branch_than_that_of_the_frame_is_refused() {
    let (frame, branch) = started(1.0, 0.0);
    let settings = Settings::default();
    for t in [0.0, 0.1] {
        let failure = frame
            .follow(&Turning, branch.opposite(), t, &settings)
            .expect_err("other branch");
        assert_eq!(failure.kind, FailureKind::WrongBranch, "{failure}");
    }
}

#[test]
fn a_budget_that_is_too_small_says_so() {
    // The exam's driver turns the crank to and fro; its path is too long for two attempts.
    let settings = with_substeps(2);
    let estimate = Vector::from([0.0, 0.0, 0.5, 1.7, 2.0, 1.0]);
    let frame = Frame::assemble(&Exam, &estimate, 0.0, &settings).expect("assembles");
    let branch = Frame::branch_of(&Exam, &frame.q, 0.0, &settings).expect("regular");
    let failure = frame
        .follow(&Exam, branch, 40.0, &settings)
        .expect_err("too far");
    assert_eq!(failure.kind, FailureKind::StepTooLarge, "{failure}");
    assert!(failure.time > 0.0 && failure.time <= 40.0);
    let enough = frame
        .follow(&Exam, branch, 40.0, &with_substeps(400))
        .expect("a long way");
    let phi1 = std::f64::consts::FRAC_PI_6 + 80.0_f64.sin();
    assert!((enough.q[2] - phi1).abs() <= 1e-13);
    let phi2 = (1.0 - phi1.cos() / 3.0_f64.sqrt()).acos();
    assert!((enough.q[5] - phi2).abs() <= 1e-13);
}

/// Two paths that cross: x = t and x = -t solve x² = t², and at t = 0 the Jacobian is zero.
struct Crossing;

impl Equations<f64, Const<1>> for Crossing {
    fn dimension(&self) -> Const<1> {
        Const
    }
    fn residual(&self, q: &SVector<f64, 1>, t: f64, phi: &mut SVector<f64, 1>) {
        phi[0] = (q[0] - t) * (q[0] + t);
    }
    fn jacobian(&self, q: &SVector<f64, 1>, _t: f64, phi_q: &mut SMatrix<f64, 1, 1>) {
        phi_q[0] = 2.0 * q[0];
    }
    fn time_derivative(&self, _: &SVector<f64, 1>, t: f64, phi_t: &mut SVector<f64, 1>) {
        phi_t[0] = -2.0 * t;
    }
    fn gamma(&self, _: &SVector<f64, 1>, qd: &SVector<f64, 1>, _: f64, g: &mut SVector<f64, 1>) {
        g[0] = 2.0 - 2.0 * qd[0] * qd[0];
    }
    fn row_scale(&self, _row: usize) -> f64 {
        1.0
    }
    fn coordinate_scale(&self, _column: usize) -> f64 {
        1.0
    }
}

#[test]
fn where_paths_cross_the_branch_ends() {
    let settings = with_substeps(64);
    for sign in [1.0, -1.0] {
        let start = SVector::<f64, 1>::new(-sign);
        let frame = Frame::assemble(&Crossing, &start, -1.0, &settings).expect("regular");
        let branch = Frame::branch_of(&Crossing, &frame.q, -1.0, &settings).expect("regular");
        for target in [0.75, 0.1, 2.0] {
            let failure = frame
                .follow(&Crossing, branch, target, &settings)
                .expect_err("branch ends");
            let ends = matches!(
                failure.kind,
                FailureKind::WrongBranch | FailureKind::Singular { .. }
            );
            assert!(ends, "to {target}: {failure}");
            assert!(failure.time.abs() <= 1e-6, "to {target}: {failure}");
        }
        // A plain advance takes no notice.
        assert!(frame.advance(&Crossing, 0.75, &settings).is_ok());
    }
}

#[test]
fn times_that_are_not_finite_are_refused() {
    let (frame, branch) = started(1.0, 0.0);
    for t in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let failure = frame
            .follow(&Turning, branch, t, &Settings::default())
            .expect_err("a time must be finite");
        assert_eq!(failure.kind, FailureKind::NotFinite, "{failure}");
    }
}

#[test]
fn single_precision_finds_the_dead_point_to_its_rounding() {
    let settings = Settings::<f32> {
        substeps: 64,
        ..Settings::default()
    };
    let estimate = closed_form(0.0, 1.0).map(|x| x as f32);
    let frame = Frame::assemble(&Turning, &estimate, 0.0, &settings).expect("assembles");
    let branch = Frame::branch_of(&Turning, &frame.q, 0.0, &settings).expect("regular");
    let failure = frame
        .follow(&Turning, branch, 2.0, &settings)
        .expect_err("cannot pass");
    assert!(
        (f64::from(failure.time) - DEAD_POINT).abs() <= 1e-4,
        "{failure}"
    );
    assert!(matches!(failure.kind, FailureKind::Singular { .. }));
}

#[test]
fn work_is_bounded() {
    let equations = Counted::new(Turning);
    for (substeps, iterations) in [(0, 25), (1, 25), (7, 3), (32, 25), (100, 1), (20, 0)] {
        let settings = Settings {
            substeps,
            iterations,
            ..Settings::default()
        };
        let (frame, branch) = started(1.0, 0.0);
        for t in [0.3, 1.0, 1.04, 2.0, 40.0, 1e6] {
            equations.take();
            let _ = frame.follow(&equations, branch, t, &settings);
            let count = equations.take();
            let s = u32::from(substeps.max(1));
            let n = u32::from(iterations);
            assert!(count.residuals <= s * (n + 2), "{count:?}");
            assert!(count.jacobians <= s * (n + 5) + 3, "{count:?}");
            assert!(
                count.time_derivatives <= s && count.gammas <= s,
                "{count:?}"
            );
        }
    }
}
