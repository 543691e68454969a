//! `advance` gives frames of the smooth path, or fails.

use std::f64::consts::{FRAC_PI_2, PI};

use linkwright::FailureKind;

mod parallelogram {
    linkwright::include_mechanism!(parallelogram);
}
mod parallelogram_unguarded {
    linkwright::include_mechanism!(parallelogram_unguarded);
}
mod kite {
    linkwright::include_mechanism!(kite);
}
mod rocker_limit {
    linkwright::include_mechanism!(rocker_limit);
}

use kite::Kite;
use parallelogram::Parallelogram;
use parallelogram_unguarded::ParallelogramUnguarded;
use rocker_limit::RockerLimit;

/// Steps from thousandths of a turn to several turns, none of which hits a change point.
const STEPS: [f64; 8] = [0.0037, 0.01, 0.1, 0.3, 0.9, 1.8, 2.7, 7.0];

#[test]
fn a_parallelogram_stays_one_through_its_change_points() {
    for h in STEPS {
        let mut mechanism = Parallelogram::assemble(0.0).expect("as drawn");
        for step in 1..=60 {
            let t = h * f64::from(step);
            let frame = mechanism
                .advance(t)
                .unwrap_or_else(|failure| panic!("step {h}: {failure}"));
            let off = [
                frame.q.phi_a - (FRAC_PI_2 + t),
                frame.q.phi_b,
                frame.q.phi_c - (FRAC_PI_2 + t),
            ];
            assert!(
                off.iter().all(|it| it.abs() < 1e-9),
                "step {h} to {t}: {off:?}"
            );
        }
    }
}

#[test]
fn without_a_guard_it_turns_into_an_antiparallelogram() {
    let mut mechanism = ParallelogramUnguarded::assemble(0.0).expect("as drawn");
    let coupler = mechanism.advance(1.8).expect("the links reach").q.phi_b;
    assert!(coupler.abs() > 0.1, "{coupler}");
}

#[test]
fn modes_that_only_come_close_are_not_exchanged() {
    for h in STEPS {
        let mut mechanism = Kite::assemble(0.0).expect("as drawn");
        let branches = mechanism.branches();
        for step in 1..=60 {
            // A failure is an answer; a pose of the other mode is none.
            if mechanism.advance(h * f64::from(step)).is_err() {
                break;
            }
            assert_eq!(mechanism.branches(), branches, "step {h}");
        }
    }
}

#[test]
fn a_gap_is_not_stepped_over() {
    // Coupler and crank are in line where |AC| is their difference, 80 mm: the angle at D is then acos 0.625.
    let end = ((PI - 0.625_f64.acos() - 70_f64.to_radians()) / 60_f64.to_radians()).asin();
    for h in [0.01, 0.3, 1.0, 1.8, 2.0, 2.5, 4.0, 6.0] {
        let mut mechanism = RockerLimit::assemble(0.0).expect("as drawn");
        let failure = (1..=2000)
            .find_map(|step| mechanism.advance(h * f64::from(step)).err())
            .expect("it ends");
        assert!(
            (failure.time - end).abs() < 1e-8,
            "step {h}: {failure}, not {end}"
        );
        assert!(
            matches!(
                failure.kind,
                FailureKind::OutOfReach { .. }
                    | FailureKind::Singular { .. }
                    | FailureKind::StepTooLarge
            ),
            "step {h}: {failure}"
        );
        assert!(mechanism.frame().t < end);
    }
}

#[test]
fn a_frame_at_any_instant_needs_no_path() {
    let mut mechanism = RockerLimit::assemble(0.0).expect("as drawn");
    let beyond = mechanism.frame_at(2.5).expect("the links reach again");
    assert_eq!(beyond.t, 2.5);
    let rocker = 70_f64.to_radians() + 60_f64.to_radians() * 2.5_f64.sin();
    assert!((beyond.q.phi_rocker - rocker).abs() < 1e-15);
    // Nothing has moved.
    assert_eq!(mechanism.frame().t, 0.0);
    assert!(mechanism.advance(0.1).is_ok());
}
