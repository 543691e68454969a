//! Forces against formulas of textbooks and free bodies that are cut by hand: a pendulum, a lamp on a spring, a slider-crank, a cam,
//! a four-bar; and against the published multipliers of Andrews' mechanism.

use linkwright_mechanisms::andrews;
use linkwright_tests::description;
use linkwright_tests::forces::{Followed, cross, moving, systems};
use nalgebra::{DMatrix, DVector};

fn followed(text: &str) -> Followed {
    let system = &systems("by_hand", text)[0];
    Followed::new(system, 0.0).expect("the drawing assembles")
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
            let found = cam.value("reaction_contact_pressure");
            close(found, expected, 1e-10, "the contact");
            lowest = found.min(lowest);
        }
        lowest
    };
    let critical = ((2000.0 + 40.0 / 0.01) / 0.25_f64).sqrt();
    assert!(lowest(0.999 * critical) > 0.0);
    assert!(lowest(1.001 * critical) < 0.0);
}

/// A body cut free: where its center of mass is, its mass, its moment of inertia.
struct Free {
    body: usize,
    center: [f64; 2],
    mass: f64,
    inertia: f64,
}

/// The unknowns of a pin: which two of all, where it is, and whether it acts on this body as it is written or the other way.
struct Pin {
    unknown: usize,
    place: [f64; 2],
    sign: f64,
}

/// Recursive Newton-Euler for one body: two forces and one moment about its center of mass, into three rows.
fn cut_free(
    free: &Free,
    pins: &[Pin],
    torques: &[(usize, f64)],
    gravity: f64,
    followed: &Followed,
    (matrix, right): (&mut DMatrix<f64>, &mut DVector<f64>),
    first: usize,
) {
    let moving = moving(free.body, followed.instant());
    let arm = moving.arm(free.center);
    let center = [moving.at[0] + arm[0], moving.at[1] + arm[1]];
    let acceleration = moving.acceleration(free.center);
    right[first] = free.mass * acceleration[0];
    right[first + 1] = free.mass * (acceleration[1] + gravity);
    right[first + 2] = free.inertia * moving.acceleration[2];
    for pin in pins {
        let lever = [pin.place[0] - center[0], pin.place[1] - center[1]];
        matrix[(first, pin.unknown)] += pin.sign;
        matrix[(first + 1, pin.unknown + 1)] += pin.sign;
        matrix[(first + 2, pin.unknown)] -= pin.sign * lever[1];
        matrix[(first + 2, pin.unknown + 1)] += pin.sign * lever[0];
    }
    for &(unknown, sign) in torques {
        matrix[(first + 2, unknown)] += sign;
    }
}

/// Where a point of a body is.
fn place(body: usize, local: [f64; 2], followed: &Followed) -> [f64; 2] {
    let moving = moving(body, followed.instant());
    let arm = moving.arm(local);
    [moving.at[0] + arm[0], moving.at[1] + arm[1]]
}

