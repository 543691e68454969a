//! Equations of a description: closed forms, their order among joints, and their scales.

use linkwright_codegen::stages::check;
use linkwright_codegen::stages::emit::{Notation, text};
use linkwright_codegen::stages::model::Role;
use linkwright_codegen::stages::system::Derived;
use linkwright_tests::description::written;
use linkwright_tests::plan::forms;
use linkwright_tests::random::Random;

/// A rope over a peg.
mod rope {
    linkwright::include_mechanism!(rope);
}

/// A point on an ellipse.
mod ellipse {
    linkwright::include_mechanism!(ellipse);
}

/// A point on an ellipse, a thousand million times as large.
mod ellipse_large {
    linkwright::include_mechanism!(ellipse_large);
}

/// The exam's mechanism with two formulas for its pin.
mod written_pin {
    linkwright::include_mechanism!(written_pin);
}

#[test]
fn a_rope_over_a_peg_has_its_length() {
    let mut rope = rope::Rope::assemble(0.0).expect("as drawn");
    for step in 0..=700 {
        let t = 0.01 * f64::from(step);
        let frame = *rope.advance(t).expect("the load hangs");
        let (trolley, load) = (frame.point_p(), frame.point_q());
        let (x, rate, acceleration) = (4.0 + t.sin(), t.cos(), -t.sin());
        let taut = x.hypot(3.0);
        // y = √(x² + 9) − 8, and its derivatives.
        let slope = x / taut;
        let bend = 9.0 / taut.powi(3);
        assert!((trolley.position[0] - x).abs() <= 1e-15 * 4.0);
        assert!((load.position[1] - (taut - 8.0)).abs() <= 1e-14, "{t}");
        assert!((load.velocity[1] - slope * rate).abs() <= 1e-14, "{t}");
        let expected = slope * acceleration + bend * rate * rate;
        assert!((load.acceleration[1] - expected).abs() <= 1e-14, "{t}");
    }
}

/// Central differences along a random line; variable distances are roots, for which `derivatives` has no bounds.
#[test]
fn derivatives_of_the_rope_agree_with_differences() {
    use rope::{Coordinates, gamma, phi, phi_q, phi_t};
    let mut random = Random::new(7);
    let step = 1e-5;
    for _ in 0..200 {
        let mut pick = |low: f64, high: f64| [(); 6].map(|()| random.between(low, high));
        // Away from the peg, where a distance is not differentiable.
        let (mut q, qd) = (pick(-1.0, 1.0), pick(-1.0, 1.0));
        q[1] -= 4.0;
        q[4] -= 4.0;
        let t = pick(0.0, 5.0)[0];
        let at = |s: f64| {
            let moved = std::array::from_fn(|k| q[k] + s * qd[k]);
            (Coordinates::from_array(moved), t + s)
        };
        let rate = |s: f64| {
            let (q, t) = at(s);
            phi_q(&q, t) * linkwright::nalgebra::SVector::from(qd) + phi_t(&q, t)
        };
        let value = |s: f64| {
            let (q, t) = at(s);
            phi(&q, t)
        };
        let slope = (value(step) - value(-step)) / (2.0 * step);
        assert!((slope - rate(0.0)).amax() < 1e-8);
        let bend = (rate(step) - rate(-step)) / (2.0 * step);
        let generated_gamma = gamma(&Coordinates::from_array(q), &Coordinates::from_array(qd), t);
        assert!((bend + generated_gamma).amax() < 1e-8);
    }
}

/// The equation of the ellipse is a ratio: relative to the size of the mechanism it would be solved only to 1e-3.
#[test]
fn a_point_on_a_large_ellipse_stays_there() {
    let mut ellipse = ellipse_large::EllipseLarge::assemble(0.0).expect("as drawn");
    for step in 0..=700 {
        let t = 0.01 * f64::from(step);
        let frame = *ellipse.advance(t).expect("the point moves");
        let point = frame.point_p();
        let (u, rate) = (1.0 + t.sin() / 2.0, t.cos() / 2.0);
        let (sine, cosine) = u.sin_cos();
        let bound = 2e-14 * 1e9;
        assert!((point.position[0] - 3e9 * cosine).abs() <= bound, "{t}");
        assert!((point.position[1] - 2e9 * sine).abs() <= bound, "{t}");
        assert!(
            (point.velocity[0] + 3e9 * sine * rate).abs() <= bound,
            "{t}"
        );
        assert!(
            (point.velocity[1] - 2e9 * cosine * rate).abs() <= bound,
            "{t}"
        );
    }
}

