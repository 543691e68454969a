//! Joints marked `redundant`: the motion against its closed form, in both formulations, and the monitored equations.

use std::f64::consts::{FRAC_PI_2, PI};

use linkwright_codegen::stages::structure::Freedom;
use linkwright_tests::description;
use linkwright_tests::solver::{Interpreted, Solver};

mod three_cranks {
    linkwright::include_mechanism!(three_cranks);
}
mod coupled_wheels {
    linkwright::include_mechanism!(coupled_wheels);
}
mod parallel_sliders {
    linkwright::include_mechanism!(parallel_sliders);
}

/// Value with its rate and acceleration.
type Moving = [f64; 3];

fn constant(value: f64) -> Moving {
    [value, 0.0, 0.0]
}

/// r cos φ and r sin φ.
fn turned(radius: f64, angle: Moving) -> [Moving; 2] {
    let [phi, rate, acceleration] = angle;
    let (sine, cosine) = phi.sin_cos();
    [
        [
            radius * cosine,
            -radius * sine * rate,
            -radius * (cosine * rate * rate + sine * acceleration),
        ],
        [
            radius * sine,
            radius * cosine * rate,
            radius * (cosine * acceleration - sine * rate * rate),
        ],
    ]
}

/// Parallelogram with two cranks: all cranks turn alike and the coupler stays level.
fn parallelogram(t: f64) -> Vec<Moving> {
    let angle = [
        (4.0_f64).atan2(3.0) + 0.4 * (2.0 * t).sin(),
        0.8 * (2.0 * t).cos(),
        -1.6 * (2.0 * t).sin(),
    ];
    let [x, y] = turned(0.5, angle);
    let zero = constant(0.0);
    vec![
        zero,
        zero,
        angle,
        constant(1.0),
        zero,
        angle,
        constant(2.0),
        zero,
        angle,
        x,
        y,
        zero,
    ]
}

/// Table on one rail.
fn rail(t: f64) -> Vec<Moving> {
    let length = 1.25_f64.sqrt();
    let travel = [length + 0.3 * t.sin(), 0.3 * t.cos(), -0.3 * t.sin()];
    let along = |part: f64| travel.map(|value| value * part / length);
    vec![along(1.0), along(0.5), constant(0.0)]
}

fn assert_close(what: &str, t: f64, found: [&[f64]; 3], expected: &[Moving]) {
    for (order, values) in found.into_iter().enumerate() {
        assert_eq!(values.len(), expected.len());
        for (at, (value, expected)) in values.iter().zip(expected).enumerate() {
            let error = (value - expected[order]).abs();
            assert!(
                error <= 1e-13,
                "{what}: coordinate {at}, order {order} at {t}: {value}, not {}",
                expected[order]
            );
        }
    }
}

/// Checks the textbook formulation, from the description alone.
fn assert_textbook(name: &str, exact: fn(f64) -> Vec<Moving>) {
    let mut textbook = Interpreted::new(name);
    textbook.assemble(0.0);
    for step in 0..=200 {
        let t = f64::from(step) * 0.02;
        textbook.advance(t);
        let frame = textbook.frame();
        let levels = [&frame.q, &frame.qd, &frame.qdd].map(|values| values.as_slice());
        assert_close(name, t, levels, &exact(t));
    }
}

#[test]
fn three_cranks_move_as_two_do() {
    let mut mechanism = three_cranks::ThreeCranks::assemble(0.0).expect("assembles");
    for step in 0..=200 {
        let t = f64::from(step) * 0.02;
        let frame = *mechanism.advance(t).expect("regular");
        let levels = [frame.q, frame.qd, frame.qdd].map(|values| values.to_array());
        let [q, qd, qdd] = &levels;
        assert_close("three_cranks", t, [q, qd, qdd], &parallelogram(t));
        let [left] = three_cranks::monitored(&frame.q, t);
        assert!(left.abs() <= 1e-14, "{left} at {t}");
    }
    assert_textbook("three_cranks", parallelogram);
}

#[test]
fn a_table_between_two_rails_moves_as_on_one() {
    let mut mechanism = parallel_sliders::ParallelSliders::assemble(0.0).expect("assembles");
    for step in 0..=200 {
        let t = f64::from(step) * 0.02;
        let frame = *mechanism.advance(t).expect("regular");
        let levels = [frame.q, frame.qd, frame.qdd].map(|values| values.to_array());
        let [q, qd, qdd] = &levels;
        assert_close("parallel_sliders", t, [q, qd, qdd], &rail(t));
        for left in parallel_sliders::monitored(&frame.q, t) {
            assert!(left.abs() <= 1e-14, "{left} at {t}");
        }
    }
    assert_textbook("parallel_sliders", rail);
}

/// The monitored value is the equation itself: it shows a pose that only the solved equations allow.
#[test]
fn a_pose_off_the_redundant_equation_shows_in_it() {
    let mut mechanism = three_cranks::ThreeCranks::assemble(0.0).expect("assembles");
    let mut q = mechanism.advance(0.0).expect("regular").q;
    q.y3 += 0.25;
    let [left] = three_cranks::monitored(&q, 0.0);
    // Along the third crank, which rises by 4 in 5.
    assert!((left - 0.25 * 0.8).abs() <= 1e-14, "{left}");
}

/// 12 coordinates and 11 independent equations of joints; 3 and 2.
#[test]
fn degrees_of_freedom_are_counted_by_rank() {
    let count = |name| {
        let derived = description::system(name);
        Freedom::of(&derived.pool, &derived.system)
    };
    let expected = |redundant| Freedom {
        kinematic: 1,
        net: 0,
        redundant,
    };
    assert_eq!(count("three_cranks"), expected(1));
    assert_eq!(count("parallel_sliders"), expected(2));
    assert_eq!(count("two_body"), expected(0));
    let platform = count("platform_3rpr");
    assert_eq!((platform.kinematic, platform.net), (3, 0));
}

/// All wheels turn alike, with frames at the poses in which rod and cranks are collinear, beside them or beyond.
#[test]
fn coupled_wheels_turn_through_their_change_points() {
    use coupled_wheels::CoupledWheels;
    for step in [0.02, PI / 10.0, PI / 10.0 + 1e-7, 1.4, 2.0 * PI, 10.0] {
        let mut mechanism = CoupledWheels::assemble(0.0).expect("as drawn");
        for k in 1..=80 {
            let t = f64::from(k) * step;
            let frame = mechanism
                .advance(t)
                .unwrap_or_else(|failure| panic!("step {step}: {failure}"));
            let levels = [frame.q, frame.qd, frame.qdd].map(|values| values.to_array());
            for (order, values) in levels.iter().enumerate() {
                let turned = [FRAC_PI_2 + 0.5 * t, 0.5, 0.0][order];
                for wheel in 0..4 {
                    let error = (values[3 * wheel + 2] - turned).abs();
                    assert!(
                        error < 1e-8,
                        "step {step}, {t}: wheel {wheel}, order {order}: {error:e}"
                    );
                }
                assert!(
                    values[14].abs() < 1e-8,
                    "step {step}, {t}: rod, order {order}"
                );
            }
            for left in coupled_wheels::monitored(&frame.q, t) {
                assert!(left.abs() <= 1e-9, "{left} at {t}");
            }
        }
    }
}
