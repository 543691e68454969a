//! Forces of teeth against closed forms, and against the balance of every body cut free with the force at the pitch point alone.

use linkwright::{Blocks, FailureKind, Values};
use linkwright_solver::dense::Dense;
use linkwright_solver::interpreted::Interpreted;
use linkwright_solver::view::View;
use linkwright_tests::description;
use linkwright_tests::forces::{Followed, Weight, cross, moving, systems};
use linkwright_tests::simulated::{options, simulation};

use super::{close, followed};

/// A point of a body by its place among those that move; of the ground where there is none.
type At = (Option<usize>, [f64; 2]);

/// What passes a force on to its second body, and the opposite to its first.
enum Passes {
    /// A force through a point, of this name.
    Pin(&'static str, [At; 2]),
    /// The force of teeth on the second wheel, with the axes of both, the ratio of radii and the pressure angle in degrees.
    Teeth {
        name: &'static str,
        wheels: [Option<usize>; 2],
        axes: [At; 2],
        ratio: f64,
        is_internal: bool,
        degrees: f64,
    },
    /// A torque of this name.
    Torque(&'static str, [Option<usize>; 2]),
    /// A force along x or y of this name, through the origin of a body.
    Push(&'static str, usize, usize),
    /// A torque that is given.
    Given(usize, fn(f64) -> f64),
}

/// A mechanism with the weights of its bodies, and what passes forces on.
struct Case {
    text: String,
    gravity: [f64; 2],
    weights: Vec<Weight>,
    passes: Vec<Passes>,
}

fn position((body, local): At, followed: &Followed) -> [f64; 2] {
    let Some(body) = body else {
        return local;
    };
    let moving = moving(body, followed.instant());
    let [x, y] = moving.arm(local);
    [moving.at[0] + x, moving.at[1] + y]
}

/// The pitch point, and true for each of the wheels whose teeth are outside.
fn pitch_point(axes: [[f64; 2]; 2], ratio: f64, is_internal: bool) -> ([f64; 2], [bool; 2]) {
    let [from, to] = axes;
    let gap = [to[0] - from[0], to[1] - from[1]];
    let distance = gap[0].hypot(gap[1]);
    let along = [gap[0] / distance, gap[1] / distance];
    // Radii of i and j with r_i = ratio r_j: their sum, or their difference, is the distance.
    let second = match is_internal {
        false => distance / (1.0 + ratio),
        true => distance / (1.0 - ratio).abs(),
    };
    let first = ratio * second;
    // Inside a larger second wheel the first one touches it on the far side of its own axis.
    let reach = match (is_internal, first < second) {
        (true, true) => -first,
        _ => first,
    };
    let place = [from[0] + reach * along[0], from[1] + reach * along[1]];
    let outer = match (is_internal, first < second) {
        (false, _) => [true, true],
        (true, is_first_inside) => [is_first_inside, !is_first_inside],
    };
    (place, outer)
}

/// The size of the largest force, and what is left of the balances of all bodies, about the origin.
fn imbalance(case: &Case, followed: &Followed, t: f64) -> [f64; 2] {
    let bodies = followed.instant().q().len() / 3;
    let mut sums = vec![[0.0; 3]; bodies];
    let mut size = 1.0_f64;
    let mut act = |body: Option<usize>, place: [f64; 2], force: [f64; 2], torque: f64| {
        size = size.max(force[0].hypot(force[1])).max(torque.abs());
        if let Some(body) = body {
            sums[body][0] += force[0];
            sums[body][1] += force[1];
            sums[body][2] += cross(place, force) + torque;
        }
    };
    for weight in &case.weights {
        let moving = moving(weight.body, followed.instant());
        let load = weight.load(case.gravity, &moving);
        act(
            Some(weight.body),
            [moving.at[0], moving.at[1]],
            [load[0], load[1]],
            load[2],
        );
    }
    let force =
        |name: &str| ["x", "y"].map(|axis| followed.value(&format!("reaction_{name}_{axis}")));
    for passes in &case.passes {
        match passes {
            Passes::Pin(name, at) => {
                let [x, y] = force(name);
                act(at[0].0, position(at[0], followed), [-x, -y], 0.0);
                act(at[1].0, position(at[1], followed), [x, y], 0.0);
            }
            Passes::Teeth {
                name,
                wheels,
                axes,
                ratio,
                is_internal,
                degrees,
            } => {
                let [x, y] = force(name);
                let axes = axes.map(|it| position(it, followed));
                let (place, outer) = pitch_point(axes, *ratio, *is_internal);
                act(wheels[0], place, [-x, -y], 0.0);
                act(wheels[1], place, [x, y], 0.0);
                // Along the line of action, into the material of both wheels.
                let arm = [place[0] - axes[1][0], place[1] - axes[1][1]];
                let radius = arm[0].hypot(arm[1]);
                let outward = (arm[0] * x + arm[1] * y) / radius;
                let across = cross(arm, [x, y]) / radius;
                let expected = across.abs() * degrees.to_radians().tan();
                let into = if outer[1] { -outward } else { outward };
                close(into, expected, 1e-12, name);
                let moment = followed.value(&format!("reaction_{name}_moment"));
                close(across * radius, moment, 1e-12, name);
            }
            Passes::Torque(name, [first, second]) => {
                let torque = followed.value(name);
                act(*first, [0.0; 2], [0.0; 2], -torque);
                act(*second, [0.0; 2], [0.0; 2], torque);
            }
            Passes::Push(name, body, axis) => {
                let mut force = [0.0; 2];
                force[*axis] = followed.value(name);
                act(
                    Some(*body),
                    position((Some(*body), [0.0; 2]), followed),
                    force,
                    0.0,
                );
            }
            Passes::Given(body, torque) => act(Some(*body), [0.0; 2], [0.0; 2], torque(t)),
        }
    }
    let worst = sums
        .iter()
        .flatten()
        .fold(0.0_f64, |most, it| most.max(it.abs()));
    [size, worst]
}

/// Follows a case: every body is balanced, and all equations at once give the same forces.
fn balance(case: &Case) {
    let system = &systems("teeth", &case.text)[0];
    let mut motion = Followed::new(system, 0.0).expect("as drawn");
    let dense = Dense::new(system);
    for step in 0..40 {
        let t = 0.037 * f64::from(step);
        assert!(motion.advance(t));
        let [size, worst] = imbalance(case, &motion, t);
        assert!(worst <= 1e-12 * size, "{worst} beside {size} at t = {t}");
        let at_once = dense.forces(motion.instant()).expect("regular");
        for ((name, one), other) in motion.all().into_iter().zip(at_once) {
            assert!((one - other).abs() <= 1e-11 * size, "{name}: {one} {other}");
        }
    }
}

fn weight(body: usize, mass: f64, center: [f64; 2], inertia: f64) -> Weight {
    Weight {
        body,
        mass,
        center,
        inertia,
    }
}

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

/// Müller's coaxial gear: with the torque M on the sun of radius r, each mesh passes M/r on, the radial parts cancel where both
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

#[test]
fn all_bodies_of_a_planetary_gear_are_balanced_by_the_forces_at_the_pitch_points() {
    let [sun, carrier, planet] = [Some(0), Some(1), Some(2)];
    let [axis, pin] = [(None, [0.0; 2]), (carrier, [0.035, 0.0])];
    balance(&Case {
        text: description::source("toothed_planetary").text,
        gravity: [1.0, -9.81],
        weights: vec![
            weight(0, 0.4, [0.001, 0.002], 0.0001),
            weight(1, 0.7, [0.015, 0.001], 0.0006),
            weight(2, 0.2, [0.002, -0.001], 0.00004),
        ],
        passes: vec![
            Passes::Pin("s", [axis, (sun, [0.0; 2])]),
            Passes::Pin("r", [axis, (carrier, [0.0; 2])]),
            Passes::Pin("c", [pin, (planet, [0.0; 2])]),
            Passes::Teeth {
                name: "inner",
                wheels: [sun, planet],
                axes: [axis, pin],
                ratio: 20.0 / 15.0,
                is_internal: false,
                degrees: 20.0,
            },
            Passes::Teeth {
                name: "outer",
                wheels: [planet, None],
                axes: [pin, axis],
                ratio: 15.0 / 50.0,
                is_internal: true,
                degrees: 22.0,
            },
            Passes::Torque("effort_input_shaft", [None, sun]),
            Passes::Given(1, |t| -7.0 * (2.0 * t).cos()),
        ],
    });
}

/// A carrier that is moved about, with a pinion that drives a ring and an idler beside it; the ring is the first wheel of its pair.
#[test]
fn all_bodies_on_a_carrier_that_is_moved_about_are_balanced() {
    let [carrier, pinion, ring, idler] = [Some(0), Some(1), Some(2), Some(3)];
    let [at_pinion, at_ring, at_idler] = [
        (carrier, [0.02, 0.01]),
        (carrier, [0.05, 0.05]),
        (carrier, [-0.03, 0.06]),
    ];
    balance(&Case {
        text: "mechanism moved_about {
            point P = (0.02, 0.01), R = (0.05, 0.05), I = (-0.03, 0.06);
            body carrier at (0, 0) { P, R, I }
            body pinion at P { P: (2mm, 1mm) }
            body ring at R turned 20deg { R }
            body idler at I { I }
            revolute P(pinion, carrier);
            revolute R(carrier, ring);
            revolute I(carrier, idler);
            internal_gear large(ring, pinion, carrier) = 50/20 pressure_angle 25deg;
            external_gear small(idler, pinion, carrier) = 3 pressure_angle 15deg;
            drive forth: x(carrier) = 0.1*sin(3*t);
            drive up: y(carrier) = 0.2*sin(2*t);
            drive tilt: phi(carrier) = sin(4*t);
            drive spin: relative_angle(carrier, pinion) = 5*t - sin(7*t);
            mass carrier = 3kg at (0.01, 0.02) inertia 0.01;
            mass pinion = 0.3kg at (1mm, 2mm) inertia 0.0002;
            mass ring = 2kg at (3mm, 0) inertia 0.004;
            mass idler = 0.5kg at (0, 4mm) inertia 0.001;
            gravity = (0, -9.81);
            torque on ring = 3Nm*cos(5*t);
            torque on idler = -2Nm;
            effort; reactions;
        }"
        .to_string(),
        gravity: [0.0, -9.81],
        weights: vec![
            weight(0, 3.0, [0.01, 0.02], 0.01),
            weight(1, 0.3, [0.001, 0.002], 0.0002),
            weight(2, 2.0, [0.003, 0.0], 0.004),
            weight(3, 0.5, [0.0, 0.004], 0.001),
        ],
        passes: vec![
            Passes::Pin("p", [(pinion, [0.002, 0.001]), at_pinion]),
            Passes::Pin("r", [at_ring, (ring, [0.0; 2])]),
            Passes::Pin("i", [at_idler, (idler, [0.0; 2])]),
            Passes::Teeth {
                name: "large",
                wheels: [ring, pinion],
                axes: [at_ring, at_pinion],
                ratio: 2.5,
                is_internal: true,
                degrees: 25.0,
            },
            Passes::Teeth {
                name: "small",
                wheels: [idler, pinion],
                axes: [at_idler, at_pinion],
                ratio: 3.0,
                is_internal: false,
                degrees: 15.0,
            },
            Passes::Push("effort_forth", 0, 0),
            Passes::Push("effort_up", 0, 1),
            Passes::Torque("effort_tilt", [None, carrier]),
            Passes::Torque("effort_spin", [carrier, pinion]),
            Passes::Given(2, |t| 3.0 * (5.0 * t).cos()),
            Passes::Given(3, |_| -2.0),
        ],
    });
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

/// Two planets share the load as `least_norm` has them; every body is balanced by what is said then.
#[test]
fn two_planets_that_share_a_load_are_balanced() {
    let [sun, carrier, first, second] = [Some(0), Some(1), Some(2), Some(3)];
    let [axis, at_first, at_second] = [
        (None, [0.0; 2]),
        (carrier, [0.035, 0.0]),
        (carrier, [-0.035, 0.0]),
    ];
    let teeth = |name, wheels, axes, ratio, is_internal| Passes::Teeth {
        name,
        wheels,
        axes,
        ratio,
        is_internal,
        degrees: 20.0,
    };
    let case = Case {
        text: "mechanism shared {
            point O = (0, 0), C = (35mm, 0), D = (-35mm, 0);
            body sun at O { O }
            body carrier at O { O, C, D }
            body 1 at C { C }
            body 2 at D { D }
            revolute S(ground.O, sun.O);
            revolute R(ground.O, carrier.O);
            revolute C(carrier, 1);
            revolute D(carrier, 2);
            external_gear c_sun(sun, 1, carrier) = 20/15 pressure_angle 20deg;
            internal_gear c_ring(1, ground, carrier) = 15/50 pressure_angle 20deg;
            external_gear d_sun(sun, 2, carrier) = 20/15 pressure_angle 20deg;
            redundant internal_gear d_ring(2, ground, carrier) = 15/50 pressure_angle 20deg;
            drive phi(sun) = 3*t + sin(2*t);
            mass carrier = 2kg at (2mm, 1mm) inertia 0.002;
            mass 1 = 0.2kg inertia 0.0001;
            gravity = (0, -9.81);
            torque on carrier = -7;
            effort; reactions; least_norm;
        }"
        .to_string(),
        gravity: [0.0, -9.81],
        weights: vec![
            weight(1, 2.0, [0.002, 0.001], 0.002),
            weight(2, 0.2, [0.0; 2], 0.0001),
        ],
        passes: vec![
            Passes::Pin("s", [axis, (sun, [0.0; 2])]),
            Passes::Pin("r", [axis, (carrier, [0.0; 2])]),
            Passes::Pin("c", [at_first, (first, [0.0; 2])]),
            Passes::Pin("d", [at_second, (second, [0.0; 2])]),
            teeth("c_sun", [sun, first], [axis, at_first], 20.0 / 15.0, false),
            teeth("c_ring", [first, None], [at_first, axis], 0.3, true),
            teeth(
                "d_sun",
                [sun, second],
                [axis, at_second],
                20.0 / 15.0,
                false,
            ),
            teeth("d_ring", [second, None], [at_second, axis], 0.3, true),
            Passes::Torque("effort_drive_phi_sun", [None, sun]),
            Passes::Given(1, |_| -7.0),
        ],
    };
    balance(&case);
    let mut motion = followed(&case.text);
    assert!(motion.advance(0.1));
    // Neither carries all of it.
    let shares = ["c_ring", "d_ring"].map(|it| motion.value(&format!("reaction_{it}_moment")));
    assert!(shares.iter().all(|it| *it < -1.0), "{shares:?}");
}

/// The text without its pressure angles.
fn without(text: &str) -> String {
    let mut parts = text.split(" pressure_angle ");
    let mut whole = parts.next().unwrap_or_default().to_string();
    for part in parts {
        let (_, rest) = part.split_once(';').expect("the end of the statement");
        whole.push(';');
        whole.push_str(rest);
    }
    whole
}

/// What the teeth add in the bearings changes no bit of anything else: pose, rates, accelerations, efforts, powers, energies, the
/// moments of gears and what other joints carry.
#[test]
fn motion_and_efforts_keep_their_bits() {
    let linked = "mechanism linked {
        param reach = 0.3;
        point A = (0, 0), B = (0.2, 0.5), C = (0.8, 1), D = (1.2, 0.4), E = (1, 0), H = (0, reach);
        body 1 at A facing A -> B { A, B }
        body 2 at B facing B -> C { B, C }
        body 3 at D facing D -> C { D, C }
        body 4 at E facing E -> D { E, D }
        body 5 at H { H }
        revolute A(ground, 1);
        revolute B(1, 2);
        revolute C(2, 3);
        revolute D(3, 4);
        revolute E(ground, 4);
        revolute H(ground, 5);
        external_gear main(1, 4) = 1/2 pressure_angle 20deg;
        external_gear (5, 1) = reach/0.4 pressure_angle 14.5deg;
        drive crank: phi(1) = 1.2 + sin(t)/4;
        mass 2 = 2kg at (0.1, 0.2) inertia 0.1;
        mass 3 = 1kg at (0.3, 0) inertia 0.2;
        mass 5 = 1kg at (0.01, 0) inertia 0.03;
        gravity = (0, -9.81);
        spring (2.C, ground.E) = 50 free 0.3;
        effort; reactions; energy;
    }";
    let planetary = description::source("toothed_planetary").text;
    for text in [linked, &planetary] {
        let plain = without(text);
        assert!(!plain.contains("pressure_angle"));
        let [mut with, mut without] = [text, &plain].map(followed);
        let (mut same, mut other) = (0, 0);
        for step in 0..60 {
            let t = 0.02 * f64::from(step);
            assert!(with.advance(t) && without.advance(t));
            let bits = |it: &Followed| {
                let instant = it.instant();
                let levels = [instant.q(), instant.qd(), instant.qdd()].concat();
                levels.into_iter().map(f64::to_bits).collect::<Vec<u64>>()
            };
            assert_eq!(bits(&with), bits(&without));
            for (name, value) in without.all() {
                let found = with.value(name);
                let is_bearing = ["_a_", "_e_", "_h_", "_s_", "_r_", "_c_"];
                let is_bearing = is_bearing.iter().any(|it| name.contains(it));
                match is_bearing && name.starts_with("reaction") {
                    true if found.to_bits() != value.to_bits() => other += 1,
                    true => {}
                    false => {
                        assert_eq!(found.to_bits(), value.to_bits(), "{name} at t = {t}");
                        same += 1;
                    }
                }
            }
        }
        assert!(same > 200 && other > 200, "{same} {other}");
    }
}

/// What forces move is moved alike.
#[test]
fn a_free_gear_moves_as_without_the_force_of_its_teeth() {
    let text = "mechanism hoist {
        point A = (0, 0), B = (60mm, 0);
        body 1 at A { A }
        body 2 at B { B, S: (0, -30mm) }
        revolute A(ground, 1);
        revolute B(ground, 2);
        external_gear mesh(1, 2) = 20/40 pressure_angle 20deg;
        free swing: phi(2) = 1 rate 2;
        mass 1 = 1kg inertia 0.002;
        mass 2 = 2kg at S inertia 0.003;
        gravity = (0, -9.81);
        reactions;
    }";
    let plain = without(text);
    let [with, without] = [text, &plain].map(|text| {
        let mut run = simulation(text, 0.5, options(1e-9));
        let start = run.frame().qdd()[5];
        run.advance(0.5).expect("no end");
        let frame = run.frame();
        let end = [frame.q(), frame.qd(), frame.qdd()].concat();
        (
            start,
            end.into_iter().map(f64::to_bits).collect::<Vec<u64>>(),
        )
    });
    assert_eq!(with.1, without.1);
    // (I₂ + m s² + 4 I₁) φ̈ = −m g s sin φ, with the first wheel twice as fast.
    let inertia = 0.003 + 2.0 * 0.03 * 0.03 + 4.0 * 0.002;
    let expected = -2.0 * 9.81 * 0.03 * 1_f64.sin() / inertia;
    close(with.0, expected, 1e-13, "the swing");
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
