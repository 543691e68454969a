//! Every kind of failure, provoked by one equation whose behavior under Newton-Raphson is known.

use crate::single::{Single, single};
use linkwright::generated::newton::{self, Convergence};
use linkwright::nalgebra::SVector;
use linkwright::{Failure, FailureKind, Frame, Settings};

/// Solves from `start`; a failure must leave the pose unchanged, bit for bit.
fn solve(
    equations: &Single,
    start: f64,
    settings: &Settings,
) -> Result<(f64, Convergence), Failure> {
    let mut q = SVector::<f64, 1>::new(start);
    match newton::solve(equations, &mut q, 0.25, settings) {
        Ok(convergence) => Ok((q[0], convergence)),
        Err(failure) => {
            assert_eq!(q[0].to_bits(), start.to_bits(), "the pose has moved");
            assert_eq!(failure.time.to_bits(), 0.25_f64.to_bits());
            Err(failure)
        }
    }
}

fn failure(equations: &Single, start: f64) -> Failure {
    solve(equations, start, &Settings::default()).expect_err("this iteration cannot succeed")
}

#[test]
fn vanishing_slope_is_singular() {
    let parabola = single(|x| x * x - 1.0, |x| 2.0 * x);
    let failure = failure(&parabola, 0.0);
    assert_eq!(
        failure.kind,
        FailureKind::Singular {
            pivot_ratio: 0.0,
            column: 0
        }
    );
    assert_eq!(
        (failure.iterations, failure.residual, failure.row),
        (0, 1.0, 0)
    );
    assert_eq!(
        failure.to_string(),
        "singular Jacobian: pivot ratio 0.0e0 at coordinate 0, t = 0.25"
    );
}

#[test]
fn oscillation_with_growing_residual_has_diverged() {
    // From beyond 1.39 the iterates of the arc tangent alternate and grow (1.5, -1.69, 2.32, -5.11, 32.3 …).
    let failure = failure(&single(f64::atan, |x| 1.0 / (1.0 + x * x)), 1.5);
    assert_eq!(failure.kind, FailureKind::Diverged);
    assert_eq!(failure.iterations, newton::GROWING_STEPS);
}

#[test]
fn very_long_step_has_diverged() {
    // The first step is 1 / (2 · 1e-7).
    let failure = failure(&single(|x| x * x - 1.0, |x| 2.0 * x), 1e-7);
    assert_eq!(
        (failure.kind, failure.iterations),
        (FailureKind::Diverged, 1)
    );
}

#[test]
fn very_large_residual_has_diverged() {
    // The first step is 3e5, which is not too long, but leads to a residual of 4e16.
    let failure = failure(&single(|x| x * x * x - 1.0, |x| 3.0 * x * x), 1e-3);
    assert_eq!(
        (failure.kind, failure.iterations),
        (FailureKind::Diverged, 1)
    );
    assert!(failure.residual > 1e16);
}

#[test]
fn poor_step_from_which_the_iteration_recovers_has_not_diverged() {
    // From 0.02 the first step leads to 25 and a residual of 624.
    let parabola = single(|x| x * x - 1.0, |x| 2.0 * x);
    let (x, convergence) = solve(&parabola, 0.02, &Settings::default()).expect("recovers");
    assert_eq!(x, 1.0);
    assert!(convergence.iterations > 5);
}

#[test]
fn cycle_of_two_is_found() {
    // The textbook example: 0 → 1 → 0 …
    let cubic = single(|x| x * x * x - 2.0 * x + 2.0, |x| 3.0 * x * x - 2.0);
    let failure = failure(&cubic, 0.0);
    assert_eq!(
        (failure.kind, failure.iterations),
        (FailureKind::Cycling, 2 + 1)
    );
    assert!(failure.residual >= 1.0);
}

#[test]
fn cycle_of_an_equation_without_solution_is_found() {
    // x² + 1 from 1/√3 alternates between ± 1/√3.
    let failure = failure(&single(|x| x * x + 1.0, |x| 2.0 * x), 1.0 / 3.0_f64.sqrt());
    assert_eq!(failure.kind, FailureKind::Cycling);
}

