//! Quantities of `measure` statements: against closed forms of a slider-crank, statics by hand, differences in time, and the textbook
//! formulation.

use std::f64::consts::{PI, TAU};

use linkwright::{Settings, Shell};
use linkwright_solver::{Check, Dense, Instant, Interpreted, Observable, Schedule, View};
use linkwright_tests::description;
use linkwright_tests::description::written;

/// Crank, rod (m), offset (rad) and rate (rad/s) of the described slider-cranks.
const CRANK: f64 = 0.03;
const ROD: f64 = 0.1;
const START: f64 = 0.3;
const RATE: f64 = 4.0;

/// Instants of a motion as solved, with a view of them.
fn followed<V: View>(view: &V, times: &[f64], mut each: impl FnMut(&V, &Instant)) {
    let (parameters, laws) = (view.nominal_parameters(), view.input_laws());
    let (pose, modes) = (view.drawn_pose(&parameters), view.drawn_branches());
    let (start, settings) = (times[0], Settings::default());
    let inputs = laws.at(start);
    let shell = Shell::assemble(
        view.clone(),
        &parameters,
        &pose,
        modes,
        start,
        &inputs,
        settings,
    );
    let mut shell = shell.expect("the design configuration assembles");
    for &t in times {
        shell.advance(t, &laws.at(t)).expect("the motion goes on");
        each(view, shell.frame());
    }
}

fn times() -> Vec<f64> {
    (0..=200).map(|step| 0.01 * f64::from(step)).collect()
}

#[test]
fn strokes_and_their_rates_are_those_of_the_closed_form() {
    let text = std::fs::read_to_string("descriptions/measured_output.mech").expect("a description");
    let derived =
        written(&text.replace("output stroke, approach;", "measure jolt = rate(approach);"));
    let view = Interpreted::new(&derived).expect("a motion");
    let names = ["stroke", "approach", "jolt"];
    let measures = names.map(|name| Observable::named(&derived, name).expect("a measure"));
    let columns = linkwright_solver::derivatives::names(&derived.system);
    let slope = |name: &str| {
        let columns = columns
            .iter()
            .position(|it| it.0 == format!("{name} per l"));
        columns.expect("a column")
    };
    let slopes = [slope("stroke"), slope("approach")];
    let mut worst = [0.0_f64; 5];
    followed(&view, &times(), |view, instant| {
        let phi = START + RATE * instant.t();
        // x = r cos φ + √(l² − r² sin² φ), with w for the root and d/dφ of all.
        let root = (ROD * ROD - (CRANK * phi.sin()).powi(2)).sqrt();
        let of_root = first(phi) + CRANK * phi.sin();
        let expected = [
            x(phi),
            RATE * first(phi),
            RATE * RATE * second(phi),
            ROD / root,
            -RATE * of_root * ROD / (root * root),
        ];
        let mut values = Observable::values(view, &measures, instant);
        let derivatives = view.derivatives(instant).expect("regular");
        values.extend(slopes.map(|it| derivatives[it]));
        for ((worst, value), expected) in worst.iter_mut().zip(values).zip(expected) {
            *worst = worst.max((value - expected).abs() / expected.abs().max(1.0));
        }
    });
    println!("stroke, rate, acceleration, both by the rod: {worst:?}");
    assert!(worst.iter().all(|it| *it < 2e-15), "{worst:?}");
}

