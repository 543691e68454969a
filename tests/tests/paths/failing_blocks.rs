//! Failures of Newton-Raphson itself, in both formulations of generated mechanisms: the data of a failure, the last
//! frame, which is intact after it, and the continuation of the motion.

use linkwright::generated::newton;
use linkwright::nalgebra::SVector;
use linkwright::{Failure, FailureKind, Frame, Settings};

#[allow(dead_code)]
mod cubic_slider {
    linkwright::include_mechanism!(cubic_slider);
}

#[allow(dead_code)]
mod square_slider {
    linkwright::include_mechanism!(square_slider);
}

use cubic_slider::CubicSlider;
use square_slider::SquareSlider;

/// Design configuration with the slider elsewhere.
fn textbook_at(x: f64) -> SVector<f64, 3> {
    SVector::from([x, 0.0, 0.0])
}

/// Time after 0 for which the slider is predicted at about `x`: 1 + t/2 − t²/8 = x.
fn predicted_at(x: f64) -> f64 {
    2.0 + (12.0 - 8.0 * x).sqrt()
}

fn one_attempt() -> Settings {
    Settings {
        substeps: 1,
        ..Settings::default()
    }
}

/// Cycle 0 → 1 → 0: the third step is the first that can be compared with a stored pose.
#[test]
fn the_textbook_view_cycles() {
    let settings = Settings::default();
    let equations = cubic_slider::Textbook;
    let failure =
        Frame::assemble(&equations, &textbook_at(0.0), 0.0, &settings).expect_err("a cycle");
    assert_eq!(failure.kind, FailureKind::Cycling);
    assert_eq!(
        (failure.block, failure.time, failure.iterations),
        (0, 0.0, 3)
    );
    assert!(failure.residual >= 0.5, "{failure}");
    assert!(Frame::assemble(&equations, &textbook_at(-1.7), 0.0, &settings).is_ok());
}

/// Near the level tangent the first step is longer than a million times the mechanism.
#[test]
fn the_textbook_view_diverges() {
    let settings = Settings::default();
    let equations = square_slider::Textbook;
    let start = Frame::assemble(&equations, &textbook_at(1.0), 0.0, &settings).expect("as drawn");
    let before = start;
    let t = predicted_at(1e-7);
    let failure = start
        .advance(&equations, t, &settings)
        .expect_err("the step is too long");
    assert_eq!(failure.kind, FailureKind::Diverged);
    assert_eq!((failure.block, failure.time, failure.iterations), (0, t, 1));
    assert!(failure.residual > newton::LARGEST_GROWTH, "{failure}");
    assert_eq!(start, before, "the last frame is intact");
    let next = start
        .advance(&equations, 0.1, &settings)
        .expect("a short step");
    assert!((next.q[0] - 1.1_f64.sqrt()).abs() < 1e-15);
}

/// One attempt of the solved formulation from there: the failure names the block, the time and the step, and shorter
/// steps continue.
#[test]
fn a_block_diverges_where_one_attempt_is_all_it_has() {
    let (estimate, modes) = (
        square_slider::Coordinates::DESIGN,
        square_slider::Branches::DESIGN,
    );
    let with =
        |settings| SquareSlider::assemble_with(&estimate, modes, 0.0, settings).expect("as drawn");
    let mut mechanism = with(one_attempt());
    let (before, t) = (*mechanism.frame(), predicted_at(1e-7));
    let failure = mechanism.advance(t).expect_err("the step is too long");
    assert_eq!(failure.kind, FailureKind::Diverged, "{failure}");
    assert_eq!((failure.block, failure.time, failure.iterations), (1, t, 1));
    assert!(failure.residual > newton::LARGEST_GROWTH, "{failure}");
    let text = square_slider::describe(&failure).to_string();
    let expected = "equation 1: Newton-Raphson diverges, after 1 iteration with";
    assert!(text.starts_with(expected), "{text}");
    assert_eq!(*mechanism.frame(), before, "the last frame is intact");
    mechanism.advance(0.1).expect("a short step");
    // With the default number of attempts, substeps cover the whole step.
    let mut mechanism = with(Settings::default());
    let frame = mechanism.advance(t).expect("in several steps");
    assert!((frame.q.x1 - (1.0 + t).sqrt()).abs() < 1e-14);
}

