//! Forces against formulas of textbooks and free bodies that are cut by hand: a pendulum, a lamp on a spring, a slider-crank, a cam,
//! a four-bar, gears; and against the published multipliers of Andrews' mechanism.

mod andrews;
mod free_bodies;
mod teeth;
mod toothed_bodies;
mod unchanged_by_teeth;

use linkwright_tests::description;
use linkwright_tests::forces::{Followed, moving, systems};

fn followed(text: &str) -> Followed {
    let derived = &systems("by_hand", text)[0];
    Followed::new(derived, 0.0).expect("the drawing assembles")
}

fn close(found: f64, expected: f64, limit: f64, what: &str) {
    let size = expected.abs().max(1.0);
    assert!(
        (found - expected).abs() <= limit * size,
        "{what}: {found} instead of {expected}"
    );
}

#[test]
fn a_pendulum_has_the_torque_and_the_pin_force_of_the_textbook() {
    let mut pendulum = followed(
        "mechanism pendulum {
            point O = (0, 0);
            body bob at O { O, S: (0, -2) }
            revolute O(ground, bob);
            drive swing: phi(bob) = 0.7*sin(3*t);
            mass bob = 3kg at S inertia 0.5;
            gravity = (0, -9.81);
            effort; reactions; energy;
        }",
    );
    for step in 0..40 {
        let t = 0.05 * f64::from(step);
        assert!(pendulum.advance(t));
        let (m, l, g) = (3.0, 2.0, 9.81);
        let angle = 0.7 * (3.0 * t).sin();
        let rate = 2.1 * (3.0 * t).cos();
        let spin = -6.3 * (3.0 * t).sin();
        let torque = (0.5 + m * l * l) * spin + m * g * l * angle.sin();
        close(pendulum.value("effort_swing"), torque, 1e-13, "torque");
        close(pendulum.value("power_swing"), torque * rate, 1e-13, "power");
        // The acceleration of the bob along the tangent and towards the pin, and its weight.
        let tangent = [angle.cos(), angle.sin()];
        let inward = [-angle.sin(), angle.cos()];
        for (axis, name) in ["reaction_o_x", "reaction_o_y"].into_iter().enumerate() {
            let weight = if axis == 1 { m * g } else { 0.0 };
            let force = m * l * (spin * tangent[axis] + rate * rate * inward[axis]) + weight;
            close(pendulum.value(name), force, 1e-13, name);
        }
        close(
            pendulum.value("kinetic_energy"),
            0.5 * (0.5 + m * l * l) * rate * rate,
            1e-13,
            "kinetic energy",
        );
        close(
            pendulum.value("potential_energy"),
            -m * g * l * angle.cos(),
            1e-13,
            "potential energy",
        );
    }
}

/// A spring without a free length between the lamp's arm and a point above its pin balances it in every pose.
#[test]
fn a_lamp_on_a_spring_of_no_length_stays_where_it_is_put() {
    let mut lamp = followed(
        "mechanism lamp {
            point O = (0, 0), W = (0, 40cm);
            body arm at O { O, P: (30cm, 0), S: (60cm, 0) }
            revolute O(ground, arm);
            drive phi(arm) = 80deg*sin(t);
            mass arm = 1.5kg at S;
            gravity = (0, -9.81);
            spring (ground.W, arm.P) = 1.5kg*9.81m/s^2*60cm/(30cm*40cm) free 0;
            effort; energy;
        }",
    );
    let still = |lamp: &Followed| {
        let moving = moving(0, lamp.instant());
        // What is left is the inertia alone.
        1.5 * 0.6 * 0.6 * moving.acceleration[2]
    };
    let stored = lamp.value("potential_energy");
    for step in 0..60 {
        assert!(lamp.advance(0.1 * f64::from(step)));
        let (found, inertia) = (lamp.value("effort_drive_phi_arm"), still(&lamp));
        assert!(
            (found - inertia).abs() < 1e-14 * 1.5 * 9.81 * 60.0,
            "{found}"
        );
        close(lamp.value("potential_energy"), stored, 1e-14, "the energy");
    }
}

/// A massless rod transmits the piston's force: the torque is the work of the inertia along x(θ), the guide takes the sideways part.
#[test]
fn a_slider_crank_has_the_torque_of_the_textbook() {
    let mut engine = followed(
        "mechanism engine {
            point O = (0, 0), B = (5cm, 0), P = (25cm, 0);
            body crank at O { O, B }
            body rod at B { B, P }
            body piston at P { P }
            revolute O(ground, crank);
            revolute B(crank, rod);
            revolute P(rod, piston);
            translational guide (ground, piston) along O -> P;
            drive phi(crank) = 100*t;
            mass piston = 0.8kg;
            effort; reactions;
        }",
    );
    let (r, l, omega, m) = (0.05_f64, 0.2_f64, 100.0_f64, 0.8_f64);
    for step in 0..200 {
        let t = 0.0007 * f64::from(step);
        assert!(engine.advance(t));
        let angle = omega * t;
        let (sine, cosine) = angle.sin_cos();
        let root = (l * l - r * r * sine * sine).sqrt();
        // x = r cos θ + √(l² − r² sin² θ), differentiated by θ once and twice.
        let first = -r * sine - r * r * sine * cosine / root;
        let second = -r * cosine
            - r * r * (cosine * cosine - sine * sine) / root
            - (r * r * sine * cosine).powi(2) / root.powi(3);
        let inertia = m * omega * omega * second;
        close(
            engine.value("effort_drive_phi_crank"),
            inertia * first,
            1e-11,
            "torque",
        );
        // The rod leans by ψ with sin ψ = r sin θ/l; it pushes the piston sideways by the inertia times tan ψ.
        let sideways = inertia * (r * sine) / root;
        close(
            engine.value("reaction_guide_normal"),
            sideways,
            1e-11,
            "the guide",
        );
        close(
            engine.value("reaction_p_x"),
            inertia,
            1e-11,
            "the piston's pin, x",
        );
        close(
            engine.value("reaction_p_y"),
            -sideways,
            1e-11,
            "the piston's pin, y",
        );
        assert!(engine.value("reaction_guide_moment").abs() < 1e-10);
    }
}