#[test]
fn forces_of_a_press_are_those_of_statics() {
    let derived = written(
        "mechanism press {
            point O = (0, 0);
            body crank at O { O, A: (30mm, 0) }
            body rod at (30mm, 0) { A: (0, 0), B: (100mm, 0) }
            body ram at (130mm, 0) { B: (0, 0) }
            revolute O(ground, crank);
            revolute A(crank, rod);
            revolute B(rod, ram);
            translational guide (ground, ram) along O -> B;
            force on ram.B = (-500N, 0);
            drive motor: phi(crank) = 0.3 + 4*t;
            measure pin = magnitude(reaction(B));
            measure side = y(reaction(guide));
            measure along = x(reaction(guide));
            measure torque = effort(motor);
            measure supplied = power(motor);
        }",
    );
    let view = Interpreted::new(&derived).expect("a motion");
    let names = ["pin", "side", "along", "torque", "supplied"];
    let measures = names.map(|name| Observable::named(&derived, name).expect("a measure"));
    let mut worst = [0.0_f64; 5];
    followed(&view, &times(), |view, instant| {
        let phi = START + RATE * instant.t();
        let slant = (CRANK * phi.sin() / ROD).asin();
        // The rod carries a force along itself; virtual work gives the torque.
        let load = 500.0;
        let torque = -load * (CRANK * phi.sin() + CRANK * phi.cos() * slant.tan());
        let expected = [
            load / slant.cos(),
            load * slant.tan(),
            0.0,
            torque,
            torque * RATE,
        ];
        let values = Observable::values(view, &measures, instant);
        for ((worst, value), expected) in worst.iter_mut().zip(values).zip(expected) {
            *worst = worst.max((value - expected).abs());
        }
    });
    println!("pin, side, along, torque, power: {worst:?}");
    assert!(worst.iter().all(|it| *it < 1e-12 * 500.0), "{worst:?}");
}

#[test]
fn springs_and_dampers_are_measured_as_they_act() {
    let derived = description::system("measured_press");
    let view = Interpreted::new(&derived).expect("a motion");
    let names = [
        "spring_length",
        "spring_pull",
        "spring_work",
        "drag",
        "winding",
        "slant",
        "approach",
    ];
    let measures = names.map(|name| Observable::named(&derived, name).expect("a measure"));
    let mut worst = 0.0_f64;
    followed(&view, &times(), |view, instant| {
        let values = Observable::values(view, &measures, instant);
        let [length, pull, work, drag, winding, slant, approach] = values[..] else {
            panic!("seven values");
        };
        // The cylinder moves the ram as its law says, and the tool is 20 mm beyond the pin of the spring.
        let driven = 0.1 + 0.02 * (4.0 * instant.t() + 0.3).cos();
        let longer = driven - 0.09;
        let expected = [
            (length, driven),
            (pull, 400.0 * longer),
            (work, 200.0 * longer * longer),
            (drag, 3.0 * approach),
            (winding, 0.2 * (slant + 50_f64.to_radians()) + 0.1),
        ];
        for (value, expected) in expected {
            worst = worst.max((value - expected).abs());
        }
    });
    println!("springs and dampers: {worst:e}");
    assert!(worst < 1e-14, "{worst:e}");
}

#[test]
fn rates_of_measures_are_their_changes_in_time() {
    let derived = description::system("measured_press");
    let view = Interpreted::new(&derived).expect("a motion");
    let names = ["stroke", "approach", "jolt"];
    let measures = names.map(|name| Observable::named(&derived, name).expect("a measure"));
    let step = 1e-4;
    let times: Vec<f64> = (0..400).map(|it| step * f64::from(it)).collect();
    let mut rows: Vec<Vec<f64>> = Vec::new();
    followed(&view, &times, |view, instant| {
        rows.push(Observable::values(view, &measures, instant));
    });
    let mut worst = [0.0_f64; 2];
    for around in rows.windows(3) {
        for (level, worst) in worst.iter_mut().enumerate() {
            let change = (around[2][level] - around[0][level]) / (2.0 * step);
            *worst = worst.max((change - around[1][level + 1]).abs());
        }
    }
    println!("differences in time: {worst:?}");
    // h²/6 times the third derivative: at most 20 mm (4/s)³ = 1.3 m/s³ of the stroke, and 5.1 m/s⁴ of its rate.
    assert!(worst.iter().all(|it| *it < step * step), "{worst:?}");
}

