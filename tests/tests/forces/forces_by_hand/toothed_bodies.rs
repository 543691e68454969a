//! Bodies on gears cut free: the forces at the pitch points balance each of them, by the equations of Newton and Euler.

use linkwright_solver::{Dense, View};
use linkwright_tests::description;
use linkwright_tests::forces::{Followed, Weight, cross, moving, systems};

use super::{close, followed};

/// A point of a body by its place among those that move; of the ground where there is none.
type At = (Option<usize>, [f64; 2]);

/// Force or moment on a second body and its opposite on a first one.
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
    let derived = &systems("teeth", &case.text)[0];
    let mut motion = Followed::new(derived, 0.0).expect("as drawn");
    let dense = Dense::new(derived);
    for step in 0..40 {
        let t = 0.037 * f64::from(step);
        assert!(motion.advance(t));
        let [size, worst] = imbalance(case, &motion, t);
        assert!(worst <= 1e-12 * size, "{worst} beside {size} at t = {t}");
        let at_once = dense.reported(motion.instant()).expect("regular");
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