#[test]
fn longer_cycle_is_found() {
    // Steps of 1 from 0 to 4, then one of -4: 0 → 1 → 2 → 3 → 4 → 0 …, always with the residual 1.
    let ring = single(|_| 1.0, |x| if x < 4.0 { -1.0 } else { 0.25 });
    let failure = failure(&ring, 0.0);
    // The pose after 7 steps is the first that is kept for a whole cycle; it returns after 12.
    assert_eq!(
        (failure.kind, failure.iterations),
        (FailureKind::Cycling, 12)
    );
}

#[test]
fn residual_that_no_pose_can_lower_has_stalled() {
    // The squares of the two numbers next to √2 miss 2 by 4.4e-16 on either side.
    let parabola = single(|x| x * x - 2.0, |x| 2.0 * x);
    let settings = Settings {
        tolerance: 1e-16,
        ..Settings::default()
    };
    let failure = solve(&parabola, 1.0, &settings).expect_err("2 is not a square");
    assert_eq!(failure.kind, FailureKind::Stalled);
    assert_eq!(failure.residual, 2.0 * f64::EPSILON);
}

#[test]
fn slow_convergence_meets_the_iteration_limit() {
    // At a root of multiplicity 20 a step removes only a twentieth of the error.
    let flat = single(|x| x.powi(20), |x| 20.0 * x.powi(19));
    let settings = Settings {
        iterations: 4,
        ..Settings::default()
    };
    let failure = solve(&flat, 0.9, &settings).expect_err("four steps are too few");
    assert_eq!(
        (failure.kind, failure.iterations),
        (FailureKind::IterationLimit, 4)
    );
    assert_eq!(
        failure.to_string(),
        "iteration limit: scaled residual 2.0e-3 in equation 0 after 4 steps, t = 0.25"
    );
}

#[test]
fn no_iterations_allowed_still_accepts_a_solved_pose() {
    let settings = Settings {
        iterations: 0,
        ..Settings::default()
    };
    let line = single(|x| x - 2.0, |_| 1.0);
    assert!(solve(&line, 2.0, &settings).is_ok());
    let failure = solve(&line, 2.5, &settings).expect_err("no step is allowed");
    assert_eq!(
        (failure.kind, failure.iterations),
        (FailureKind::IterationLimit, 0)
    );
}

#[test]
fn infinite_and_undefined_numbers_are_reported() {
    let logarithm = single(f64::ln, |x| 1.0 / x);
    // The first step from 4 leads to 4 - 4 ln 4 < 0, where the logarithm is undefined.
    let failure_after = failure(&logarithm, 4.0);
    assert_eq!(
        (failure_after.kind, failure_after.iterations),
        (FailureKind::NotFinite, 1)
    );
    assert!(failure_after.residual.is_nan());
    for start in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0] {
        assert_eq!(failure(&logarithm, start).kind, FailureKind::NotFinite);
    }
    // The residual is fine, the slope is not.
    assert_eq!(
        failure(&single(|_| 1.0, |_| f64::NAN), 0.0).kind,
        FailureKind::NotFinite
    );
    assert_eq!(
        failure(&single(|_| 1.0, |_| f64::INFINITY), 0.0).kind,
        FailureKind::NotFinite
    );
    // A pose that is not finite is not hidden by an equation that ignores it.
    assert_eq!(
        failure(&single(|_| 0.0, |_| 1.0), f64::NAN).kind,
        FailureKind::NotFinite
    );
}

#[test]
fn time_that_is_not_finite_is_reported() {
    let mut q = SVector::<f64, 1>::new(2.0);
    let line = single(|x| x - 2.0, |_| 1.0);
    for t in [f64::NAN, f64::INFINITY] {
        let failure = newton::solve(&line, &mut q, t, &Settings::default()).expect_err("no time");
        assert_eq!(failure.kind, FailureKind::NotFinite);
        assert!(newton::step(&line, &q, t, &Settings::default()).is_err());
    }
}

#[test]
fn scale_that_is_no_magnitude_does_not_pass_for_solved() {
    // Measured against an infinite or a negative scale every residual would be small.
    for scale in [0.0, -1.0, f64::INFINITY, f64::NAN] {
        let line = single(|x| x - 2.0, |_| 1.0);
        let rows = Single {
            row_scale: scale,
            ..line
        };
        assert_eq!(failure(&rows, 5.0).kind, FailureKind::NotFinite);
        let line = single(|x| x - 2.0, |_| 1.0);
        let columns = Single {
            coordinate_scale: scale,
            ..line
        };
        assert_eq!(failure(&columns, 5.0).kind, FailureKind::NotFinite);
    }
}

