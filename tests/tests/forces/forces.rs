//! Driving forces and reactions against a dense solve with loads in plain numbers, and the power balance, on every
//! description with masses, springs, dampers and forces put on it.

use linkwright::Equations;
use linkwright_codegen::stages::model::{Body, Role};
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::textbook::TextbookEquations;
use linkwright_tests::forces::{Followed, Moving, Weight, cross, moving, multipliers, systems};
use linkwright_tests::pantograph::Pantograph;
use linkwright_tests::{description, files};
use nalgebra::{DMatrix, DVector};

/// Duration of a motion (s); the number of frames follows.
const END: f64 = 0.5;
const FRAMES: u32 = 20;

/// Bound on rounding of a force, relative to the largest force of the instant.
const LIMIT: f64 = 1e-10;

const GRAVITY: [f64; 2] = [0.4, -9.81];

/// The weight that the test puts on a body.
fn weight(body: usize) -> Weight {
    let number = body as f64;
    Weight {
        body,
        mass: 1.0 + 0.25 * number,
        center: [
            0.05 * (number % 3.0 - 1.0),
            0.04 * ((number + 1.0) % 3.0 - 1.0),
        ],
        inertia: 0.02 + 0.01 * number,
    }
}

/// Description with loads on its bodies, and with all possible requests.
fn loaded(text: &str, derived: &Derived) -> String {
    let mechanism = &derived.system.mechanism;
    let bodies: Vec<&str> = mechanism
        .moving_bodies()
        .iter()
        .map(|it| it.name.as_str())
        .collect();
    let (first, last) = (bodies[0], bodies[bodies.len() - 1]);
    let mut loads = String::new();
    for (body, name) in bodies.iter().enumerate() {
        let Weight {
            mass,
            center: [x, y],
            inertia,
            ..
        } = weight(body);
        loads.push_str(&format!(
            "mass {name} = {mass} at ({x}, {y}) inertia {inertia};\n"
        ));
    }
    loads.push_str(&format!("gravity = ({}, {});\n", GRAVITY[0], GRAVITY[1]));
    loads.push_str(&format!(
        "spring about ({last}, ground) = 2 free 0.1 preload 0.5;\n"
    ));
    if bodies.len() > 1 {
        loads.push_str(&format!("damper about ({first}, {last}) = 0.3;\n"));
    }
    loads.push_str(&format!(
        "torque on {first} = 0.2*sin(t) - 0.1*rate(phi({first}));\n"
    ));
    loads.push_str(&format!(
        "force on {last} = (1.5, 3N/1m*x({first})) in {first};\n"
    ));
    loads.push_str("energy;\n");
    if has_efforts(derived) {
        loads.push_str("effort;\n");
    }
    if has_reactions(derived) {
        loads.push_str("reactions;\n");
    }
    let end = text.rfind('}').expect("a mechanism");
    format!("{}{loads}}}\n", &text[..end])
}

fn drivers(derived: &Derived) -> impl Iterator<Item = &linkwright_codegen::stages::model::Joint> {
    let joints = derived.system.mechanism.joints.iter();
    joints.filter(|it| it.role == Role::Driver)
}

fn has_efforts(derived: &Derived) -> bool {
    let valued = drivers(derived).all(|it| it.operands.value.is_some());
    valued && drivers(derived).next().is_some()
}

fn has_reactions(derived: &Derived) -> bool {
    derived
        .system
        .mechanism
        .joints
        .iter()
        .all(|it| it.redundant.is_none())
}

/// Loads on the bodies in plain numbers: Q − M q̈, the rate of the energies, and the power of the other loads.
struct Plain {
    loads: DVector<f64>,
    kinetic: [f64; 2],
    potential: [f64; 2],
    added: f64,
}

