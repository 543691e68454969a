//! Mechanisms whose friction has a closed form.

use linkwright::{Blocks, FailureKind};
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::{Interpreted, Schedule};
use linkwright_tests::description::written;

use super::{followed, solved};

/// Block that a cylinder moves on an incline.
fn incline(mu: f64, slope: f64, motion: &str) -> Derived {
    written(&format!(
        "mechanism incline {{
            point O = (0, 0), T = ({}, {});
            body block at T {{ B: (0, 0) }}
            translational rail (ground, block) along O -> B;
            drive push: length(O, B) = {motion};
            mass block = 10kg;
            gravity = (0, -9.81);
            friction rail = {mu};
            energy;
        }}",
        0.5 * slope.cos(),
        0.5 * slope.sin()
    ))
}

#[test]
fn a_block_on_an_incline_takes_its_weight_and_friction() {
    for (mu, slope) in [(0.2, 0.35), (0.4, 0.35), (0.05, -0.6), (0.0, 0.35)] {
        let columns = solved(&incline(mu, slope, "0.5m + 0.1*sin(2*t)"), 3.0);
        let names = [
            "effort_push",
            "friction_rail",
            "frictionless_power",
            "backward_power",
        ];
        let (mut worst, mut count) = (0.0_f64, 0);
        columns.each(&names, |instant, values| {
            let t = instant.t();
            let (rate, acceleration) = (0.2 * (2.0 * t).cos(), -0.4 * (2.0 * t).sin());
            let rubs = mu * 98.1 * slope.cos() * rate.signum();
            let alone = 98.1 * slope.sin() + 10.0 * acceleration;
            let expected = [alone + rubs, -rubs, alone * rate, (alone - rubs) * rate];
            for (value, expected) in values.iter().zip(expected) {
                worst = worst.max((value - expected).abs());
                count += 1;
            }
        });
        println!("mu {mu}, slope {slope}: {worst:e} in {count} values");
        assert!(worst < 1e-12 && count == 404);
    }
}

#[test]
fn a_block_locks_itself_where_friction_exceeds_the_slope() {
    // So slow that no inertia matters: 0.35 rad locks itself with mu > tan 0.35 = 0.365.
    for (mu, locks) in [(0.36, false), (0.37, true)] {
        let derived = incline(mu, 0.35, "0.5m + 0.01*t");
        let view = Interpreted::new(&derived).expect("a motion");
        let schedule = Schedule::range(0.0, 2.0, 0.5).expect("a step");
        let check = linkwright_solver::Check::new(view, &schedule, |_| ());
        let losses = check.losses.expect("friction");
        let expected = if locks { vec![[0.0, 2.0]] } else { Vec::new() };
        assert_eq!(losses.locked(), expected);
        // The efficiency is tan a / (tan a + mu).
        let efficiency = 0.35_f64.tan() / (0.35_f64.tan() + mu);
        let [work, without] = losses.driving;
        assert!((without / work - efficiency).abs() < 1e-14);
        assert!((losses.lowest.expect("it drives").efficiency - efficiency).abs() < 1e-14);
        assert!((without - 98.1 * 0.35_f64.sin() * 0.02).abs() < 1e-14);
    }
}

#[test]
fn a_lever_turns_on_its_friction_circle() {
    let derived = written(
        "mechanism lever {
            point O = (0, 0);
            body arm at O { O, S: (0.2, 0) }
            revolute O(ground, arm);
            drive crank: phi(arm) = 0.9*sin(3*t);
            mass arm = 3kg at S inertia 0.02;
            gravity = (0, -9.81);
            friction O = 0.3 radius 15mm;
            reaction O;
        }",
    );
    let names = ["effort_crank", "friction_o", "reaction_o_x", "reaction_o_y"];
    let (mut worst, mut signs) = (0.0_f64, [0; 2]);
    solved(&derived, 2.0).each(&names, |instant, values| {
        let t = instant.t();
        let phi = 0.9 * (3.0 * t).sin();
        let (rate, spin) = (2.7 * (3.0 * t).cos(), -8.1 * (3.0 * t).sin());
        // m (a − g) in the pin, and the weight and the inertia about it.
        let x = 3.0 * 0.2 * (-spin * phi.sin() - rate * rate * phi.cos());
        let y = 3.0 * (0.2 * (spin * phi.cos() - rate * rate * phi.sin()) + 9.81);
        let rubs = 0.3 * 0.015 * x.hypot(y) * rate.signum();
        let effort = (0.02 + 3.0 * 0.04) * spin + 3.0 * 9.81 * 0.2 * phi.cos() + rubs;
        for (value, expected) in values.iter().zip([effort, -rubs, x, y]) {
            worst = worst.max((value - expected).abs());
        }
        signs[usize::from(rate > 0.0)] += 1;
    });
    println!("{worst:e}, turning back and forth: {signs:?}");
    assert!(worst < 1e-12 && signs.iter().all(|it| *it > 20));
}

