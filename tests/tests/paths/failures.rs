//! Ways in which generated mechanisms fail in the solved view. The runtime's own tests provoke every kind on small equations.

use linkwright::{FailureKind, Settings};
use linkwright_mechanisms::platform_3rpr::{self, Platform3rpr};
use linkwright_mechanisms::stephenson::{self, Branches, Coordinates, Stephenson};

mod folding {
    linkwright::include_mechanism!(folding);
}

fn with(settings: Settings) -> Result<Stephenson, linkwright::Failure> {
    // A drawing that is off by a tenth of a radian.
    let mut estimate = Coordinates::DESIGN;
    estimate.phi_coupler += 0.1;
    Stephenson::assemble_with(&estimate, Branches::DESIGN, 0.0, settings)
}

#[test]
fn failures_of_iterated_loops_name_the_loop() {
    let good = Settings::default();
    let iterations = Settings {
        iterations: 0,
        ..good
    };
    let stalled = Settings {
        tolerance: 0.0,
        ..good
    };
    let singular = Settings {
        pivot_ratio: 2.0,
        ..good
    };
    for (settings, said) in [
        (iterations, "loop B-C-E: Newton-Raphson does not converge"),
        (stalled, "loop B-C-E: Newton-Raphson "),
        (singular, "loop B-C-E: "),
    ] {
        let failure = with(settings).expect_err("the settings cannot be met");
        assert_eq!((failure.block, failure.time), (1, 0.0));
        let text = stephenson::describe(&failure).to_string();
        println!("{:?}: {text}", failure.kind);
        assert!(
            text.starts_with(said) && text.ends_with(", at t = 0 s"),
            "{text}"
        );
    }
    let kind = |settings| with(settings).expect_err("the settings cannot be met").kind;
    assert_eq!(kind(iterations), FailureKind::IterationLimit);
    assert!(matches!(
        kind(stalled),
        FailureKind::Stalled | FailureKind::Cycling
    ));
    assert!(matches!(kind(singular), FailureKind::Singular { .. }));
    assert!(with(good).is_ok());
}

#[test]
fn a_mode_that_is_too_far_from_the_estimate_is_a_wrong_branch() {
    let drawn = Platform3rpr::assemble(0.0).expect("as drawn").branches();
    let mut other = drawn;
    other.loop_p_row_q_r = drawn.loop_p_row_q_r.map(linkwright::Branch::opposite);
    let failure = Platform3rpr::assemble_on(other, 0.0).expect_err("it is far away");
    assert_eq!(failure.kind, FailureKind::WrongBranch);
    let text = platform_3rpr::describe(&failure).to_string();
    assert!(
        text.starts_with("loop P-Q-R: only another assembly mode is found"),
        "{text}"
    );
}

#[test]
fn a_step_that_a_small_budget_does_not_cover_is_too_large() {
    let small = Settings {
        substeps: 2,
        ..Settings::default()
    };
    let mut mechanism = with(small).expect("as drawn");
    let before = *mechanism.frame();
    let mut refused = 0;
    for t in 1..100_u8 {
        let mut there = mechanism;
        if let Err(failure) = there.advance(f64::from(t)) {
            assert_eq!(failure.kind, FailureKind::StepTooLarge, "{failure}");
            assert!(0.0 < failure.time && failure.time <= f64::from(t));
            assert_eq!(*there.frame(), before, "the last frame is intact");
            there.advance(0.01).expect("a short step");
            refused += 1;
        }
    }
    println!("refused of 99: {refused}");
    assert!(refused > 0);
    mechanism.advance(0.01).expect("a short step");
}

#[test]
fn with_one_attempt_a_failure_is_that_of_the_whole_step() {
    let one = Settings {
        substeps: 1,
        ..Settings::default()
    };
    let estimate = folding::Coordinates::DESIGN;
    let modes = folding::Branches::DESIGN;
    let mut mechanism =
        folding::Folding::assemble_with(&estimate, modes, 0.5, one).expect("the drawing assembles");
    let failure = mechanism.advance(2.0).expect_err("the rod is too short");
    assert_eq!(failure.time, 2.0);
    let FailureKind::OutOfReach { by } = failure.kind else {
        panic!("{failure}")
    };
    // The pin is √3 − cos t from the line, and the rod is √3 long.
    assert!((by + 2.0_f64.cos()).abs() < 1e-15);
    for t in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert_eq!(
            mechanism.advance(t).expect_err("no time").kind,
            FailureKind::NotFinite
        );
    }
}

#[test]
fn a_time_that_is_no_number_is_not_finite() {
    let mut mechanism = Stephenson::assemble(0.0).expect("as drawn");
    for t in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let failure = mechanism.advance(t).expect_err("no time");
        assert_eq!(failure.kind, FailureKind::NotFinite, "{t}");
    }
    mechanism.advance(0.01).expect("a short step");
}
