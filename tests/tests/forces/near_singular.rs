//! Motions past poses in which loops are nearly singular, against all coordinates integrated with multipliers and quadrature of the energy integral.

use linkwright_solver::{Simulation, Stop};
use linkwright_tests::simulated::{coordinate, energy, options, simulation};

/// Moves a simulation to angles of its crank at times, which were found by DOP853 with multipliers at 1e-12 and by t = ∫ sqrt(M/2E) dφ.
fn passes(simulation: &mut Simulation, angles: &[(f64, f64)]) {
    for &(t, expected) in angles {
        simulation.advance(t).expect("no end");
        let [angle, _] = coordinate(simulation, "phi_crank");
        assert!((angle - expected).abs() <= 1e-7, "{t}: {angle}");
    }
}

/// A crank-rocker whose links nearly fold onto one line.
const ROCKER: &str = "mechanism near_change_rocker {
    point A = (0, 0), D = (1.2, 0);
    body crank at (0, 0, 60deg) { A: (0, 0), B: (0.35, 0) }
    body coupler at (0.175, 0.303, 25deg) { B: (0, 0), C: (0.85, 0), S: (0.425, 0) }
    body rocker at (1.2, 0, 110deg) { D: (0, 0), C: (0.702, 0) }
    revolute A(ground, crank);
    revolute B(crank, coupler);
    revolute C(coupler, rocker);
    revolute D(ground, rocker);
    free turn: phi(crank) = 60deg rate 4;
    mass crank = 1kg at B inertia 0.05;
    mass coupler = 0.8kg at S inertia 0.06;
    mass rocker = 1.5kg at C inertia 0.02;
    energy;
}";

#[test]
fn a_rocker_that_nearly_folds_keeps_its_motion() {
    for relative in [1e-10, 1e-12] {
        let mut rocker = simulation(ROCKER, 5.0, options(relative));
        passes(
            &mut rocker,
            &[
                (0.5, 2.587_629_860),
                (1.0, 4.476_550_914),
                (2.0, 8.101_530_379),
                (3.0, 11.594_011_937),
                (5.0, 18.600_905_209),
            ],
        );
        assert!((energy(&rocker) - 2.346_657_811_24).abs() <= 1e-8);
    }
}

/// A five-bar with two free cranks, each pushed by a constant torque.
const FIVE_BAR: &str = "mechanism five_bar_folds {
    point A = (0, 0), E = (0.6, 0);
    body left  at (0, 0, 70deg)      { A: (0, 0), B: (0.33, 0) }
    body upper at (0, 0.33, 45deg)    { B: (0, 0), C: (0.55, 0) }
    body lower at (0.6, 0.33, 135deg) { D: (0, 0), C: (0.55, 0) }
    body right at (0.6, 0, 45deg)   { E: (0, 0), D: (0.33, 0) }
    revolute A(ground, left);
    revolute B(left, upper);
    revolute C(upper, lower);
    revolute D(lower, right);
    revolute E(ground, right);
    free one: phi(left) = 70deg;
    free two: phi(right) = 45deg;
    mass left = 1kg at B inertia 0.02;
    mass upper = 0.5kg at C inertia 0.01;
    mass right = 1kg at D inertia 0.02;
    torque on left = 0.1Nm;
    torque on right = -1.6Nm;
    energy;
}";

/// What is called free is singular on the way, where the upper and the lower link are in line; the mechanism is not.
#[test]
fn a_five_bar_folds_and_goes_on() {
    let mut folds = simulation(FIVE_BAR, 1.1, options(1e-11));
    folds.advance(1.1).expect("no end");
    let found = ["phi_left", "phi_right"].map(|name| coordinate(&folds, name)[0]);
    // All 12 coordinates integrated with multipliers at 1e-12.
    assert!((found[0] - 0.376_470_1).abs() <= 1e-6, "{found:?}");
    assert!((found[1] + 3.494_677_4).abs() <= 1e-6, "{found:?}");
    let upper = coordinate(&folds, "phi_upper")[0] - coordinate(&folds, "phi_lower")[0];
    assert!((upper.sin() - 0.032_79).abs() <= 1e-4, "{upper}");
}

/// A slider-crank whose rod is longer than its crank by half a hundredth.
const SLIDER: &str = "mechanism near_dead_slider {
    point A = (0, 0);
    body crank at (0, 0, 40deg) { A: (0, 0), B: (0.2, 0), S: (0.1, 0) }
    body rod at (0.1532, 0.1286, -39.8deg) { B: (0, 0), C: (0.201, 0) }
    body slider at (0.3077, 0) { C: (0, 0) }
    revolute A(ground, crank);
    revolute B(crank, rod);
    revolute C(rod, slider);
    absolute_y(slider) = 0;
    absolute_angle(slider) = 0;
    free turn: phi(crank) = 40deg rate 12;
    mass crank = 1.2kg at S inertia 0.01;
    mass slider = 2.5kg;
    energy;
}";