/// A wedge under a weight, all on plain slides: P = W (tan (a + f) + tan f) with the angle of friction f.
fn wedge(mu: f64, angle: f64) -> Derived {
    written(&format!(
        "mechanism wedge {{
            point O = (0, 0);
            body wedge at (1, 0) {{ B: (0, 0), P: (0, 0), R: ({}, {}) }}
            body weight at (1, 0) {{ Q: (0, 0) }}
            absolute_x(weight) = 1;
            absolute_angle(weight) = 0;
            translational floor (ground, wedge) along O -> B;
            point_on_line slope (weight.Q, wedge) along P -> R;
            drive push: length(O, B) = 1m - 0.1m*cos(t);
            force on weight.Q = (0, -100N);
            friction floor = {mu};
            friction slope = {mu};
        }}",
        angle.cos(),
        -angle.sin()
    ))
}

#[test]
fn a_wedge_lifts_by_the_angle_of_friction() {
    for (mu, angle) in [(0.1, 0.2), (0.2, 0.5), (0.3, 1.1), (0.15, 1.35)] {
        let columns = solved(&wedge(mu, angle), 6.0);
        let friction = mu.atan();
        let (mut worst, mut count, mut rests) = (0.0_f64, [0; 2], 0);
        let names = ["effort_push", "frictionless_power", "backward_power"];
        columns.each(&names, |instant, values| {
            let rate = 0.1 * instant.t().sin();
            if rate == 0.0 {
                rests += 1;
                return;
            }
            let force = |sign: f64| {
                let friction = sign * friction;
                100.0 * ((angle + friction).tan() + friction.tan())
            };
            let lifts = if rate > 0.0 { 1.0 } else { -1.0 };
            let expected = [force(lifts), force(0.0) * rate, force(-lifts) * rate];
            for (value, expected) in values.iter().zip(expected) {
                worst = worst.max((value - expected).abs() / expected.abs().max(1.0));
            }
            count[usize::from(lifts > 0.0)] += 1;
        });
        println!("mu {mu}, angle {angle}: {worst:e}, {count:?}");
        assert!(worst < 1e-12 && count.iter().all(|it| *it > 40) && rests <= 1);
    }
}

#[test]
fn a_steep_wedge_jams() {
    // Beyond a + f = 90°, no force lifts the weight.
    let view = Interpreted::new(&wedge(0.3, 1.4)).expect("a motion");
    let (columns, failure) = followed(&view, None, 6.0);
    // At rest, at first, nothing slides.
    assert_eq!(columns.rows.len(), 1);
    let failure = failure.expect("it jams");
    let FailureKind::FrictionUnsettled { change } = failure.kind else {
        panic!("{failure:?}");
    };
    assert!(change > 1e-10);
    let message = view.explained(&failure).to_string();
    assert!(
        message.contains("the forces of friction do not settle"),
        "{message}"
    );
}

#[test]
fn a_drawer_is_held_by_the_edges_of_its_guide() {
    // A load at the distance e from the line: the moment F e over the length L presses both ends.
    let derived = written(
        "mechanism drawer {
            point O = (0, 0);
            body drawer at (0.5, 0) { B: (0, 0), K: (0, 0.15) }
            translational rail (ground, drawer) along O -> B;
            drive pull: length(O, B) = 0.5m + 0.1*sin(2*t);
            force on drawer.K = (-80N, 0);
            friction rail = 0.25 over 0.2m;
            reaction rail;
        }",
    );
    let names = ["effort_pull", "friction_rail", "reaction_rail_moment"];
    solved(&derived, 3.0).each(&names, |instant, values| {
        let sign = (2.0 * instant.t()).cos().signum();
        let rubs = 0.25 * 2.0 * (80.0 * 0.15 / 0.2) * sign;
        for (value, expected) in values.iter().zip([80.0 + rubs, -rubs, -12.0]) {
            assert!(
                (value - expected).abs() < 1e-12,
                "{value}, expected {expected}"
            );
        }
    });
}
