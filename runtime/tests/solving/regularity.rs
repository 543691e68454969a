//! Poses at which the Jacobian is singular, or nearly so: a frame is as exact as its condition lets it be, or it is refused.

use crate::single::single;
use crate::turning::{DEAD_POINT, Turning, closed_form};
use linkwright::generated::newton;
use linkwright::nalgebra::SVector;
use linkwright::{Failure, FailureKind, Frame, Settings};

fn is_singular<T>(failure: &Failure<T>) -> bool {
    matches!(failure.kind, FailureKind::Singular { .. })
}

#[test]
fn double_root_is_singular_from_wherever_it_is_approached() {
    let parabola = single(|x| x * x, |x| 2.0 * x);
    for start in [0.9, -0.3, 1e-3, 3e-6, 1e-7, 1e-9, 1e-13, 0.0] {
        for polish in [true, false] {
            let settings = Settings {
                polish,
                ..Settings::default()
            };
            let estimate = SVector::<f64, 1>::new(start);
            let failure =
                Frame::assemble(&parabola, &estimate, 0.0, &settings).expect_err("no velocity");
            assert!(is_singular(&failure), "from {start}: {failure}");
        }
    }
}

#[test]
fn solve_of_a_double_root_goes_on_until_the_residual_is_rounding_or_says_singular() {
    // Where the residual first meets 1e-12, after 20 steps, the pose is still wrong by 9e-7. Each step removes half of that.
    let parabola = single(|x| x * x, |x| 2.0 * x);
    let mut q = SVector::<f64, 1>::new(0.9);
    let failure = newton::solve(&parabola, &mut q, 0.0, &Settings::default()).expect_err("slow");
    assert!(is_singular(&failure), "{failure}");
    assert!(failure.residual < 1e-14, "{failure:?}");
    let settings = Settings {
        iterations: 40,
        ..Settings::default()
    };
    newton::solve(&parabola, &mut q, 0.0, &settings).expect("a root");
    assert!(q[0].abs() <= 3e-8, "{}", q[0]);
}

#[test]
fn root_of_high_multiplicity_is_singular() {
    // The residual meets the tolerance at 0.25 and rounding level at 0.18.
    let flat = single(|x| x.powi(20), |x| 20.0 * x.powi(19));
    let estimate = SVector::<f64, 1>::new(0.9);
    for iterations in [25, 30, 100] {
        let settings = Settings {
            iterations,
            ..Settings::default()
        };
        let failure = Frame::assemble(&flat, &estimate, 0.0, &settings).expect_err("not at a root");
        assert!(is_singular(&failure), "{failure}");
    }
}

#[test]
fn pair_of_roots_is_told_apart_or_called_singular() {
    // x² = g with roots 2 √g apart; the derivative of √g is the condition of the pose.
    macro_rules! near_double {
        ($exponent:literal) => {
            single(|x| x * x - $exponent, |x| 2.0 * x)
        };
    }
    for (gap, equation, regular) in [
        (1e-2_f64, near_double!(1e-2), true),
        (1e-6, near_double!(1e-6), true),
        (1e-10, near_double!(1e-10), true),
        (1e-12, near_double!(1e-12), true),
        (1e-13, near_double!(1e-13), true),
        (1e-14, near_double!(1e-14), true),
        (1e-17, near_double!(1e-17), false),
        (1e-20, near_double!(1e-20), false),
        (1e-200, near_double!(1e-200), false),
    ] {
        let root = gap.sqrt();
        // Estimates far away, and such that meet the tolerance as they are.
        for start in [1.0, 0.1, 1e-6, -1e-6, 1.5 * root, 0.6 * root, -1.2 * root] {
            if start.abs() < 0.01 * root {
                // The first step from there is longer than a hundred times the distance to the roots.
                continue;
            }
            let estimate = SVector::<f64, 1>::new(start);
            match Frame::assemble(&equation, &estimate, 0.0, &Settings::default()) {
                Ok(frame) => {
                    let error = (frame.q[0].abs() - root).abs();
                    let bound = 4.0 * f64::EPSILON / (2.0 * root);
                    assert!(regular, "gap {gap:e} from {start:e}: {}", frame.q[0]);
                    assert!(error <= bound, "gap {gap:e} from {start:e}: {error:e}");
                }
                Err(failure) => {
                    let kind = failure.kind;
                    assert!(!regular, "gap {gap:e} from {start:e}: {failure}");
                    assert!(is_singular(&failure), "{kind:?}");
                }
            }
        }
    }
}