#[test]
fn a_point_on_an_ellipse_stays_there() {
    let mut ellipse = ellipse::Ellipse::assemble(0.0).expect("as drawn");
    for step in 0..=700 {
        let t = 0.01 * f64::from(step);
        let frame = *ellipse.advance(t).expect("the point moves");
        let point = frame.point_p();
        let (u, rate) = (1.0 + t.sin() / 2.0, t.cos() / 2.0);
        let (sine, cosine) = u.sin_cos();
        let bound = 2e-14;
        assert!((point.position[0] - 3.0 * cosine).abs() <= bound, "{t}");
        assert!((point.position[1] - 2.0 * sine).abs() <= bound, "{t}");
        assert!(
            (point.velocity[0] + 3.0 * sine * rate).abs() <= bound,
            "{t}"
        );
        assert!(
            (point.velocity[1] - 2.0 * cosine * rate).abs() <= bound,
            "{t}"
        );
        let second = -t.sin() / 2.0;
        let bend = [
            -3.0 * (cosine * rate * rate + sine * second),
            2.0 * (cosine * second - sine * rate * rate),
        ];
        for (found, expected) in point.acceleration.iter().zip(bend) {
            assert!((found - expected).abs() <= bound, "{t}");
        }
        assert!((frame.q.phi1 - t).abs() <= 1e-15);
    }
}

#[test]
fn a_pin_written_as_equations_is_the_joint() {
    use written_pin::{joined, written};
    let mut one = joined::WrittenPin::assemble(0.0).expect("as drawn");
    let mut other = written::WrittenPin::assemble(0.0).expect("as drawn");
    for step in 0..=400 {
        let t = 0.01 * f64::from(step);
        let one = one.advance(t).expect("the crank swings");
        let other = other.advance(t).expect("the crank swings");
        assert_eq!(one.q.to_array(), other.q.to_array());
        assert_eq!(one.qd.to_array(), other.qd.to_array());
        assert_eq!(one.qdd.to_array(), other.qdd.to_array());
    }
}

fn rows(derived: &Derived) -> Vec<(&str, &str, String)> {
    let joints = &derived.system.mechanism.joints;
    let rows = derived.system.rows.iter();
    rows.map(|row| {
        let residual = text::formula(
            &derived.pool,
            &derived.system,
            &row.bodies,
            Notation::Ascii,
            row.residual,
        );
        (
            joints[row.joint].label.as_str(),
            row.name.as_str(),
            residual,
        )
    })
    .collect()
}

#[test]
fn equations_are_rows_with_names_of_their_own() {
    let derived = written(
        "mechanism m {
            const L = 2m;
            point A = (1, 2), B = (0.5, 0);
            body 1 at (0, 0) { B, P: (0, 1) }
            body 2 at (1, 0) { Q: (0, -1) }
            equation rope: (B.x - Q.x)^2 + (A.y - 1.P.y)^2 = L^2;
            equation x(1) = L*cos(phi(2)) + 1.y;
            equation wheel: phi(1) = -2*phi(2) + t;
            equation distance(ground.B, 2) = L;
        }",
    );
    let expected = [
        (
            "equation rope",
            "rope",
            "(x1 + 0.5*cos(phi1) - x2 - sin(phi2))^2 + (2 - y1 - cos(phi1))^2 - 4",
        ),
        ("equation 2", "equation_2", "x1 - y1 - 2*cos(phi2)"),
        ("equation wheel", "wheel", "phi1 + 2*phi2 - t"),
        ("equation 4", "equation_4", "sqrt((0.5 - x2)^2 + y2^2) - 2"),
    ];
    let rows = rows(&derived);
    let printed: Vec<(&str, &str, &str)> = rows
        .iter()
        .map(|(label, name, row)| (*label, *name, row.as_str()))
        .collect();
    assert_eq!(printed, expected);
    let roles: Vec<Role> = derived
        .system
        .mechanism
        .joints
        .iter()
        .map(|it| it.role)
        .collect();
    use Role::{Constraint, Driver};
    assert_eq!(roles, [Constraint, Constraint, Driver, Constraint]);
    let scales: Vec<f64> = derived
        .system
        .rows
        .iter()
        .map(|row| derived.system.scale(row.quantity, &derived.pool))
        .collect();
    assert_eq!(scales, [4.0, 2.0, 1.0, 2.0]);
}

/// The sine and the cosine of a body's angle are rotated local vectors, so that the textbook's closed forms apply.
#[test]
fn equations_in_sines_and_cosines_are_solved_in_closed_form() {
    let derived = written(
        "mechanism yoke {
            body crank at (0, 0, 30deg);
            body yoke at (0.8, 0);
            absolute_x(crank) = 0;
            absolute_y(crank) = 0;
            absolute_y(yoke) = 0;
            absolute_angle(yoke) = 0;
            equation yoke: x(yoke) = 1m*cos(phi(crank)) + 0.2*sin(phi(crank));
            equation x(yoke) = 0.5 + 0.1*sin(t);
        }",
    );
    check(&derived).expect("determined");
    let names: Vec<String> = forms(derived).into_iter().map(|(_, name)| name).collect();
    assert_eq!(names, ["one angle"]);
}