#[test]
fn a_slider_that_nearly_stands_still_keeps_its_motion() {
    let mut slider = simulation(SLIDER, 2.0, options(1e-10));
    passes(
        &mut slider,
        &[
            (1.4, 25.839_656_634),
            (1.6, 29.998_858_557),
            (1.8, 32.615_145_886),
            (2.0, 36.723_693_739),
        ],
    );
    let [_, rate] = coordinate(&slider, "phi_crank");
    assert!((rate - 9.575_248_320).abs() <= 1e-6, "{rate}");
    assert!((energy(&slider) - 13.383_319_706_2).abs() <= 1e-7);
}

/// Another five-bar, whose energy is what its torques have worked.
const GAINING: &str = "mechanism five_bar_gains {
    point A = (0, 0), E = (0.48, 0);
    body left at (0, 0, 135deg) { A: (0, 0), B: (0.3, 0) }
    body upper at (0, 0.3, 45deg) { B: (0, 0), C: (0.45, 0) }
    body lower at (0.48, 0.3, 135deg) { D: (0, 0), C: (0.45, 0) }
    body right at (0.48, 0, 105deg) { E: (0, 0), D: (0.3, 0) }
    revolute A(ground, left);
    revolute B(left, upper);
    revolute C(upper, lower);
    revolute D(lower, right);
    revolute E(ground, right);
    free one: phi(left) = 135deg;
    free two: phi(right) = 105deg;
    mass left = 1kg at B inertia 0.02;
    mass upper = 0.5kg at C inertia 0.01;
    mass right = 1kg at D inertia 0.02;
    torque on left = -0.5Nm;
    torque on right = 0.04Nm;
    energy;
}";

#[test]
fn a_five_bar_gains_what_its_torques_work() {
    let mut gains = simulation(GAINING, 1.2, options(1e-10));
    gains.advance(1.2).expect("no end");
    let found = ["phi_left", "phi_right"].map(|name| coordinate(&gains, name)[0]);
    // All 12 coordinates integrated with multipliers at 1e-12.
    assert!((found[0] - 0.633_502_2).abs() <= 1e-6, "{found:?}");
    assert!((found[1] - 2.442_418_7).abs() <= 1e-6, "{found:?}");
    let work = gains.added_work().expect("on the step");
    assert!((energy(&gains) - 0.885_739_1).abs() <= 1e-6);
    assert!((work - 0.885_739_1).abs() <= 1e-6, "{work}");
}

/// Equal cranks, whose coupler is longer than the distance of their pivots by this.
fn cranks(longer: f64) -> String {
    let right = 1.1 + longer;
    format!(
        "mechanism cranks {{
            point A = (0, 0), D = (1, 0), B = (0.1, 0.4), C = ({right:?}, 0.4);
            body crank at A facing A -> B {{ A, B }}
            body coupler at B facing B -> C {{ B, C }}
            body rocker at D facing D -> C {{ D, C }}
            revolute A(ground, crank);
            revolute B(crank, coupler);
            revolute C(coupler, rocker);
            revolute D(ground, rocker);
            free turn: phi(crank) = atan2(0.4, 0.1) rate 4;
            mass crank = 1kg at B;
            mass rocker = 1kg at C;
            energy;
        }}"
    )
}

/// A parallelogram turns at one speed, through all poses in which it could become an antiparallelogram.
#[test]
fn a_parallelogram_stays_one() {
    for relative in [1e-6, 1e-8, 1e-10, 1e-12] {
        let mut crossing = simulation(&cranks(0.0), 5.0, options(relative));
        for step in 1..=100 {
            let t = 0.05 * f64::from(step);
            crossing.advance(t).expect("no end");
            let [angle, rate] = coordinate(&crossing, "phi_crank");
            let missed = [angle - 0.4_f64.atan2(0.1) - 4.0 * t, rate - 4.0];
            let allowed = 1e3 * relative + 1e-9;
            assert!(
                missed.iter().all(|it| it.abs() <= allowed),
                "{t}: {missed:?}"
            );
            let [coupler, _] = coordinate(&crossing, "phi_coupler");
            assert!(coupler.abs() <= allowed, "{t}: {coupler}");
        }
        assert_eq!(crossing.passed().len(), 6, "{relative}");
    }
}

/// Branches that do not meet are not crossed, however close they come.
#[test]
fn branches_with_a_gap_are_not_crossed() {
    for longer in [1e-3, 1e-5] {
        let mut turning = simulation(&cranks(longer), 2.0, options(1e-10));
        let first = energy(&turning);
        turning.advance(2.0).expect("no end");
        assert!(turning.passed().is_empty(), "{:?}", turning.passed());
        assert!((energy(&turning) - first).abs() <= 1e-7 * first);
    }
}

/// With a tolerance that shows nothing of the motion, the balance of the energy ends it.
#[test]
fn a_motion_that_loses_its_energy_ends() {
    let mut rocker = simulation(ROCKER, 5.0, options(1e-2));
    let stop = rocker.advance(5.0).expect_err("out of balance");
    assert!(matches!(stop, Stop::Unbalanced { .. }), "{stop:?}");
    let said = stop.explained(rocker.view(), rocker.frame());
    assert!(
        said.contains("the energy is out of balance at t = "),
        "{said}"
    );
}
