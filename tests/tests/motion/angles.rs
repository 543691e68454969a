//! Angles that need no body: what formulas and statements say of them, against what is known in closed form.

use std::f64::consts::{FRAC_PI_3, PI};
use std::fmt::Write as _;

use linkwright::nalgebra::{DMatrix, DVector};
use linkwright::{Settings, Signal};
use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::{Options, generate};
use linkwright_mechanisms::differential_wrist::{to_joint, to_motors};
use linkwright_solver::{Interpreted, View};
use linkwright_tests::description::written;
use linkwright_tests::random::Random;
use linkwright_tests::swing::swing;
use linkwright_tests::values::{assembled_from, levels};

/// A value, a rate and an acceleration of a combination of two signals.
fn combined(parts: [(f64, Signal); 2]) -> [f64; 3] {
    let sum = |of: fn(&Signal) -> f64| parts.iter().map(|(by, signal)| by * of(signal)).sum();
    [
        sum(|it| it.value),
        sum(|it| it.rate),
        sum(|it| it.acceleration),
    ]
}

fn constant(value: f64) -> Signal {
    Signal {
        value,
        ..Signal::default()
    }
}

fn near(found: [f64; 3], expected: [f64; 3], limit: f64) {
    for (found, expected) in found.into_iter().zip(expected) {
        assert!((found - expected).abs() <= limit, "{found} for {expected}");
    }
}

/// Pitch is the mean of both motors, and roll their difference over twice the ratio of the teeth.
#[test]
fn a_differential_turns_as_its_teeth_say_with_its_torques_and_powers() {
    const RATIO: f64 = 1.5;
    let given = |t: f64| to_joint::Inputs {
        left_motor: swing(0.0, 1.2, 2.0, t),
        right_motor: swing(0.0, 0.7, 3.1, t),
        pitch_torque: constant(1.0 + t),
        roll_torque: constant(2.0 - 3.0 * t),
    };
    let mut wrist = to_joint::DifferentialWrist::assemble(0.0, &given(0.0)).expect("as drawn");
    let mut back = to_motors::DifferentialWrist::assemble(0.0, &to_motors::Inputs::default())
        .expect("as drawn");
    for step in 0..=400 {
        let t = 0.01 * f64::from(step);
        let inputs = given(t);
        let frame = wrist.advance(t, &inputs).expect("never singular");
        let [left, right] = [inputs.left_motor, inputs.right_motor];
        let pitch = [
            frame.phi_pitch(),
            frame.phi_pitch_rate(),
            frame.phi_pitch_acceleration(),
        ];
        let roll = [
            frame.phi_roll(),
            frame.phi_roll_rate(),
            frame.phi_roll_acceleration(),
        ];
        near(pitch, combined([(0.5, left), (0.5, right)]), 1e-14);
        let half = 0.5 / RATIO;
        near(roll, combined([(half, left), (-half, right)]), 1e-14);
        // Motors hold what the loads exert through the teeth.
        let loads = [inputs.pitch_torque.value, inputs.roll_torque.value];
        let efforts = [
            frame.effort_drive_phi_left(),
            frame.effort_drive_phi_right(),
        ];
        near(
            [efforts[0], efforts[1], 0.0],
            [
                -0.5 * loads[0] - half * loads[1],
                -0.5 * loads[0] + half * loads[1],
                0.0,
            ],
            1e-13,
        );
        let power = efforts[0] * left.rate
            + efforts[1] * right.rate
            + loads[0] * pitch[1]
            + loads[1] * roll[1];
        assert!(power.abs() < 1e-12, "{power} W are lost at {t}");
        let wanted = to_motors::Inputs {
            wanted_pitch: Signal {
                value: pitch[0],
                rate: pitch[1],
                acceleration: pitch[2],
            },
            wanted_roll: Signal {
                value: roll[0],
                rate: roll[1],
                acceleration: roll[2],
            },
        };
        let motors = back.advance(t, &wanted).expect("never singular");
        near(
            [
                motors.phi_left(),
                motors.phi_left_rate(),
                motors.phi_left_acceleration(),
            ],
            [left.value, left.rate, left.acceleration],
            1e-13,
        );
    }
}

fn code(text: &str) -> String {
    let source = Source::new("angles.mech", text);
    let generated = generate(&source, &Options::default())
        .unwrap_or_else(|found| panic!("{}", found.render(&source)));
    generated.code().to_string()
}

/// What solves a description: its forms, by name.
fn forms(text: &str) -> Vec<String> {
    let solved = Interpreted::new(&written(text)).expect("a plan");
    let forms = solved.program().forms.iter().flatten();
    forms.map(|form| form.name()).collect()
}

/// The angle of this coordinate at an instant.
fn angle_at(text: &str, name: &str, t: f64) -> f64 {
    let solved = Interpreted::new(&written(text)).expect("a plan");
    let at = solved
        .system()
        .coordinates
        .iter()
        .position(|it| it.name == name);
    let shell = assembled_from(solved, &[], t, Settings::default()).expect("as drawn");
    let levels = levels(shell.blocks(), shell.frame());
    levels[0][at.expect("a coordinate")]
}

#[test]
fn a_bare_name_and_phi_of_it_say_the_same() {
    let text = |a: &str, b: &str| {
        format!(
            "mechanism m {{ angle a = 0; angle b = 90deg; drive {a} = 0.3*sin(t);
            equation link: 2*cos({b}) + 3*sin({b}) = 3 - sin({a}); output {b}; transmission {b}; }}"
        )
    };
    let one = code(&text("a", "b"));
    let other = code(&text("phi(a)", "phi(b)"));
    assert_eq!(one.replace("drive a", "drive phi(a)"), other);
}