#[test]
fn a_four_bar_cut_into_free_bodies_has_the_same_forces() {
    let text = "mechanism four_bar {
        point A = (0, 0), D = (0.5, -0.1);
        body crank at (0, 0, 63deg) { A: (0, 0), B: (0.22, 0) }
        body coupler at (0.1, 0.2, 22deg) { B: (0, 0), C: (0.54, 0) }
        body rocker at (0.5, -0.1, 79deg) { D: (0, 0), C: (0.51, 0) }
        revolute A(ground, crank);
        revolute B(crank, coupler);
        revolute C(coupler, rocker);
        revolute D(ground, rocker);
        drive phi(crank) = 63deg + 7*t - 3*t^2;
        mass crank = 1.2kg at (0.1, 0.02) inertia 0.01;
        mass coupler = 2kg at (0.3, 0.05) inertia 0.06;
        mass rocker = 0.8kg at (0.2, -0.03) inertia 0.03;
        gravity = (0, -9.81);
        effort; reactions;
    }";
    let mut four_bar = followed(text);
    for step in 0..60 {
        assert!(four_bar.advance(0.02 * f64::from(step)));
        let mut matrix = DMatrix::zeros(9, 9);
        let mut right = DVector::zeros(9);
        let [a, b, c, d] = [
            [0.0, 0.0],
            place(0, [0.22, 0.0], &four_bar),
            place(1, [0.54, 0.0], &four_bar),
            [0.5, -0.1],
        ];
        let pin = |unknown, place, sign| Pin {
            unknown,
            place,
            sign,
        };
        // A on the crank, B on the coupler, C on the rocker, D on the rocker; the torque on the crank.
        let bodies = [
            (
                Free {
                    body: 0,
                    center: [0.1, 0.02],
                    mass: 1.2,
                    inertia: 0.01,
                },
                vec![pin(0, a, 1.0), pin(2, b, -1.0)],
                vec![(8, 1.0)],
            ),
            (
                Free {
                    body: 1,
                    center: [0.3, 0.05],
                    mass: 2.0,
                    inertia: 0.06,
                },
                vec![pin(2, b, 1.0), pin(4, c, -1.0)],
                vec![],
            ),
            (
                Free {
                    body: 2,
                    center: [0.2, -0.03],
                    mass: 0.8,
                    inertia: 0.03,
                },
                vec![pin(4, c, 1.0), pin(6, d, 1.0)],
                vec![],
            ),
        ];
        for (number, (free, pins, torques)) in bodies.iter().enumerate() {
            let system = (&mut matrix, &mut right);
            cut_free(free, pins, torques, 9.81, &four_bar, system, 3 * number);
        }
        let solved = matrix.full_piv_lu().solve(&right).expect("regular");
        let names = ["a", "b", "c", "d"]
            .into_iter()
            .flat_map(|pin| ["x", "y"].map(|axis| format!("reaction_{pin}_{axis}")));
        for (unknown, name) in names.enumerate() {
            close(four_bar.value(&name), solved[unknown], 1e-11, &name);
        }
        close(
            four_bar.value("effort_drive_phi_crank"),
            solved[8],
            1e-11,
            "torque",
        );
    }
}

#[test]
fn a_slider_crank_cut_into_free_bodies_has_the_same_forces() {
    let text = description::source("forced_slider").text;
    let mut engine = followed(&text);
    let lengths = |body: usize, name: &str| {
        let system = &systems("slider", &text)[0];
        let marks = &system.mechanism.moving_bodies()[body].marks;
        let mark = marks.iter().find(|it| it.name == name).expect("a point");
        let value = |part| {
            system
                .mechanism
                .graph
                .constant_value(part)
                .expect("a number")
        };
        mark.mark.local.map(value)
    };
    let (to_b, to_p) = (lengths(0, "B"), lengths(1, "P"));
    for step in 0..80 {
        let t = 0.005 * f64::from(step);
        assert!(engine.advance(t));
        let mut matrix = DMatrix::zeros(9, 9);
        let mut right = DVector::zeros(9);
        let (b, p) = (place(0, to_b, &engine), place(1, to_p, &engine));
        let pin = |unknown, place, sign| Pin {
            unknown,
            place,
            sign,
        };
        // O on the crank, B on the rod, P on the slider; the guide's normal and its moment about P; the torque on the crank.
        let crank = Free {
            body: 0,
            center: [0.02, 0.01],
            mass: 0.7,
            inertia: 0.002,
        };
        let rod = Free {
            body: 1,
            center: [0.15, 0.01],
            mass: 0.5,
            inertia: 0.004,
        };
        let slider = Free {
            body: 2,
            center: [0.005, 0.003],
            mass: 1.1,
            inertia: 0.001,
        };
        let on_crank = [pin(0, [0.0; 2], 1.0), pin(2, b, -1.0)];
        let on_rod = [pin(2, b, 1.0), pin(4, p, -1.0)];
        let system = (&mut matrix, &mut right);
        cut_free(&crank, &on_crank, &[(8, 1.0)], 9.81, &engine, system, 0);
        cut_free(
            &rod,
            &on_rod,
            &[],
            9.81,
            &engine,
            (&mut matrix, &mut right),
            3,
        );
        let system = (&mut matrix, &mut right);
        cut_free(
            &slider,
            &[pin(4, p, 1.0)],
            &[(7, 1.0)],
            9.81,
            &engine,
            system,
            6,
        );
        // The guide is along x: its force is along y at P, and P is where the driving force acts too.
        let moving = moving(2, engine.instant());
        let arm = moving.arm([0.005, 0.003]);
        matrix[(7, 6)] += 1.0;
        matrix[(8, 6)] += -arm[0];
        let gas = -200.0 * (1.0 + (5.0 * t).sin());
        right[6] -= gas;
        right[8] -= cross([-arm[0], -arm[1]], [gas, 0.0]);
        let solved = matrix.full_piv_lu().solve(&right).expect("regular");
        let names = [
            "reaction_o_x",
            "reaction_o_y",
            "reaction_b_x",
            "reaction_b_y",
            "reaction_p_x",
            "reaction_p_y",
            "reaction_guide_normal",
            "reaction_guide_moment",
            "effort_drive_phi_crank",
        ];
        for (unknown, name) in names.into_iter().enumerate() {
            close(engine.value(name), solved[unknown], 1e-11, name);
        }
    }
}

