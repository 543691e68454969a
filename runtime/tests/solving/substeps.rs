//! Division of a motion into steps, with attempts whose failures are known.

use linkwright::generated::{Broken, in_steps};
use linkwright::{Failure, FailureKind};

fn failure(kind: FailureKind, time: f64) -> Failure {
    Failure {
        kind,
        time,
        block: 2,
        iterations: 3,
        residual: 0.5,
        row: 1,
        input: None,
    }
}

/// Moves at most `longest` at once, and never to `barrier` or beyond; gives the outcome and the times that were tried.
fn move_to(
    to: f64,
    budget: u16,
    longest: f64,
    barrier: f64,
    kind: FailureKind,
) -> (Result<u16, Broken>, Vec<f64>) {
    let mut tried = Vec::new();
    let mut at = 0.0;
    let outcome = in_steps(0.0, to, budget, |target: f64| {
        tried.push(target);
        if target.abs() >= barrier {
            return Err(failure(kind, target));
        }
        if (target - at).abs() > longest {
            return Err(failure(FailureKind::StepTooLarge, target));
        }
        at = target;
        Ok(())
    });
    (outcome, tried)
}

#[test]
fn a_free_way_takes_one_attempt() {
    let (outcome, tried) = move_to(5.0, 32, 9.0, f64::INFINITY, FailureKind::Diverged);
    assert_eq!((outcome, tried), (Ok(1), vec![5.0]));
    let (outcome, tried) = move_to(0.0, 32, 9.0, f64::INFINITY, FailureKind::Diverged);
    assert_eq!((outcome, tried), (Ok(1), vec![0.0]));
}

#[test]
fn a_long_way_is_halved_and_then_walked() {
    let (outcome, tried) = move_to(-4.0, 32, 1.0, f64::INFINITY, FailureKind::Diverged);
    // After two successes a double step is tried, in vain.
    let expected = [-4.0, -2.0, -1.0, -2.0, -4.0, -3.0, -4.0];
    assert_eq!((outcome, tried), (Ok(7), expected.to_vec()));
}

#[test]
fn a_barrier_is_found_to_two_attempts_per_bit() {
    for kind in [
        FailureKind::WrongBranch,
        FailureKind::Singular {
            pivot_ratio: 1e-15,
            column: 3,
        },
    ] {
        for barrier in [0.1, 0.7, 1.0 / 3.0, 0.999] {
            let (outcome, tried) = move_to(1.0, 80, 2.0, barrier, kind);
            let broken = outcome.expect_err("a barrier");
            assert_eq!((broken.failure.kind, tried.len()), (kind, 80));
            assert!(broken.reached < barrier && barrier <= broken.failure.time);
            let bracket = broken.failure.time - broken.reached;
            assert!(bracket <= 2.0 * 2.0_f64.powi(-40), "{bracket:e}");
            // All else is that of the last failure.
            assert_eq!(broken.failure, failure(kind, broken.failure.time));
        }
    }
}

#[test]
fn the_search_ends_where_times_can_no_longer_be_told_apart() {
    let (outcome, tried) = move_to(1.0, u16::MAX, 2.0, 0.3, FailureKind::WrongBranch);
    let broken = outcome.expect_err("a barrier");
    assert!(tried.len() < 150, "{}", tried.len());
    assert!(broken.failure.time - broken.reached <= f64::EPSILON);
}

#[test]
fn verdicts_from_afar_are_not_final() {
    for kind in [FailureKind::WrongBranch, FailureKind::NotFinite] {
        let (outcome, _) = move_to(1.0, 3, 2.0, 0.01, kind);
        let broken = outcome.expect_err("a barrier");
        assert_eq!(broken.failure.kind, FailureKind::StepTooLarge);
        assert_eq!((broken.reached, broken.failure.time), (0.0, 0.25));
    }
    // Links that do not reach leave no doubt.
    let reach = FailureKind::OutOfReach { by: 0.5 };
    let (outcome, _) = move_to(1.0, 3, 2.0, 0.01, reach);
    assert_eq!(outcome.expect_err("a barrier").failure.kind, reach);
    for kind in [
        FailureKind::Diverged,
        FailureKind::Cycling,
        FailureKind::Stalled,
        FailureKind::IterationLimit,
    ] {
        let (outcome, _) = move_to(1.0, 90, 2.0, 0.3, kind);
        let broken = outcome.expect_err("a barrier");
        assert_eq!(broken.failure.kind, FailureKind::StepTooLarge);
    }
}

#[test]
fn a_budget_that_ends_on_a_free_way_says_how_far_it_went() {
    let (outcome, tried) = move_to(64.0, 12, 1.0, f64::INFINITY, FailureKind::Diverged);
    let broken = outcome.expect_err("too far");
    assert_eq!(tried.len(), 12);
    assert_eq!(broken.failure.kind, FailureKind::StepTooLarge);
    assert!(broken.reached >= 2.0 && broken.failure.time >= broken.reached);
}

#[test]
fn no_budget_is_one_attempt_and_no_number_is_tried_once() {
    let (outcome, tried) = move_to(2.0, 0, 1.0, f64::INFINITY, FailureKind::Diverged);
    assert!(outcome.is_err());
    assert_eq!(tried, [2.0]);
    for to in [f64::NAN, f64::INFINITY] {
        let mut attempts = 0;
        let broken = in_steps(0.0, to, 32, |target: f64| {
            attempts += 1;
            Err(failure(FailureKind::NotFinite, target))
        })
        .expect_err("no time");
        assert_eq!((attempts, broken.reached), (1, 0.0));
        assert_eq!(broken.failure.kind, FailureKind::NotFinite);
    }
}

#[test]
fn the_end_of_reach_is_found_to_rounding_and_nothing_beyond_is_tried_twice() {
    // What is missing grows like a cosine from its zero at `end`; from the other side the links may have reached before.
    let ways: [(f64, f64, f64); 5] = [
        (0.7, 0.0, 1.0),
        (0.1, 0.0, 1.5),
        (0.999, 0.0, 1.0),
        (-3.0, 2.0, -3.5),
        (1e-6, 0.0, 1.0),
    ];
    for (end, from, to) in ways {
        let direction = (to - from).signum();
        let mut tried = Vec::new();
        let outcome = in_steps(from, to, 32, |t| {
            tried.push(t);
            let by = (direction * (t - end)).sin() * 0.5 + (t - end).powi(2);
            if direction * (t - end) <= 0.0 {
                return Ok(());
            }
            Err(failure(FailureKind::OutOfReach { by }, t))
        });
        let failure = outcome.expect_err("the links end").failure;
        assert!(matches!(failure.kind, FailureKind::OutOfReach { .. }));
        let beyond = direction * (failure.time - end);
        assert!((0.0..1e-14).contains(&beyond), "{beyond:e} {tried:?}");
    }
}

#[test]
fn links_in_line_at_the_end_of_reach_say_what_is_missing_beyond() {
    let outcome = in_steps(0.0, 1.0, 32, |t: f64| {
        let by = t - 0.4;
        match by {
            ..=-1e-15 => Ok(()),
            ..1e-13 => Err(failure(
                FailureKind::Singular {
                    pivot_ratio: 0.0,
                    column: 0,
                },
                t,
            )),
            _ => Err(failure(FailureKind::OutOfReach { by }, t)),
        }
    });
    let failure = outcome.expect_err("the links end").failure;
    assert_eq!(failure.kind, FailureKind::OutOfReach { by: 0.6 });
    assert!((failure.time - 0.4).abs() < 1e-13);
}
