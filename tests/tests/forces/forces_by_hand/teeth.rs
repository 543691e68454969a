//! Forces of teeth against closed forms, and with other values of parameters.

use linkwright::{Blocks, FailureKind, Values};
use linkwright_solver::Interpreted;
use linkwright_tests::forces::{Followed, systems};

use super::{close, followed};

/// Two wheels on the ground, 60 mm apart, with radii of 20 and 40 mm, or of 60 and 120 mm one inside the other.
fn steady(kind: &str, angle: &str, torque: f64, speed: f64) -> Followed {
    followed(&format!(
        "mechanism steady {{
            point A = (0, 0), B = (60mm, 0);
            body 1 at A {{ A }}
            body 2 at B {{ B }}
            revolute A(ground, 1);
            revolute B(ground, 2);
            {kind} mesh(1, 2) = 20/40 pressure_angle {angle};
            drive phi(1) = {speed}*t;
            torque on 2 = {torque};
            effort; reactions;
        }}"
    ))
}

#[test]
fn a_pair_has_the_forces_of_the_textbook_for_both_flanks() {
    let (tangential, angle) = (5.0 / 0.04, 20_f64.to_radians());
    for speed in [3.0, -3.0, 0.0] {
        for torque in [5.0, -5.0] {
            // The load turns the second wheel; the teeth balance it at (20 mm, 0), 40 mm left of its axis.
            let mut pair = steady("external_gear", "20deg", torque, speed);
            assert!(pair.advance(0.3));
            let across = torque.signum() * tangential;
            let apart = tangential * angle.tan();
            for (name, expected) in [
                ("reaction_mesh_x", apart),
                ("reaction_mesh_y", across),
                ("reaction_mesh_moment", -torque),
                // A wheel that carries nothing else is held by the opposite force.
                ("reaction_b_x", -apart),
                ("reaction_b_y", -across),
                ("reaction_a_x", apart),
                ("reaction_a_y", across),
                ("effort_drive_phi_1", 0.5 * torque),
            ] {
                close(pair.value(name), expected, 1e-14, name);
            }
            let carried = pair.value("reaction_b_x").hypot(pair.value("reaction_b_y"));
            close(
                carried,
                tangential / angle.cos(),
                1e-14,
                "along the line of action",
            );
            // The pitch point of the internal pair is 60 mm left of the inner wheel's axis, 120 mm left of the ring's.
            let mut ring = steady("internal_gear", "14.5deg", torque, speed);
            assert!(ring.advance(0.3));
            let (tangential, angle) = (5.0 / 0.12, 14.5_f64.to_radians());
            let across = torque.signum() * tangential;
            for (name, expected) in [
                ("reaction_mesh_x", -tangential * angle.tan()),
                ("reaction_mesh_y", across),
                ("reaction_b_x", tangential * angle.tan()),
                ("reaction_b_y", -across),
                ("reaction_a_x", -tangential * angle.tan()),
                ("reaction_a_y", across),
                ("effort_drive_phi_1", -0.5 * torque),
            ] {
                close(ring.value(name), expected, 1e-14, name);
            }
            // Without an angle only the part across is left.
            let mut plain = steady("external_gear", "0deg", torque, speed);
            assert!(plain.advance(0.3));
            assert_eq!(plain.value("reaction_b_x"), 0.0);
            close(
                plain.value("reaction_b_y"),
                -torque.signum() * 125.0,
                1e-14,
                "across",
            );
        }
    }
}

