//! `advance` gives frames of the smooth path, or fails.

use std::f64::consts::{FRAC_PI_2, PI};

use linkwright::{Failure, FailureKind, Settings};
use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::read;
use linkwright_solver::{Interpreted, View};
use linkwright_tests::description;
use linkwright_tests::values::{assembled_with, levels};

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

/// Steps from thousandths of a turn to several turns.
const STEPS: [f64; 8] = [0.0037, 0.01, 0.1, 0.3, 0.9, 1.8, 2.7, 7.0];

/// Steps that hit change points.
const HITS: [f64; 4] = [PI / 64.0, PI / 6.0, FRAC_PI_2, 1.5 * PI];

#[test]
fn a_parallelogram_stays_one_through_its_change_points() {
    for h in STEPS.into_iter().chain(HITS) {
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

/// Parallelogram with cranks of 0.4 times the given coupler, estimated at 60° to a turned ground.
fn slanted(coupler: f64, turned: f64) -> String {
    let crank = 0.4 * coupler;
    let along = |length: f64, angle: f64| [length * angle.cos(), length * angle.sin()];
    let [dx, dy] = along(coupler, turned);
    let [bx, by] = along(crank, turned + PI / 3.0);
    let [first, second] = [turned + PI / 3.0, turned];
    format!(
        "mechanism slanted {{
            point A = (0, 0), D = ({dx:?}, {dy:?});
            body crank at (0, 0, {first:?}) {{ A: (0, 0), B: ({crank:?}, 0) }}
            body coupler at ({bx:?}, {by:?}, {second:?}) {{ B: (0, 0), C: ({coupler:?}, 0) }}
            body follower at ({dx:?}, {dy:?}, {first:?}) {{ D: (0, 0), C: ({crank:?}, 0) }}
            revolute A(ground, crank);
            revolute B(crank, coupler);
            revolute C(coupler, follower);
            revolute D(ground, follower);
            drive phi(crank) = {first:?} + t;
        }}"
    )
}

/// The bend of a path in metres must not hide its branch, which differs in angles alone.
#[test]
fn parallelograms_of_all_sizes_are_driven_through() {
    for (coupler, turned) in [
        (1e-4, 0.0),
        (0.5, 1.1),
        (30.0, -2.0),
        (500.0, 0.0),
        (1e5, 0.7),
    ] {
        let text = slanted(coupler, turned);
        let derived = read(&Source::new("slanted.mech", text)).expect("no errors");
        let interpreted = Interpreted::new(&derived.only().expect("one motion"));
        let interpreted = interpreted.expect("its blocks");
        let (laws, settings) = (interpreted.input_laws(), Settings::default());
        for h in STEPS {
            let mut mechanism =
                assembled_with(interpreted.clone(), &[], 0.0, &laws.at(0.0), settings)
                    .expect("as drawn");
            for step in 1..=60 {
                let t = h * f64::from(step);
                let frame = mechanism.advance(t, &laws.at(t));
                let frame = frame
                    .unwrap_or_else(|failure| panic!("{coupler} m, step {h} to {t}: {failure}"));
                let [q, qd, qdd] = levels(&interpreted, frame);
                let off = [
                    q[5] - turned,
                    q[8] - (turned + PI / 3.0 + t),
                    qd[5],
                    qd[8] - 1.0,
                    qdd[5],
                    qdd[8],
                ];
                assert!(
                    off.iter().all(|it| it.abs() < 1e-8),
                    "{coupler} m, step {h} to {t}: {off:?}"
                );
            }
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
            // A failure is allowed; a pose of the other branch is not.
            if mechanism.advance(h * f64::from(step)).is_err() {
                break;
            }
            assert_eq!(mechanism.branches(), branches, "step {h}");
        }
    }
}

#[test]
fn a_gap_is_not_stepped_over() {
    // Coupler and crank are collinear where |AC| is their difference, 80 mm: the angle at D is then acos 0.625.
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

/// Steps from an instant until the path ends, in generated code and by the interpreter, which must end alike; returns
/// the failure.
fn end_from(start: f64, step: f64, interpreted: &Interpreted) -> Failure {
    let mut generated = RockerLimit::assemble(start).expect("the links reach");
    let (laws, settings) = (interpreted.input_laws(), Settings::default());
    let inputs_now = laws.at(start);
    let mut same = assembled_with(interpreted.clone(), &[], start, &inputs_now, settings)
        .expect("the links reach");
    for count in 1..=4000 {
        let t = start + step * f64::from(count);
        let moved = generated.advance(t).map(|frame| frame.t);
        let also = same.advance(t, &laws.at(t)).map(|frame| frame.t());
        match (moved, also) {
            (Ok(moved), Ok(also)) => assert_eq!(moved, also),
            (Err(moved), Err(also)) => {
                assert_eq!(moved, also, "from {start} by {step}");
                return moved;
            }
            (moved, also) => panic!("from {start} by {step} to {t}: {moved:?}, {also:?}"),
        }
    }
    panic!("from {start} by {step}: it does not end");
}

#[test]
fn a_gap_ends_paths_from_both_sides() {
    let derived = read(&description::source("rocker_limit"));
    let derived = derived.expect("no errors").only().expect("one motion");
    let interpreted = Interpreted::new(&derived).expect("its blocks");
    let first = ((PI - 0.625_f64.acos() - 70_f64.to_radians()) / 60_f64.to_radians()).asin();
    let last = PI - first;
    // They are collinear again where |AC| is their sum, 160 mm.
    let other = ((70_f64.to_radians() - 0.575_f64.acos()) / 60_f64.to_radians()).asin();
    for h in [
        0.001, 0.01, 0.1, 0.3, 0.7, 1.0, 1.3, 1.8, 2.0, 2.4, 4.0, 6.0,
    ] {
        for (start, step, end) in [
            (0.0, h, first),
            (1.2, h, first),
            (2.5, -h, last),
            (1.9, -h, last),
            (2.5, h, PI + other),
            (0.0, -h, -other),
        ] {
            let failure = end_from(start, step, &interpreted);
            assert!(
                (failure.time - end).abs() < 1e-8,
                "from {start} by {step}: {failure}, not {end}"
            );
        }
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