#[test]
fn cosines_of_sums_of_angles_are_closed_forms() {
    // cos(a + 20° − b) = 0.3 with a = 0.4 has b = a + 20° ± acos 0.3.
    let text = |drawn: f64| {
        format!(
            "mechanism m {{ angle a = 0.4; angle b = {drawn}; drive a = 0.4;
            equation cos(a + 20deg - b) = 0.3; output b; }}"
        )
    };
    for (drawn, sign) in [(2.0, 1.0), (-0.5, -1.0)] {
        assert_eq!(forms(&text(drawn)).last().expect("a block"), "one angle");
        let expected = 0.4 + PI / 9.0 + sign * 0.3_f64.acos();
        let found = angle_at(&text(drawn), "phi_b", 0.0);
        assert!((found - expected).abs() < 1e-14, "{found} for {expected}");
    }
}

#[test]
fn angles_stand_beside_bodies_in_drivers_and_equations() {
    let text = "mechanism m {
        point O = (0, 0);
        body rod at O { O }
        angle half = 0.5;
        revolute O(ground, rod);
        drive relative_angle(half, rod) = 0.2;
        equation phi(rod) = 3*half + 0.1*t;
        output half, phi(rod);
    }";
    // rod = half + 0.2 or half − 0.2, as the relative angle is measured in two bodies.
    let (half, rod) = (
        angle_at(text, "phi_half", 1.0),
        angle_at(text, "phi_rod", 1.0),
    );
    let bodies = text.replace(
        "angle half = 0.5;",
        "body half at (0, 0, 0.5) { O } revolute O(ground, half);",
    );
    let bodies = bodies
        .replace("3*half", "3*phi(half)")
        .replace("output half", "output phi(half)");
    assert!((rod - 3.0 * half - 0.1).abs() < 1e-14, "{rod} {half}");
    assert!((half - angle_at(&bodies, "phi_half", 1.0)).abs() < 1e-14);
    assert!((rod - angle_at(&bodies, "phi_rod", 1.0)).abs() < 1e-14);
}

#[test]
fn parts_and_repetitions_have_angles_of_their_own() {
    let text = "mechanism finger {
        angle base = 10deg;
        angle tip = 20deg;
        equation tip = 2*base;
    }
    mechanism hand {
        repeat i from 1 to 3 {
            part finger[i] = finger();
            drive finger[i].base = 0.1*i*t;
        }
        angle sum = 0;
        equation sum = finger[1].tip + finger[2].tip + finger[3].tip;
        output sum;
    }";
    let sum = angle_at(text, "phi_sum", 2.0);
    assert!((sum - 2.0 * 0.6 * 2.0).abs() < 1e-14, "{sum}");
}

#[test]
fn the_drawing_says_which_of_two_angles() {
    let text = |drawn: &str| {
        format!(
            "mechanism m {{ angle a = {drawn}; equation cos(a) = 0.5; equation sin(a)^2 = 0.75; }}"
        )
    };
    // Two equations of one angle are one too many.
    assert!(generate(&Source::new("m.mech", text("60deg")), &Options::default()).is_err());
    let text = |drawn: &str| format!("mechanism m {{ angle a = {drawn}; equation cos(a) = 0.5; }}");
    for (drawn, sign) in [("50deg", 1.0), ("-70deg", -1.0)] {
        let found = angle_at(&text(drawn), "phi_a", 0.0);
        assert!((found - sign * FRAC_PI_3).abs() < 1e-15, "{found}");
    }
}

/// Random linear equations, many of which say that an angle follows another one: the order in which they are solved is the plan's business.
#[test]
fn linear_equations_of_angles_have_the_solution_of_the_dense_system() {
    let mut random = Random::new(20_261_123);
    let mut below = |count: usize| (random.bits() % count as u64) as usize;
    let mut compared = 0;
    while compared < 400 {
        let count = 2 + below(5);
        let mut matrix = DMatrix::<f64>::zeros(count, count);
        let mut text = String::from("mechanism linear {\n");
        for angle in 0..count {
            let _ = writeln!(text, "angle a{angle} = 0;");
        }
        for row in 0..count {
            let own = 2 + below(2);
            for _ in 0..own {
                let factors = [1.0, -1.0, 1.0, -1.0, 2.0, -3.0, 0.5];
                matrix[(row, below(count))] = factors[below(factors.len())];
            }
            let terms = (0..count).filter(|&column| matrix[(row, column)] != 0.0);
            let terms: Vec<String> = terms
                .map(|column| format!("({})*a{column}", matrix[(row, column)]))
                .collect();
            let _ = writeln!(text, "equation {} = {row} + 0.1*t;", terms.join(" + "));
        }
        text.push('}');
        let wanted = DVector::from_fn(count, |row, _| row as f64 + 0.1);
        let inverse = matrix
            .clone()
            .try_inverse()
            .filter(|_| matrix.determinant().abs() > 0.1);
        let Some(inverse) = inverse else {
            continue;
        };
        let expected = inverse * wanted;
        let solved = Interpreted::new(&written(&text)).expect("a plan");
        let shell = assembled_from(solved, &[], 1.0, Settings::default());
        let shell = shell.unwrap_or_else(|failure| panic!("{failure}\n{text}"));
        let found = levels(shell.blocks(), shell.frame());
        for (found, expected) in found[0].iter().zip(expected.iter()) {
            let gap = (found - expected).abs();
            assert!(
                gap < 1e-11 * expected.abs().max(1.0),
                "{found} for {expected}\n{text}"
            );
        }
        compared += 1;
    }
}