fn plain(bodies: usize, coordinates: usize, t: f64, at: &dyn Fn(usize) -> Moving) -> Plain {
    let mut loads = DVector::zeros(coordinates);
    let (mut kinetic, mut potential) = ([0.0; 2], [0.0; 2]);
    for body in 0..bodies {
        let (weight, moving) = (weight(body), at(body));
        let body_load = weight.load(GRAVITY, &moving);
        let energies = [weight.kinetic(&moving), weight.potential(GRAVITY, &moving)];
        for axis in 0..3 {
            loads[3 * body + axis] += body_load[axis];
        }
        for part in 0..2 {
            kinetic[part] += energies[0][part];
            potential[part] += energies[1][part];
        }
    }
    let last = bodies - 1;
    let (first, end) = (at(0), at(last));
    // The spring between the last body and the ground: 2 (0 − φ − 0.1) + 0.5 turns the body forward.
    let further = -end.at[2] - 0.1;
    let torque = 2.0 * further + 0.5;
    loads[3 * last + 2] += torque;
    potential[0] += further * further + 0.5 * further;
    potential[1] -= torque * end.rate[2];
    let mut added = 0.0;
    if bodies > 1 {
        let rate = end.rate[2] - first.rate[2];
        loads[2] += 0.3 * rate;
        loads[3 * last + 2] -= 0.3 * rate;
        added -= 0.3 * rate * rate;
    }
    let torque = 0.2 * t.sin() - 0.1 * first.rate[2];
    loads[2] += torque;
    added += torque * first.rate[2];
    let force = first.arm([1.5, 3.0 * first.at[0]]);
    for axis in 0..2 {
        loads[3 * last + axis] += force[axis];
        added += force[axis] * end.rate[axis];
    }
    Plain {
        loads,
        kinetic,
        potential,
        added,
    }
}

/// Force and moment of a joint on its second body, by the rows of Φ_q and the multipliers; the moment about the point
/// of the joint on that body. If the second body is the ground, the opposite of the load on the first.
fn wrench(
    derived: &Derived,
    joint: usize,
    jacobian: &DMatrix<f64>,
    multipliers: &DVector<f64>,
    at: &dyn Fn(usize) -> Moving,
) -> [f64; 3] {
    let joint_row = &derived.system.mechanism.joints[joint];
    let graph = &derived.pool.graph;
    let local = |mark: &linkwright_codegen::stages::joint::geometry::Mark| {
        mark.local
            .map(|part| graph.constant_value(part).expect("a number"))
    };
    let marks = &joint_row.operands.marks;
    let (first, second) = match &marks[..] {
        [only] => (None, *only),
        // A curve presses on its follower.
        [follower, curve, ..] if joint_row.operands.curve.is_some() => (Some(*curve), *follower),
        [first, second, ..] => (Some(*first), *second),
        [] => return [f64::NAN; 3],
    };
    let place = match second.frame.body.0 {
        0 => local(&second),
        body => {
            let (moving, arm) = (at(body - 1), at(body - 1).arm(local(&second)));
            [moving.at[0] + arm[0], moving.at[1] + arm[1]]
        }
    };
    let (body, sign) = match (second.frame.body.0, first) {
        (0, Some(first)) => (first.frame.body.0, 1.0),
        (0, None) => return [f64::NAN; 3],
        (body, _) => (body, -1.0),
    };
    let mut wrench = [0.0; 3];
    for (row, stated) in derived.system.rows.iter().enumerate() {
        if stated.joint == joint {
            for (axis, part) in wrench.iter_mut().enumerate() {
                *part += sign * jacobian[(row, 3 * (body - 1) + axis)] * multipliers[row];
            }
        }
    }
    let origin = at(body - 1).at;
    let arm = [place[0] - origin[0], place[1] - origin[1]];
    wrench[2] -= cross(arm, [wrench[0], wrench[1]]);
    if joint_row.kind.keyword.ends_with("gear") || joint_row.kind.keyword.ends_with("belt") {
        // The row has the slope 1 in the angle of the second wheel, whichever row constrains that angle.
        let row = derived
            .system
            .rows
            .iter()
            .position(|row| row.joint == joint);
        wrench[2] = -multipliers[row.expect("its row")];
    }
    wrench
}