/// A coaxial planetary gear: with the torque M on the sun of radius r, each mesh passes M/r on, the radial parts cancel where both
/// pressure angles are equal, and the pin of the planet carries 2 M/r across the carrier.
#[test]
fn the_pin_of_a_planet_carries_twice_the_force_of_a_mesh() {
    let mut gear = followed(
        "mechanism planet_of_the_textbook {
            point O = (0, 0), C = (35mm, 0);
            body sun at O { O }
            body carrier at O { O, C }
            body planet at C { C }
            revolute S(ground.O, sun.O);
            revolute R(ground.O, carrier.O);
            revolute C(carrier, planet);
            external_gear inner(sun, planet, carrier) = 20/15 pressure_angle 20deg;
            internal_gear outer(planet, ground, carrier) = 15/50 pressure_angle 20deg;
            drive phi(sun) = 7*t;
            torque on carrier = -7;
            effort; reactions;
        }",
    );
    for step in 0..20 {
        let t = 0.05 * f64::from(step);
        assert!(gear.advance(t));
        // The carrier turns by 2/7 of the sun; 7 Nm on it are 2 Nm on the sun and 5 Nm on the ring.
        let (sine, cosine) = (2.0 * t).sin_cos();
        let force = 2.0 / 0.02;
        close(gear.value("effort_drive_phi_sun"), 2.0, 1e-13, "the sun");
        close(gear.value("reaction_outer_moment"), -5.0, 1e-13, "the ring");
        close(
            gear.value("reaction_c_x"),
            2.0 * force * sine,
            1e-13,
            "the pin, x",
        );
        close(
            gear.value("reaction_c_y"),
            -2.0 * force * cosine,
            1e-13,
            "the pin, y",
        );
        // On the planet: across the carrier, and away from the sun.
        let outward = force * 20_f64.to_radians().tan();
        let expected = [
            outward * cosine - force * sine,
            outward * sine + force * cosine,
        ];
        for (axis, name) in ["x", "y"].into_iter().enumerate() {
            close(
                gear.value(&format!("reaction_inner_{name}")),
                expected[axis],
                1e-13,
                name,
            );
            // The shaft of the sun is pushed on by its bearing against the planet.
            close(
                gear.value(&format!("reaction_s_{name}")),
                expected[axis],
                1e-13,
                name,
            );
            close(
                gear.value(&format!("reaction_r_{name}")),
                gear.value(&format!("reaction_c_{name}")),
                1e-13,
                "what holds the carrier",
            );
        }
    }
}

/// A train in which each wheel but the ends is an idler, written with `repeat`: with the load T on the last of equal wheels the teeth
/// pass T/r on everywhere, and each idler's bearing carries twice that, whatever the pressure angle.
#[test]
fn idlers_of_a_train_carry_twice_the_force_of_a_mesh() {
    let mut train = followed(
        "mechanism train {
            repeat i from 1 to 5 {
                point W[i] = (80mm*i, 0);
                body wheel[i] at W[i] { W[i] }
                revolute W[i](ground, wheel[i]);
            }
            repeat i from 1 to 4 {
                external_gear mesh[i](wheel[i], wheel[i + 1]) = 1 pressure_angle 20deg;
            }
            drive phi(wheel[1]) = t;
            torque on wheel[5] = -4;
            effort; reactions;
        }",
    );
    assert!(train.advance(0.2));
    let apart = 100.0 * 20_f64.to_radians().tan();
    for wheel in 1..=5 {
        // The torque changes its sign from wheel to wheel, and the force at the pitch point with it.
        let sign = if wheel % 2 == 0 { -1.0 } else { 1.0 };
        let [x, y] = match wheel {
            1 => [apart, 100.0],
            5 => [-apart, 100.0],
            _ => [0.0, sign * 200.0],
        };
        close(train.value(&format!("reaction_w{wheel}_x")), x, 1e-13, "x");
        close(train.value(&format!("reaction_w{wheel}_y")), y, 1e-13, "y");
    }
    close(
        train.value("effort_drive_phi_wheel1"),
        4.0,
        1e-13,
        "the first wheel",
    );
}

/// Four wheels in a ring of meshes whose ratios are all parameters: the moments on each of them vanish together. With M on the second
/// wheel of a pair the first one has the ratio times M, the other way where both turn in one sense.
#[test]
fn wheels_whose_ratios_are_parameters_are_balanced() {
    let mut wheels = followed(
        "mechanism four_wheels {
            param a = 1.5;
            param b = 0.7;
            param c = 0.4;
            param d = 2.5;
            point O = (0, 0), C = (0.1, 0), D = (0.25, 0);
            body arm at O { O, C, D }
            body sun at O { O }
            body p at C { C }
            body q at D { D }
            body ring at O { O }
            revolute O(ground, arm);
            revolute S(ground.O, sun.O);
            revolute R(ground.O, ring.O);
            revolute C(arm, p);
            revolute D(arm, q);
            external_gear e(sun, p, arm) = a;
            external_gear f(p, q, arm) = b pressure_angle 20deg;
            internal_gear g(q, ring, arm) = c;
            belt h(sun, ring) = d;
            drive phi(ring) = t;
            torque on q = 3;
            effort; reactions;
        }",
    );
    assert!(wheels.advance(0.3));
    let [e, f, g, h] =
        ["e", "f", "g", "h"].map(|it| wheels.value(&format!("reaction_{it}_moment")));
    assert!(e.abs() > 1.0 && g.abs() > 0.1, "{e} {g}");
    close(1.5 * e - 2.5 * h, 0.0, 1e-13, "the sun");
    close(e + 0.7 * f, 0.0, 1e-13, "p");
    close(f - 0.4 * g + 3.0, 0.0, 1e-13, "q");
    let torque = wheels.value("effort_drive_phi_ring");
    close(g + h + torque, 0.0, 1e-13, "the ring");
    let force = wheels
        .value("reaction_f_x")
        .hypot(wheels.value("reaction_f_y"));
    let radius = 0.15 / 1.7;
    close(
        force,
        f.abs() / radius / 20_f64.to_radians().cos(),
        1e-13,
        "the teeth",
    );
}