/// A motion cannot make a block of the solved formulation cycle. Each of its steps is at most half the one before, so
/// that all following ones together are shorter than it, and no pose returns to within rounding. From the estimate
/// that cycles in the textbook formulation the block is assembled after least squares, which arrive next to the pose
/// with the level tangent. The residual has a local minimum there, and the next step diverges. Plain Newton-Raphson,
/// which is tried next, cycles, and damped Newton-Raphson stops at the level tangent. The report gives the end of the
/// first attempt.
#[test]
fn a_block_does_not_cycle() {
    let modes = cubic_slider::Branches::DESIGN;
    let estimate = cubic_slider::Coordinates {
        x1: 0.0,
        ..cubic_slider::Coordinates::DESIGN
    };
    let assembled =
        CubicSlider::assemble_with(&estimate, modes, 0.0, Settings::default()).map(|_| ());
    let failure = assembled.expect_err("the estimate is on the far side of a level tangent");
    assert_eq!(failure.kind, FailureKind::Diverged);
    assert_eq!(
        (failure.block, failure.time, failure.iterations),
        (1, 0.0, 1)
    );
    assert!(failure.residual > newton::LARGEST_GROWTH, "{failure}");
    // Steps of a motion, short and far too long ones.
    let mut kinds: Vec<FailureKind> = Vec::new();
    for hundredth in 1..=1000_u16 {
        let mut mechanism = CubicSlider::assemble_with(
            &cubic_slider::Coordinates::DESIGN,
            modes,
            0.0,
            one_attempt(),
        )
        .expect("as drawn");
        let (before, t) = (*mechanism.frame(), f64::from(hundredth) / 100.0);
        match mechanism.advance(t) {
            Ok(frame) => {
                let x = frame.q.x1;
                let sine = (3.0 * t).sin();
                let residual = x * x * x - 2.0 * x + 2.0 + 2.0 * sine * sine;
                assert!(residual.abs() < 1e-11 && x < -1.7, "{x} at {t}");
            }
            Err(failure) => {
                kinds.push(failure.kind);
                assert_eq!(failure.block, 1);
                assert_eq!(*mechanism.frame(), before, "the last frame is intact");
                mechanism.advance(0.01).expect("a short step");
            }
        }
    }
    println!("refused in one attempt: {} of 1000", kinds.len());
    assert!(!kinds.is_empty());
    assert!(!kinds.contains(&FailureKind::Cycling), "{kinds:?}");
}

/// The iteration limit and a stall, with their messages, if the settings are too tight.
#[test]
fn a_block_reports_its_iterations_and_its_residual() {
    let (estimate, modes) = (
        square_slider::Coordinates::DESIGN,
        square_slider::Branches::DESIGN,
    );
    let few = Settings {
        iterations: 1,
        ..one_attempt()
    };
    let good = SquareSlider::assemble_with(&estimate, modes, 0.0, few).expect("it is drawn there");
    let fails = |mut mechanism: SquareSlider, t: f64| -> Failure {
        let before = *mechanism.frame();
        let failure = mechanism
            .advance(t)
            .expect_err("the settings cannot be met");
        assert_eq!(*mechanism.frame(), before, "the last frame is intact");
        failure
    };
    let failure = fails(good, 1.0);
    assert_eq!(failure.kind, FailureKind::IterationLimit);
    assert_eq!((failure.block, failure.iterations), (1, 1));
    assert!(1e-12 < failure.residual && failure.residual < 1.0);
    let text = square_slider::describe(&failure).to_string();
    assert!(
        text.contains("after 1 iteration with a scaled residual of"),
        "{text}"
    );
    let mut good = good;
    good.advance(1e-9).expect("a short step");
}

/// Every other kind in the textbook formulation, each from the same frame, which continues afterwards.
#[test]
fn the_textbook_view_goes_on_after_every_failure() {
    let (settings, equations) = (Settings::default(), square_slider::Textbook);
    let start = Frame::assemble(&equations, &textbook_at(1.0), 0.0, &settings).expect("as drawn");
    let branch = Frame::branch_of(&equations, &start.q, 0.0, &settings).expect("a regular pose");
    let few = Settings {
        iterations: 1,
        ..settings
    };
    // No float is the root of 2.
    let exact = Settings {
        tolerance: 0.0,
        ..settings
    };
    let strict = Settings {
        pivot_ratio: 2.0,
        ..settings
    };
    let moved = |settings: &Settings, t| start.advance(&equations, t, settings).map(|_| ());
    let followed =
        |branch, settings: &Settings, t| start.follow(&equations, branch, t, settings).map(|_| ());
    let end = predicted_at(0.1);
    let failures = [
        ("limit", moved(&few, 1.0)),
        ("stalled", moved(&exact, 1.0)),
        ("singular", moved(&strict, 1.0)),
        ("not finite", moved(&settings, f64::NAN)),
        ("branch", followed(branch.opposite(), &settings, 0.1)),
        ("step", followed(branch, &one_attempt(), end)),
    ];
    for (what, result) in failures {
        let failure = result.expect_err(what);
        let as_said = match what {
            "limit" => failure.kind == FailureKind::IterationLimit && failure.iterations == 1,
            "stalled" => failure.kind == FailureKind::Stalled && failure.residual < 1e-15,
            "singular" => matches!(failure.kind, FailureKind::Singular { .. }),
            "not finite" => failure.kind == FailureKind::NotFinite && failure.time.is_nan(),
            "branch" => failure.kind == FailureKind::WrongBranch,
            _ => failure.kind == FailureKind::StepTooLarge && failure.time <= end,
        };
        assert!(as_said && failure.block == 0, "{what}: {failure:?}");
        let next = start
            .advance(&equations, 0.1, &settings)
            .expect("a short step");
        assert!((next.q[0] - 1.1_f64.sqrt()).abs() < 1e-15);
    }
}
