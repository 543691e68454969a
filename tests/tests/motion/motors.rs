//! Motors of drivers: torque, speed and power at their shafts against closed forms, on both sides of zero power, and worst points.

use linkwright::{Blocks, FailureKind, Settings, Shell};
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::motors::MotorPoint;
use linkwright_solver::{Check, Instant, Interpreted, Numbers, Observable, Schedule, View};
use linkwright_tests::description;
use linkwright_tests::description::written;

/// An arm with a weight, which a geared motor swings.
const HOIST: &str = "mechanism hoist {
    param ratio = 50;
    param transmitted = 0.8;
    param rotor = 2e-5kg*m^2;
    point O = (0, 0);
    body arm at O { O, S: (0.2, 0) }
    revolute O(ground, arm);
    drive crank: phi(arm) = 0.9*sin(3*t);
    mass arm = 3kg at S inertia 0.02;
    gravity = (0, -9.81);
    motor crank gear ratio inertia rotor efficiency transmitted;
}";

/// A cage on a screw.
const LIFT: &str = "mechanism lift {
    body cage at (0, 0.5) { C: (0, 0) }
    absolute_x(cage) = 0;
    absolute_angle(cage) = 0;
    drive screw: y(cage) = 0.5m + 0.2m*sin(2*t);
    mass cage = 30kg;
    gravity = (0, -9.81);
    motor screw gear 2*pi/5mm inertia 1e-5kg*m^2 efficiency 0.4;
}";

/// Torque, speed and power of a motor at each instant of a motion.
fn points(derived: &Derived, driver: &str, mut each: impl FnMut(MotorPoint)) {
    let view = Interpreted::new(derived).expect("a motion");
    let measures = ["torque", "speed", "power"];
    let measures = measures.map(|it| {
        let name = format!("{driver}_motor_{it}");
        Observable::named(derived, &name).expect("a measure")
    });
    followed(&view, |view, instant| {
        let values = Observable::values(view, &measures, instant);
        each(MotorPoint {
            t: instant.t(),
            torque: values[0],
            speed: values[1],
            power: values[2],
        });
    });
}

fn followed(view: &Interpreted, mut each: impl FnMut(&Interpreted, &Instant)) {
    let mut shell = assembled(view, &view.nominal_parameters()).expect("the drawing assembles");
    let laws = view.input_laws();
    for step in 0..=300 {
        let t = 0.01 * f64::from(step);
        shell.advance(t, &laws.at(t)).expect("the motion goes on");
        each(view, shell.frame());
    }
}

fn assembled(
    view: &Interpreted,
    parameters: &Numbers,
) -> Result<Shell<Interpreted>, linkwright::Failure> {
    let (pose, modes) = (view.drawn_pose(parameters), view.drawn_branches());
    let inputs = view.input_laws().at(0.0);
    let settings = Settings::default();
    Shell::assemble(
        view.clone(),
        parameters,
        &pose,
        modes,
        0.0,
        &inputs,
        settings,
    )
}

/// Torque at a shaft: the load through the gear with its losses, and the rotor.
fn at_shaft(
    effort: f64,
    rate: f64,
    acceleration: f64,
    [gear, rotor, kept]: [f64; 3],
) -> MotorPoint {
    let load = match effort * rate < 0.0 {
        true => effort * kept / gear,
        false => effort / (kept * gear),
    };
    let torque = load + rotor * gear * acceleration;
    let speed = gear * rate;
    MotorPoint {
        t: 0.0,
        torque,
        speed,
        power: torque * speed,
    }
}

fn difference(own: MotorPoint, other: MotorPoint) -> f64 {
    let pairs = [
        (own.torque, other.torque),
        (own.speed, other.speed),
        (own.power, other.power),
    ];
    let differences = pairs.map(|(own, other)| (own - other).abs() / other.abs().max(1.0));
    differences.into_iter().fold(0.0, f64::max)
}

/// Motion of the arm: effort, rate and acceleration.
fn arm(t: f64) -> [f64; 3] {
    let (angle, rate) = (0.9 * (3.0 * t).sin(), 2.7 * (3.0 * t).cos());
    let acceleration = -8.1 * (3.0 * t).sin();
    let effort = (3.0 * 0.04 + 0.02) * acceleration + 3.0 * 9.81 * 0.2 * angle.cos();
    [effort, rate, acceleration]
}

#[test]
fn losses_of_a_gear_change_sides_with_the_power() {
    let (mut worst, mut sides) = (0.0_f64, [0; 2]);
    points(&written(HOIST), "crank", |point| {
        let [effort, rate, acceleration] = arm(point.t);
        let expected = at_shaft(effort, rate, acceleration, [50.0, 2e-5, 0.8]);
        worst = worst.max(difference(point, expected));
        sides[usize::from(effort * rate < 0.0)] += 1;
    });
    println!("{worst:e}, driving and driven: {sides:?}");
    assert!(worst < 1e-14 && sides.iter().all(|it| *it > 100));
}