/// Requested values at an instant against the dense solve, and the balance of powers.
fn compare(name: &str, derived: &Derived, followed: &Followed, t: f64) -> usize {
    let instant = followed.instant();
    let coordinates = derived.system.coordinates.len();
    let at = |body: usize| moving(body, instant);
    let plain = plain(
        derived.system.mechanism.moving_bodies().len(),
        coordinates,
        t,
        &at,
    );
    let textbook = TextbookEquations::new(&derived.pool, &derived.system);
    let q = DVector::from_column_slice(instant.q());
    let mut jacobian = DMatrix::zeros(coordinates, coordinates);
    textbook.jacobian(&q, t, &mut jacobian);
    let carried = multipliers(&jacobian, &plain.loads);
    let all = followed.all();
    let size = all
        .iter()
        .filter(|(name, _)| name.starts_with("effort") || name.starts_with("reaction"))
        .fold(plain.loads.amax(), |most, (_, value)| most.max(value.abs()));
    let mut compared = 0;
    let mut agree = |what: &str, expected: f64, size: f64| {
        let reported = followed.value(what);
        assert!(
            (reported - expected).abs() <= LIMIT * size.max(1.0),
            "{name} at t = {t}: {what} is {reported}, by the dense solve {expected}, beside {size}"
        );
        compared += 1;
    };
    for (place, own) in derived.system.mechanism.joints.iter().enumerate() {
        let slug = &own.slug;
        if own.role == Role::Driver && has_efforts(derived) {
            // The driver of one row that is its quantity less its value.
            let mut rows = derived.system.rows.iter().enumerate();
            let row = rows.position(|(_, it)| it.joint == place).expect("a row");
            let keyword = own.kind.keyword;
            if matches!(keyword, "phi" | "x" | "y" | "length") {
                agree(&format!("effort_{slug}"), -carried[row], size);
            }
        }
        if own.role == Role::Driver || !has_reactions(derived) {
            continue;
        }
        let [x, y, moment] = wrench(derived, place, &jacobian, &carried, &at);
        if x.is_nan() {
            continue;
        }
        for (column, _) in &all {
            let Some(component) = column.strip_prefix(&format!("reaction_{slug}_")) else {
                continue;
            };
            match component {
                "x" => agree(column, x, size),
                "y" => agree(column, y, size),
                "moment" => agree(column, moment, size),
                // The direction belongs to the joint; the force across it is zero.
                "normal" | "tension" | "tooth" | "pressure" => {
                    let magnitude = followed.value(column).abs();
                    assert!(
                        (magnitude - x.hypot(y)).abs() <= LIMIT * size,
                        "{name}: {column}"
                    );
                }
                _ => {}
            }
        }
    }
    agree("kinetic_energy", plain.kinetic[0], plain.kinetic[0].abs());
    agree(
        "potential_energy",
        plain.potential[0],
        plain.potential[0].abs(),
    );
    agree("added_power", plain.added, plain.added.abs());
    if has_efforts(derived) {
        let powers = all.iter().filter(|(name, _)| name.starts_with("power_"));
        let powers: Vec<f64> = powers.map(|(_, power)| *power).collect();
        let brought: f64 = powers.iter().sum::<f64>() + plain.added;
        let stored = plain.kinetic[1] + plain.potential[1];
        let size = powers
            .iter()
            .fold(stored.abs(), |most, it| most.max(it.abs()));
        assert!(
            (brought - stored).abs() <= LIMIT * size.max(1.0),
            "{name} at t = {t}: {brought} W are brought in, {stored} W stored"
        );
    }
    compared
}

/// Texts of all descriptions, the gallery's and those of the tests, and of a chain whose loops were shortened.
fn descriptions() -> Vec<(String, String)> {
    let folders = [
        files::repository().join("mechanisms"),
        files::package("descriptions"),
    ];
    let paths = folders
        .iter()
        .flat_map(|it| files::with_extension(it, "mech"));
    let named = paths.map(|path| {
        let name = files::stem(&path).to_string();
        let text = description::source(&name).text;
        (name, text)
    });
    let chain = Pantograph::new(6, 0.875).text("");
    named.chain([("chain".to_string(), chain)]).collect()
}

#[test]
fn forces_are_those_of_the_dense_solve_and_powers_balance() {
    let (mut mechanisms, mut compared) = (0, 0);
    for (name, text) in descriptions() {
        // A copy would not find the file, and descriptions with forces have loads of their own.
        if text.contains("\" in (") || text.contains("mass ") {
            continue;
        }
        for (place, derived) in systems(&name, &text).iter().enumerate() {
            // An angle without a body has no mass.
            if derived.system.mechanism.bodies.iter().any(Body::is_angle) {
                continue;
            }
            let text = loaded(&text, derived);
            let derived = &systems(&name, &text)[place];
            let Some(mut followed) = Followed::new(derived, 0.0) else {
                continue;
            };
            mechanisms += 1;
            for step in 0..=FRAMES {
                let t = END * f64::from(step) / f64::from(FRAMES);
                if step > 0 && !followed.advance(t) {
                    break;
                }
                compared += compare(&name, derived, &followed, t);
            }
        }
    }
    assert!(
        mechanisms > 70 && compared > 20_000,
        "{mechanisms} {compared}"
    );
}