#[test]
fn coarse_tolerance_does_not_pass_for_a_pose() {
    // Both x = 0.03 and x = 0.02 meet a tolerance of 1e-3 for x² = 4e-4; only the latter is the pose.
    let near = single(|x| x * x - 4e-4, |x| 2.0 * x);
    let settings = Settings {
        tolerance: 1e-3,
        ..Settings::default()
    };
    for start in [1.0, 0.1, 0.034, 0.03] {
        let estimate = SVector::<f64, 1>::new(start);
        let frame = Frame::assemble(&near, &estimate, 0.0, &settings).expect("regular");
        assert!((frame.q[0] - 0.02).abs() <= 1e-3, "{start}: {}", frame.q[0]);
    }
}

fn frame_at(time: f64) -> Result<Frame<f64, linkwright::nalgebra::Const<6>>, Failure> {
    let estimate = closed_form(time - 1e-3, 1.0);
    Frame::assemble(&Turning, &estimate, time, &Settings::default())
}

#[test]
fn level_rod_is_singular_and_a_nearly_level_one_is_as_exact_as_its_condition() {
    let failure = frame_at(DEAD_POINT).expect_err("the rod lies level");
    let FailureKind::Singular { column, .. } = failure.kind else {
        panic!("{failure}");
    };
    // The angle of the rod, or the height that follows from it.
    assert!(column == 5 || column == 4, "{failure}");
    for exponent in 1..=13 {
        let before = 10.0_f64.powi(-exponent);
        let time = DEAD_POINT - before;
        let frame = frame_at(time).unwrap_or_else(|failure| panic!("{before:e} before: {failure}"));
        // From the time as it is rounded; dφ2/dt is the condition. The residual may be 4 ε, and the angles, the sum and
        // the cosine in it are rounded.
        let expected = (2.0 * (DEAD_POINT - time) / 3.0_f64.sqrt()).sqrt();
        let expected = if before > 1e-5 {
            closed_form(time, 1.0)[5]
        } else {
            expected
        };
        let condition = 1.0 / (3.0_f64.sqrt() * expected);
        let error = (frame.q[5] - expected).abs();
        assert!(
            error <= 16.0 * f64::EPSILON * condition + expected.powi(3),
            "{before:e} before: {error:e}"
        );
    }
}

#[test]
fn single_precision_is_refused_at_its_own_rounding() {
    let settings = Settings::<f32>::default();
    let frame = |before: f64| {
        let estimate = closed_form(DEAD_POINT - before - 1e-2, 1.0).map(|x| x as f32);
        let time = (DEAD_POINT - before) as f32;
        Frame::assemble(&Turning, &estimate, time, &settings).map(|frame| (frame.q[5], time))
    };
    for before in [0.3, 0.1, 0.01, 1e-3, 1e-4] {
        let (angle, time) = frame(before).expect("regular");
        let expected = closed_form(f64::from(time), 1.0)[5];
        let error = (f64::from(angle) - expected).abs();
        let bound = 8.0 * f64::from(f32::EPSILON) / (3.0_f64.sqrt() * expected);
        assert!(error <= bound, "{before:e} before: {error:e}");
    }
    let failure = frame(0.0).expect_err("the rod lies level");
    assert!(is_singular(&failure), "{failure}");
}

#[test]
fn refused_frame_leaves_the_last_one_and_the_way_back() {
    let settings = Settings::default();
    let frame = frame_at(DEAD_POINT - 1e-4).expect("regular");
    let kept = frame;
    let failure = frame
        .advance(&Turning, DEAD_POINT, &settings)
        .expect_err("level");
    assert!(is_singular(&failure), "{failure}");
    assert_eq!(frame, kept);
    let back = frame
        .advance(&Turning, DEAD_POINT - 2e-4, &settings)
        .expect("regular");
    let expected = closed_form(DEAD_POINT - 2e-4, 1.0);
    assert!((back.q - expected).amax() <= 1e-12);
}