#[test]
fn both_formulations_measure_alike() {
    for name in ["measured_press", "measured_output"] {
        let derived = description::system(name);
        let (solved, dense) = (Interpreted::new(&derived), Dense::new(&derived));
        let solved = solved.expect("a motion");
        let mut rows = Vec::new();
        followed(&solved, &times(), |view, instant| {
            rows.push([view.reported(instant), view.derivatives(instant)]);
        });
        let mut rows = rows.into_iter();
        let (mut worst, mut compared) = (0.0_f64, 0);
        followed(&dense, &times(), |view, instant| {
            let others = rows.next().expect("as many instants");
            let values = [view.reported(instant), view.derivatives(instant)];
            for (own, other) in values.into_iter().zip(others) {
                let (own, other) = (own.expect("regular"), other.expect("regular"));
                assert_eq!(own.len(), other.len());
                for (own, other) in own.iter().zip(other) {
                    worst = worst.max((own - other).abs() / own.abs().max(1.0));
                    compared += 1;
                }
            }
        });
        println!("{name}: {worst:e} in {compared} values");
        assert!(worst < 1e-12 && compared > 1000, "{name}: {worst:e}");
    }
}

#[test]
fn extremes_and_broken_limits_are_those_of_the_closed_form() {
    let text = std::fs::read_to_string("descriptions/measured_output.mech").expect("a description");
    let (low, high) = (0.0700001, 0.129);
    let limit = format!("limit stroke from {low}m to {high}m;");
    let derived = written(&text.replace("output stroke, approach;", &limit));
    let view = Interpreted::new(&derived).expect("a motion");
    // The lower end is broken between two frames alone, and the first and the last frame are within both ends.
    let schedule = Schedule::range(0.0, 1.0, 0.25).expect("a step");
    let check = Check::new(view, &schedule, |_| ());
    let [stroke, approach, _] = &check.measured.ranges[..] else {
        panic!("three measures");
    };
    assert!((stroke.smallest.value - (ROD - CRANK)).abs() < 1e-15);
    assert!((stroke.smallest.t - (PI - START) / RATE).abs() < 1e-7);
    let ends = [0.0, 1.0].map(|t| x(START + RATE * t));
    assert!((stroke.largest.value - ends[0].max(ends[1])).abs() < 1e-15);
    // The fastest approach is where d²x/dφ² = 0; its value by bisection of the closed form.
    let (mut before, mut after) = (1.0, 1.6);
    for _ in 0..60 {
        let middle = 0.5 * (before + after);
        match second(middle) < 0.0 {
            true => before = middle,
            false => after = middle,
        }
    }
    assert!((approach.smallest.value - RATE * first(before)).abs() < 1e-14);
    let [broken] = &check.measured.broken[..] else {
        panic!("one limit");
    };
    let [[from, to]] = broken.intervals[..] else {
        panic!("one interval: {:?}", broken.intervals);
    };
    // x(φ) = low, from the law of cosines: l² = r² + x² − 2 r x cos φ.
    let cosine = (CRANK * CRANK + low * low - ROD * ROD) / (2.0 * CRANK * low);
    let [expected_from, expected_to] = [cosine.acos(), TAU - cosine.acos()];
    println!("{from} to {to}, worst {:?}", broken.worst);
    assert!((from - (expected_from - START) / RATE).abs() < 1e-11);
    assert!((to - (expected_to - START) / RATE).abs() < 1e-11);
    assert!((broken.worst.value - (ROD - CRANK)).abs() < 1e-15);
}

/// Coupler and rocker of a four-bar enclose the angle of the law of cosines, which is folded beyond a right angle. Its proven bounds hold
/// where the magnitudes in it pass zero.
#[test]
fn transmission_angles_are_those_of_the_law_of_cosines() {
    let derived = written(
        "mechanism four_bar {
            point A = (0, 0), D = (100mm, 0);
            body crank   at (0, 0, 40deg)       { A: (0, 0), B: (40mm, 0) }
            body coupler at (30mm, 25mm, 20deg) { B: (0, 0), C: (100mm, 0) }
            body rocker  at (100mm, 0, 57deg)   { D: (0, 0), C: (70mm, 0) }
            revolute A(ground, crank);
            revolute B(crank, coupler);
            revolute C(coupler, rocker);
            revolute D(ground, rocker);
            drive phi(crank) = 40deg + 3*t;
            measure mu = transmission_angle(B, C, D);
            limit mu >= 36deg;
        }",
    );
    let angle = |phi: f64| {
        let square = 0.1_f64.powi(2) + 0.04_f64.powi(2) - 0.008 * phi.cos();
        let cosine = (0.1_f64.powi(2) + 0.07_f64.powi(2) - square) / 0.014;
        cosine.abs().acos()
    };
    let view = Interpreted::new(&derived).expect("a motion");
    let mu = Observable::named(&derived, "mu").expect("a measure");
    let times: Vec<f64> = (0..=210).map(|step| 0.01 * f64::from(step)).collect();
    let mut worst = 0.0_f64;
    followed(&view, &times, |view, instant| {
        let value = Observable::values(view, &[mu], instant)[0];
        worst = worst.max((value - angle(40_f64.to_radians() + 3.0 * instant.t())).abs());
    });
    println!("{worst:e}");
    // Near a right angle, the arc cosine of a magnitude near zero keeps its digits.
    assert!(worst < 1e-13, "{worst:e}");
    let schedule = Schedule::whole(0.0, 2.1, 0.01).expect("a range");
    let check = Check::new(view, &schedule, |_| ());
    let proof = check.prove(&schedule, &[]);
    let proven = proof.proven.expect("a motion");
    let [low, high] = proven.measures[0].1.bounds;
    // The crank points away from D at the smallest angle, and a right angle is passed twice.
    let least = angle(PI);
    assert!(low <= least && 36_f64.to_radians() <= low, "{low} {least}");
    assert!((PI / 2.0..PI / 2.0 + 1e-6).contains(&high), "{high}");
}