#[test]
fn frame_with_an_undefined_velocity_or_acceleration_is_no_success() {
    let estimate = SVector::<f64, 1>::new(2.5);
    for (time_derivative, gamma) in [(f64::NAN, 0.0), (0.0, f64::INFINITY)] {
        let line = Single {
            time_derivative,
            gamma,
            ..single(|x| x - 2.0, |_| 1.0)
        };
        let failure =
            Frame::assemble(&line, &estimate, 0.0, &Settings::default()).expect_err("no velocity");
        assert_eq!(
            (failure.kind, failure.iterations),
            (FailureKind::NotFinite, 1)
        );
    }
}

#[test]
fn solved_pose_without_a_velocity_is_singular() {
    // The double root is found to the tolerance, but the slope there is zero.
    let parabola = single(|x| x * x, |x| 2.0 * x);
    let estimate = SVector::<f64, 1>::new(0.0);
    assert!(solve(&parabola, 0.0, &Settings::default()).is_ok());
    let failure =
        Frame::assemble(&parabola, &estimate, 0.0, &Settings::default()).expect_err("singular");
    assert!(matches!(
        failure.kind,
        FailureKind::Singular { column: 0, .. }
    ));
}

#[test]
fn polishing_removes_what_the_tolerance_left() {
    let parabola = single(|x| x * x - 2.0, |x| 2.0 * x);
    let coarse = Settings {
        tolerance: 1e-3,
        polish: false,
        ..Settings::default()
    };
    let (rough, without) = solve(&parabola, 1.0, &coarse).expect("converges");
    let (fine, with) = solve(
        &parabola,
        1.0,
        &Settings {
            polish: true,
            ..coarse
        },
    )
    .expect("converges");
    assert!(!without.polished && with.polished);
    // From 1e-3 one step with the older slope leaves more than rounding, so another one follows.
    assert_eq!(without.iterations + 1, with.iterations);
    let root = 2.0_f64.sqrt();
    assert!((rough - root).abs() > 1e-6 && (fine - root).abs() <= f64::EPSILON);
    assert_eq!(with.residual, (fine * fine - 2.0).abs());
    assert_eq!(without.residual, (rough * rough - 2.0).abs());
}

#[test]
fn polishing_step_that_makes_the_pose_worse_is_not_taken() {
    // The slope is wrong, so the step goes from a residual of 1e-13 to one of 1e-10.
    let misleading = single(|x| x - 1.0, |_| 1e-3);
    let start = 1.0 + 1e-13;
    let (x, convergence) =
        solve(&misleading, start, &Settings::default()).expect("solved as it is");
    assert_eq!(x.to_bits(), start.to_bits());
    assert!(!convergence.polished && convergence.residual <= 1e-12);
}

#[test]
fn every_kind_has_words() {
    let text = |kind| {
        let failure = Failure {
            kind,
            time: 2.0,
            block: 1,
            iterations: 3,
            residual: 0.25,
            row: 4,
            input: None,
        };
        failure.to_string()
    };
    let rest = "scaled residual 2.5e-1 in equation 4 after 3 steps, block 1, t = 2";
    for (kind, words) in [
        (FailureKind::Diverged, "diverged"),
        (FailureKind::Cycling, "cycling"),
        (FailureKind::Stalled, "stalled"),
        (FailureKind::IterationLimit, "iteration limit"),
        (FailureKind::WrongBranch, "wrong branch"),
        (FailureKind::StepTooLarge, "step too large"),
        (FailureKind::NotFinite, "not finite"),
    ] {
        assert_eq!(text(kind), format!("{words}: {rest}"));
    }
    let reach = text(FailureKind::OutOfReach { by: 0.5 });
    assert_eq!(reach, "out of reach by 5.0e-1 m, block 1, t = 2");
}

#[test]
fn failure_names_its_block() {
    let failure = failure(&single(|x| x * x - 1.0, |x| 2.0 * x), 0.0).in_block(3);
    assert_eq!(
        failure.to_string(),
        "singular Jacobian: pivot ratio 0.0e0 at coordinate 0, block 3, t = 0.25"
    );
    let source: &dyn core::error::Error = &failure;
    assert!(source.source().is_none());
}