/// A flat face on an eccentric disc lifts by e sin θ: N = F0 + (c − m ω²) e sin θ vanishes first at ω² = (c + F0/e)/m.
#[test]
fn a_cam_loses_its_follower_at_the_speed_at_which_the_spring_is_too_slow() {
    let lowest = |omega: f64| {
        let text = format!(
            "mechanism cam {{
                point O = (0, 0), G = (0, 30mm);
                body cam at O {{ O }}
                body follower at G {{ G, A: (-20mm, 0), B: (20mm, 0), T: (0, 50mm) }}
                point W = (0, 200mm);
                curve rim(s) on cam = (10mm + 30mm*cos(s), 30mm*sin(s));
                revolute O(ground, cam);
                translational (ground, follower) along O -> G;
                flat contact (follower, rim) along A -> B;
                drive phi(cam) = {omega}*t;
                mass follower = 0.25kg;
                spring (follower.T, ground.W) = 2000 free 120mm preload -40N;
                effort; reactions;
            }}"
        );
        let mut cam = followed(&text);
        let mut lowest = f64::INFINITY;
        for step in 0..=400 {
            let t = f64::from(step) * std::f64::consts::TAU / 400.0 / omega;
            assert!(cam.advance(t));
            let sine = (omega * t).sin();
            let expected = 40.0 + (2000.0 - 0.25 * omega * omega) * 0.01 * sine;
            let pressure = cam.value("reaction_contact_pressure");
            close(pressure, expected, 1e-10, "the contact");
            lowest = pressure.min(lowest);
        }
        lowest
    };
    let critical = ((2000.0 + 40.0 / 0.01) / 0.25_f64).sqrt();
    assert!(lowest(0.999 * critical) > 0.0);
    assert!(lowest(1.001 * critical) < 0.0);
}

/// A load at a point goes to the drivers by the transposed transmission, and they push back with as much.
#[test]
fn efforts_hold_what_transmissions_pass_on() {
    let text = description::source("excavator").text;
    let end = text.rfind('}').expect("its end");
    let loaded = format!(
        "{}transmission K; force on K = (300N, -500N); effort; }}",
        &text[..end]
    );
    let derived = &systems("excavator", &loaded)[0];
    let mut excavator = Followed::new(derived, 0.0).expect("as drawn");
    let names = linkwright_solver::derivatives::names(&derived.system);
    for step in 0..50 {
        assert!(excavator.advance(0.1 * f64::from(step)));
        let columns = excavator.derivatives();
        let column = |name: &str| {
            let place = names.iter().position(|it| it.0 == *name);
            columns[place.unwrap_or_else(|| panic!("{name} in {names:?}"))]
        };
        for (driver, effort) in [
            ("length(N, M)", "effort_drive_length_n_m"),
            ("length(H, G)", "effort_drive_length_h_g"),
        ] {
            let passed = 300.0 * column(&format!("K_x per {driver}"))
                - 500.0 * column(&format!("K_y per {driver}"));
            close(excavator.value(effort), -passed, 1e-12, effort);
        }
    }
}

/// A rocker is driven into its dead point: forces grow, the motion ends with a failure, and no frame before has anything but numbers.
#[test]
fn forces_are_numbers_until_the_motion_ends_at_a_dead_point() {
    let mut rocker = followed(
        "mechanism rocker {
            point A = (0, 0), B = (0.2, 0.3), C = (0.6, 0.5), D = (0.5, 0);
            body crank at A facing A -> B { A, B }
            body coupler at B facing B -> C { B, C }
            body rocker at D facing D -> C { D, C }
            revolute A(ground, crank);
            revolute B(crank, coupler);
            revolute C(coupler, rocker);
            revolute D(ground, rocker);
            drive phi(rocker) = atan2(0.5, 0.1) - t;
            mass coupler = 2kg;
            mass rocker = 1kg at C inertia 0.1;
            gravity = (0, -9.81);
            effort; reactions;
        }",
    );
    let (mut largest, mut t) = (0.0_f64, 0.0);
    let mut step = 0.01;
    while step > 1e-13 {
        match rocker.advance(t + step) {
            true => {
                t += step;
                for (name, value) in rocker.all() {
                    assert!(value.is_finite(), "{name} at t = {t}");
                    largest = largest.max(value.abs());
                }
            }
            false => step *= 0.5,
        }
        assert!(t < 10.0, "this rocker has a dead point");
    }
    assert!(largest > 1e4, "only {largest} N at t = {t}");
}

/// Two bodies whose ends meet: a spring without a direction is a failure with a type, and no number.
#[test]
fn a_spring_whose_ends_meet_has_no_direction() {
    let mut spring = followed(
        "mechanism meeting {
            point O = (0, 0), A = (1, 0), W = (1, 0.5);
            body slider at O { S: (0, 0.5) }
            absolute_y(slider) = 0;
            absolute_angle(slider) = 0;
            drive x(slider) = t;
            spring (slider.S, ground.W) = 100 free 0.2;
            effort;
        }",
    );
    for step in 1..100 {
        assert!(spring.advance(0.01 * f64::from(step)));
        let stretch = 1.0 - 0.01 * f64::from(step) - 0.2;
        close(
            spring.value("effort_drive_x_slider"),
            -100.0 * stretch,
            1e-10,
            "the spring",
        );
    }
    assert!(!spring.advance(1.0));
}