#[test]
fn a_screw_turns_lengths_into_angles() {
    let gear = std::f64::consts::TAU / 0.005;
    let (mut worst, mut sides) = (0.0_f64, [0; 2]);
    points(&written(LIFT), "screw", |point| {
        let (rate, acceleration) = (0.4 * (2.0 * point.t).cos(), -0.8 * (2.0 * point.t).sin());
        let effort = 30.0 * (acceleration + 9.81);
        let expected = at_shaft(effort, rate, acceleration, [gear, 1e-5, 0.4]);
        worst = worst.max(difference(point, expected));
        sides[usize::from(effort * rate < 0.0)] += 1;
    });
    println!("{worst:e}, driving and driven: {sides:?}");
    assert!(worst < 1e-13 && sides.iter().all(|it| *it > 100));
}

#[test]
fn a_motor_without_clauses_is_its_driver() {
    let text = HOIST.replace("gear ratio inertia rotor efficiency transmitted", "");
    points(&written(&text), "crank", |point| {
        let [effort, rate, _] = arm(point.t);
        let expected = at_shaft(effort, rate, 0.0, [1.0, 0.0, 1.0]);
        assert!(difference(point, expected) < 1e-14);
    });
}

#[test]
fn worst_points_lie_between_frames_too() {
    let view = Interpreted::new(&written(LIFT)).expect("a motion");
    let schedule = Schedule::range(0.0, 1.5, 0.25).expect("a step");
    let check = Check::new(view, &schedule, |_| ());
    let [motor] = &check.measured.motors[..] else {
        panic!("one motor");
    };
    // P = G ẏ (F/(η G) + J G ÿ) while it lifts is a multiple of c (1 − a s) with c = cos 2t, s = sin 2t.
    let gear = std::f64::consts::TAU / 0.005;
    let weight = 30.0 * 9.81 / 0.4;
    let slope = 0.8 * (30.0 / 0.4 + 1e-5 * gear * gear) / weight;
    // d/dφ (cos φ − a sin φ cos φ) = 0 is 2 a s² − s − a = 0, for the root of a negative s.
    let sine = (1.0 - (1.0 + 8.0 * slope * slope).sqrt()) / (4.0 * slope);
    let phase = std::f64::consts::PI - sine.asin();
    let power = |phase: f64| 0.4 * phase.cos() * weight * (1.0 - slope * phase.sin());
    println!("{:?}, at phase {phase}", motor.power);
    assert_eq!(motor.driver, "screw");
    // The largest power of the range is at its start, and the largest torque too.
    assert!((motor.power.power - power(0.0)).abs() < 1e-11);
    assert_eq!((motor.torque.t, motor.speed.t), (0.0, 0.0));
    let schedule = Schedule::range(2.0, 3.5, 0.25).expect("a step");
    let view = Interpreted::new(&written(LIFT)).expect("a motion");
    let check = Check::new(view, &schedule, |_| ());
    let peak = check.measured.motors[0].power;
    let phase = std::f64::consts::TAU + sine.asin();
    println!("{peak:?}, expected {} at {}", power(phase), phase / 2.0);
    assert!((peak.power - power(phase)).abs() < 1e-11 * power(phase));
    assert!((peak.t - phase / 2.0).abs() < 1e-7);
    assert!((peak.power - peak.torque * peak.speed).abs() < 1e-12 * peak.power);
}

#[test]
fn a_motor_at_rest_holds_the_load() {
    let mut derived = written(HOIST);
    derived.system = derived.system.at_rest(&mut derived.pool);
    points(&derived, "crank", |point| {
        let load = 3.0 * 9.81 * 0.2 * (0.9 * (3.0 * point.t).sin()).cos();
        let expected = at_shaft(load, 0.0, 0.0, [50.0, 2e-5, 0.8]);
        assert!(difference(point, expected) < 1e-15);
    });
}

#[test]
fn parameters_of_impossible_motors_are_refused() {
    let view = Interpreted::new(&written(HOIST)).expect("a motion");
    let nominal = view.nominal_parameters();
    assert!(assembled(&view, &nominal).is_ok());
    // Ratio, efficiency, inertia of the rotor, and which of the values that must be positive is not.
    let refused = [
        ([0.0, 0.8, 2e-5], 0),
        ([-50.0, 0.8, 2e-5], 0),
        ([50.0, 0.0, 2e-5], 1),
        ([50.0, 1.01, 2e-5], 2),
        ([50.0, 0.8, -2e-5], 3),
    ];
    for (values, place) in refused {
        let parameters = Numbers(values.to_vec());
        let failure = assembled(&view, &parameters).expect_err("refused");
        let is_not_positive = matches!(failure.kind, FailureKind::NotPositive { .. });
        assert!(is_not_positive && failure.block == place, "{failure:?}");
    }
    for values in [[1e3, 1.0, 0.0], [1e-3, 1e-3, 1.0]] {
        assert!(assembled(&view, &Numbers(values.to_vec())).is_ok());
    }
}

#[test]
fn all_motors_of_a_mechanism_are_measured() {
    let derived = description::system("motorized_press");
    for driver in ["crank", "screw"] {
        let mut count = 0;
        points(&derived, driver, |point| {
            count += 1;
            let product = point.torque * point.speed;
            assert!((point.power - product).abs() <= 1e-13 * product.abs());
        });
        assert_eq!(count, 301);
    }
}