/// A part with a pair of gears, turned: its forces turn with it.
#[test]
fn forces_of_teeth_turn_with_their_part() {
    let text = |place: &str| {
        format!(
            "mechanism two_wheels {{
                param size = 30mm;
                point A = (0, 0), B = (size, 0);
                body pinion at A {{ A }}
                body wheel at B {{ B }}
                revolute A(ground, pinion);
                revolute B(ground, wheel);
                external_gear mesh(pinion, wheel) = 1/2 pressure_angle 20deg;
            }}
            mechanism whole {{
                part here = two_wheels(size = 60mm){place};
                drive phi(here.pinion) = t;
                torque on here.wheel = -5;
                reactions;
            }}"
        )
    };
    let [straight, turned] = [text(""), text(" at (1, 2) turned 30deg")].map(|it| followed(&it));
    let force = |it: &Followed| ["x", "y"].map(|axis| it.value(&format!("reaction_here_b_{axis}")));
    let [[x, y], found] = [force(&straight), force(&turned)];
    close(x, -125.0 * 20_f64.to_radians().tan(), 1e-14, "x");
    let (sine, cosine) = 30_f64.to_radians().sin_cos();
    close(found[0], cosine * x - sine * y, 1e-13, "x, turned");
    close(found[1], sine * x + cosine * y, 1e-13, "y, turned");
}

/// What changes at run time moves the pitch point, and what leaves no pitch circles is refused.
#[test]
fn pitch_radii_follow_parameters() {
    for kind in ["external_gear", "internal_gear"] {
        let text = format!(
            "mechanism given {{
                param arm = 60mm;
                param ratio = 1/2;
                param slope = 20deg;
                point A = (0, 0), B = (arm, 0);
                body 1 at A {{ A }}
                body 2 at B {{ B }}
                revolute A(ground, 1);
                revolute B(ground, 2);
                {kind} mesh(1, 2) = ratio pressure_angle slope;
                drive phi(1) = 0.1*t;
                torque on 2 = -5;
                effort; reactions;
            }}"
        );
        let mut pair = followed(&text);
        let blocks = Interpreted::new(&systems("given", &text)[0]).expect("blocks");
        let nominal = blocks.nominal_parameters();
        for (step, [arm, ratio, slope]) in [[0.09, 0.5, 0.3], [0.06, 3.0, 0.3], [0.03, 0.25, 0.0]]
            .into_iter()
            .enumerate()
        {
            let mut values = nominal.clone();
            for (place, value) in [arm, ratio, slope].into_iter().enumerate() {
                values.set(place, value);
            }
            pair.shell.set_parameters(&values).expect("allowed");
            assert!(pair.advance(0.01 * (1.0 + step as f64)));
            let radius = match kind {
                "external_gear" => arm / (1.0 + ratio),
                _ => arm / f64::abs(1.0 - ratio),
            };
            let force = 5.0 / radius;
            // Inside, the larger second wheel is touched on its left, and a smaller one on its right.
            let across = match kind == "internal_gear" && ratio > 1.0 {
                true => force,
                false => -force,
            };
            let along = match kind {
                "external_gear" => force * slope.tan(),
                _ => -force * slope.tan(),
            };
            close(pair.value("reaction_mesh_x"), along, 1e-13, "along");
            close(pair.value("reaction_mesh_y"), across, 1e-13, "across");
            close(
                pair.value("reaction_b_x"),
                -along,
                1e-13,
                "the bearing, along",
            );
            close(
                pair.value("reaction_b_y"),
                -across,
                1e-13,
                "the bearing, across",
            );
        }
        let mut refused = vec![
            (0, 0.0, "the distance of the axes"),
            (2, -0.1, "the pressure angle, unless zero,"),
            (2, 1.6, "the right angle less the pressure angle"),
        ];
        if kind == "internal_gear" {
            refused.push((1, 1.0, "the difference of the radii"));
        }
        for (place, value, said) in refused {
            let mut values = nominal.clone();
            values.set(place, value);
            let failure = pair.shell.set_parameters(&values).expect_err(said);
            assert!(
                matches!(failure.kind, FailureKind::NotPositive { .. }),
                "{said}"
            );
            let words = blocks.explained(&failure).to_string();
            assert!(
                words.starts_with(&format!("{kind} mesh(1, 2): {said}")),
                "{words}"
            );
        }
    }
}