/// The crank moves its own inertia and the ram, whose speed is dx/dφ of that of the crank.
#[test]
fn the_reduced_mass_of_a_crank_is_that_of_its_energy() {
    let text = "mechanism press {
        point O = (0, 0);
        body crank at (0, 0, 0.3) { O, A: (30mm, 0) }
        body rod at (28mm, 9mm, -0.09) { A: (0, 0), B: (100mm, 0) }
        body ram at (127mm, 0) { B: (0, 0) }
        revolute O(ground, crank);
        revolute A(crank, rod);
        revolute B(rod, ram);
        translational guide(ground, ram) along O -> B;
        drive motor: phi(crank) = 0.3 + 4*t;
        mass crank = 0.5kg at O inertia 2e-4kg*m^2;
        mass ram = 0.8kg;
        measure moved = reduced_mass(motor);
        measure energy = kinetic_energy() + potential_energy();
    }";
    let derived = written(text);
    let view = Interpreted::new(&derived).expect("a motion");
    let measures = ["moved", "energy"].map(|it| Observable::named(&derived, it).expect("one"));
    let mut worst = [0.0_f64; 2];
    followed(&view, &times(), |view, instant| {
        let phi = START + RATE * instant.t();
        let inertia = 2e-4 + 0.8 * first(phi) * first(phi);
        let values = Observable::values(view, &measures, instant);
        let expected = [inertia, 0.5 * inertia * RATE * RATE];
        for ((worst, value), expected) in worst.iter_mut().zip(values).zip(expected) {
            *worst = worst.max((value / expected - 1.0).abs());
        }
    });
    println!("{worst:?}");
    assert!(worst.iter().all(|it| *it < 1e-13), "{worst:?}");
    let two = text.replace("mass crank", "drive second: y(ram) = t; mass crank");
    let read = linkwright_codegen::read(&linkwright_codegen::Source::new("press.mech", two));
    let errors = read.expect_err("two drivers move");
    assert!(
        errors
            .iter()
            .any(|it| it.message.contains("moves masses, too")),
        "{errors:?}"
    );
}

/// x(φ), and its first two derivatives.
fn x(phi: f64) -> f64 {
    CRANK * phi.cos() + (ROD * ROD - (CRANK * phi.sin()).powi(2)).sqrt()
}

fn first(phi: f64) -> f64 {
    let root = (ROD * ROD - (CRANK * phi.sin()).powi(2)).sqrt();
    -CRANK * phi.sin() - CRANK * CRANK * phi.sin() * phi.cos() / root
}

fn second(phi: f64) -> f64 {
    let root = (ROD * ROD - (CRANK * phi.sin()).powi(2)).sqrt();
    let of_root = -CRANK * CRANK * phi.sin() * phi.cos() / root;
    let twice = CRANK * CRANK * (phi.sin().powi(2) - phi.cos().powi(2));
    -CRANK * phi.cos() + (twice - of_root * of_root) / root
}