/// The published multipliers and torque, of which all digits are right (30 of them at t = 0).
#[test]
fn andrews_mechanism_has_its_published_multipliers_at_rest() {
    let mechanism = andrews::Andrews::assemble(0.0).expect("as drawn");
    let frame = mechanism.frame();
    let [x, y] = frame.reaction_e();
    let published = [98.566_870_396_241_1, -6.122_688_344_255_66];
    assert!((frame.effort_motor() - 0.033).abs() <= 1e-13 * 0.033 * 10.0);
    assert!((x - published[0]).abs() <= 1e-13 * published[0]);
    assert!((y - published[1]).abs() <= 1e-13 * published[0]);
    for [x, y] in [frame.reaction_e_2(), frame.reaction_e_3()] {
        assert!(x.hypot(y) <= 1e-13 * published[0]);
    }
    assert!(frame.kinetic_energy().abs() <= f64::MIN_POSITIVE);
}

/// Another text of the mechanism: drawn where it is after 0.03 s, and driven as it moves there.
#[test]
fn andrews_mechanism_has_its_multipliers_in_motion() {
    let q = [
        ("beta", 15.810_771_195_153_707),
        ("theta", -15.756_370_558_411_84),
        ("gamma", 0.040_822_240_119_645_85),
        ("phi", -0.534_730_116_342_079_6),
        ("delta", 0.524_409_965_879_954_1),
        ("omega", 0.534_730_116_342_079_6),
        ("epsilon", 1.048_080_741_041_938),
    ];
    let mut text = description::source("andrews").text;
    for (name, value) in q {
        let start = text.find(&format!("const {name} = ")).expect("the angle");
        let end = start + text[start..].find(';').expect("its end");
        text.replace_range(start..end, &format!("const {name} = {value}"));
    }
    let start = text.find("drive motor").expect("the driver");
    let end = start + text[start..].find(';').expect("its end");
    let law = "drive motor: phi(k1) = beta + 1139.92030225910606*t - 24631.7631228746345*t^2/2";
    text.replace_range(start..end, law);
    let andrews = followed(&text);
    // Relative to 128-bit references; the pose is rounded, and rates of 1e3 rad/s and spins of 5e5 rad/s² magnify that.
    let rates = andrews.instant().qd();
    let rate = |body: usize| rates[3 * body + 2];
    close(rate(2), 11.032_911_910_618_594, 1e-11, "the rate of gamma");
    close(rate(4), 0.573_569_914_829_502_5, 1e-10, "the rate of delta");
    close(
        rate(6),
        0.323_179_149_249_130_9,
        1e-10,
        "the rate of epsilon",
    );
    close(andrews.value("effort_motor"), 0.033, 1e-9, "the torque");
    let multipliers = [
        ("reaction_e_x", 199.175_348_104_538_63),
        ("reaction_e_y", -29.755_309_974_971_763),
        ("reaction_e_2_x", 23.066_543_611_622_15),
        ("reaction_e_2_y", 31.452_725_275_771_07),
        ("reaction_e_3_x", 22.642_494_786_394_29),
        ("reaction_e_3_y", 11.617_392_352_611_256),
    ];
    for (name, published) in multipliers {
        close(andrews.value(name), published, 1e-10, name);
    }
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
    let system = &systems("excavator", &loaded)[0];
    let mut excavator = Followed::new(system, 0.0).expect("as drawn");
    let names = linkwright_solver::derivatives::names(system);
    for step in 0..50 {
        assert!(excavator.advance(0.1 * f64::from(step)));
        let columns = excavator.derivatives();
        let column = |name: &str| {
            let place = names.iter().position(|it| it == name);
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
