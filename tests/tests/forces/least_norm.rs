//! Reactions of redundant joints with the least norm, against a pseudo-inverse of free bodies that are written out by
//! hand.

use linkwright_codegen::diagnostic::Source;
use linkwright_solver::{Dense, View};
use linkwright_tests::forces::{Followed, Weight, cross, moving, systems};
use nalgebra::{DMatrix, DVector};

const GRAVITY: [f64; 2] = [1.3, -9.81];

/// Force or moment on a second body and its opposite on a first one; body 0 is the ground.
enum Passes {
    /// Force through a named point.
    Pin(&'static str, [usize; 2]),
    /// Force to the left of a direction through a point, and a moment about it.
    Slide([usize; 2], [f64; 2], &'static str),
    /// Force along the line between two points; tension pulls them together.
    Rod([&'static str; 2], [usize; 2]),
    /// Multiplier of an equation between angles: it turns the second body back, and the first one forward.
    Angles([usize; 2]),
    /// A torque.
    Torque(usize),
    /// Force of a driver along a direction through a point.
    Push(usize, [f64; 2], &'static str),
}

/// Mechanism with its weights, its reactions in order, and its driver last.
struct Case {
    name: &'static str,
    text: String,
    weights: Vec<Weight>,
    passes: Vec<Passes>,
}

fn weight(body: usize) -> Weight {
    let number = body as f64;
    Weight {
        body,
        mass: 1.0 + 0.5 * number,
        center: [0.1 * number - 0.1, 0.07],
        inertia: 0.02 + 0.01 * number,
    }
}

/// The statements of the weights.
fn written(weights: &[Weight], names: &[&str]) -> String {
    let masses = weights.iter().zip(names).map(|(weight, name)| {
        let Weight {
            mass,
            center: [x, y],
            inertia,
            ..
        } = weight;
        format!("mass {name} = {mass} at ({x:?}, {y:?}) inertia {inertia:?};\n")
    });
    let masses: String = masses.collect();
    format!(
        "{masses} gravity = ({}, {}); reactions; effort; least_norm;",
        GRAVITY[0], GRAVITY[1]
    )
}

/// Cranks, two of which suffice to guide the coupler.
fn cranks(count: usize) -> Case {
    let mut text = "mechanism cranks {\n".to_string();
    let pivots = ["A", "B", "C", "D"];
    let pins = ["K", "L", "M", "N"];
    let weights: Vec<Weight> = (0..=count).map(weight).collect();
    let bodies = ["1", "2", "3", "4", "5"];
    let mut passes = Vec::new();
    for place in 0..count {
        let (pivot, pin, x) = (pivots[place], pins[place], place as f64);
        text.push_str(&format!(
            "point {pivot} = ({x}, 0), {pin} = ({x} + 0.3, 0.4);\n"
        ));
    }
    for place in 0..count {
        let (pivot, pin, body) = (pivots[place], pins[place], bodies[place]);
        text.push_str(&format!("body {body} at {pivot} {{ {pivot}, {pin} }}\n"));
    }
    let coupler = bodies[count];
    let carried = pins[..count].join(", ");
    text.push_str(&format!("body {coupler} at K {{ {carried} }}\n"));
    for place in 0..count {
        text.push_str(&format!(
            "revolute {}(ground, {});\n",
            pivots[place], bodies[place]
        ));
        passes.push(Passes::Pin(pivots[place], [0, place + 1]));
    }
    for place in 0..count {
        let mark = if place > 1 { "redundant " } else { "" };
        let (pin, body) = (pins[place], bodies[place]);
        text.push_str(&format!("{mark}revolute {pin}({body}, {coupler});\n"));
        passes.push(Passes::Pin(pin, [place + 1, count + 1]));
    }
    passes.push(Passes::Torque(1));
    text.push_str(&written(&weights, &bodies[..=count]));
    text.push_str("drive phi(1) = 0.3*sin(3*t);\n}\n");
    Case {
        name: "cranks",
        text,
        weights,
        passes,
    }
}

/// Two cranks on a coupler, and a redundant equation of their angles.
fn alike() -> Case {
    let Case {
        text,
        weights,
        mut passes,
        ..
    } = cranks(2);
    let equation = "redundant equation even: phi(2) = phi(1);\n";
    let driver = text.find("drive").expect("a driver");
    passes.insert(passes.len() - 1, Passes::Angles([1, 2]));
    Case {
        name: "alike",
        text: format!("{}{equation}{}", &text[..driver], &text[driver..]),
        weights,
        passes,
    }
}

/// Carriage on two rails, both of which constrain its angle.
fn rails() -> Case {
    let weights = [weight(1)];
    let text = format!(
        "mechanism rails {{
            point P = (0, 0), Q = (0.4, 0.2), R = (0.1, 0.5), S = (0.7, 0.8);
            body carriage at Q {{ Q, S }}
            translational (ground, carriage) along P -> Q;
            redundant translational (ground, carriage) along R -> S;
            {}
            drive length(P, Q) = 0.1*sin(3*t) + 0.45;
        }}",
        written(
            &[Weight {
                body: 0,
                ..weights[0]
            }],
            &["carriage"]
        )
    );
    let size = 0.2_f64.hypot(0.4);
    let along = [0.4 / size, 0.2 / size];
    Case {
        name: "rails",
        text,
        weights: vec![Weight {
            body: 0,
            ..weights[0]
        }],
        passes: vec![
            Passes::Slide([0, 1], along, "Q"),
            Passes::Slide([0, 1], along, "S"),
            Passes::Push(1, along, "Q"),
        ],
    }
}

/// Platform on three parallel rods, of which the third one is redundant.
fn rods() -> Case {
    let weights: Vec<Weight> = (0..3).map(weight).collect();
    let text = format!(
        "mechanism rods {{
            point A = (0, 0), B = (1, 0), C = (1.7, -0.2), K = (0.3, 0.4), L = (1.3, 0.4), M = (2, 0.2);
            body 1 at A {{ A, K }}
            body 2 at B {{ B, L }}
            body 3 at K {{ K, L, M }}
            revolute A(ground, 1);
            revolute B(ground, 2);
            revolute K(1, 3);
            revolute L(2, 3);
            redundant relative_distance (ground.C, 3.M) = 0.5;
            {}
            drive phi(1) = 0.3*sin(3*t);
        }}",
        written(&weights, &["1", "2", "3"])
    );
    Case {
        name: "rods",
        text,
        weights,
        passes: vec![
            Passes::Pin("A", [0, 1]),
            Passes::Pin("B", [0, 2]),
            Passes::Pin("K", [1, 3]),
            Passes::Pin("L", [2, 3]),
            Passes::Rod(["C", "M"], [0, 3]),
            Passes::Torque(1),
        ],
    }
}

/// Balance of every body as columns of the reactions and the driver, and the weights of the components; the driver
/// has none.
fn balance(followed: &Followed, case: &Case, length: f64) -> (DMatrix<f64>, Vec<Option<f64>>) {
    let view = followed.shell.blocks();
    let outputs = &view.system().outputs;
    let points = view.points(followed.instant());
    let place = |name: &str| {
        let at = outputs.iter().position(|it| it.name == name);
        at.map(|at| points[at].position)
    };
    let ground = |name: &str| match name {
        "C" => [1.7, -0.2],
        _ => panic!("no point {name}"),
    };
    let place = |name: &str| place(name).unwrap_or_else(|| ground(name));
    let bodies = followed.instant().q().len() / 3;
    let mut columns: Vec<DVector<f64>> = Vec::new();
    let mut weights = Vec::new();
    let mut exert = |[first, second]: [usize; 2], at: [f64; 2], force: [f64; 2], moment: f64| {
        let mut column = DVector::zeros(3 * bodies);
        for (body, sign) in [(first, -1.0), (second, 1.0)] {
            if body == 0 {
                continue;
            }
            let q = &followed.instant().q()[3 * (body - 1)..];
            let arm = [at[0] - q[0], at[1] - q[1]];
            for axis in 0..2 {
                column[3 * (body - 1) + axis] += sign * force[axis];
            }
            column[3 * (body - 1) + 2] += sign * (cross(arm, force) + moment);
        }
        columns.push(column);
    };
    for passes in &case.passes {
        match passes {
            Passes::Pin(name, bodies) => {
                exert(*bodies, place(name), [1.0, 0.0], 0.0);
                exert(*bodies, place(name), [0.0, 1.0], 0.0);
                weights.extend([Some(1.0); 2]);
            }
            Passes::Slide(bodies, along, name) => {
                exert(*bodies, place(name), [-along[1], along[0]], 0.0);
                exert(*bodies, place(name), [0.0; 2], 1.0);
                weights.extend([Some(1.0), Some(1.0 / length)]);
            }
            Passes::Rod([from, to], bodies) => {
                let [from, to] = [place(from), place(to)];
                let gap = [from[0] - to[0], from[1] - to[1]];
                let size = gap[0].hypot(gap[1]);
                exert(*bodies, to, gap.map(|it| it / size), 0.0);
                weights.push(Some(1.0));
            }
            Passes::Angles([first, second]) => {
                exert([*second, *first], [0.0; 2], [0.0; 2], 1.0);
                weights.push(Some(1.0 / length));
            }
            Passes::Torque(body) => {
                exert([0, *body], [0.0; 2], [0.0; 2], 1.0);
                weights.push(None);
            }
            Passes::Push(body, along, name) => {
                exert([0, *body], place(name), *along, 0.0);
                weights.push(None);
            }
        }
    }
    (DMatrix::from_columns(&columns), weights)
}

/// Solution x of B x = f whose weighted components are least, by singular values: (1 − D D⁺) removes the part of the
/// drivers.
fn least(balance: &DMatrix<f64>, weights: &[Option<f64>], load: &DVector<f64>) -> DVector<f64> {
    let is_joint = |column: &usize| weights[*column].is_some();
    let (joints, drivers): (Vec<usize>, Vec<usize>) = (0..weights.len()).partition(is_joint);
    let joint_balance = balance.select_columns(&joints);
    let driven = balance.select_columns(&drivers);
    let inverse = |matrix: &DMatrix<f64>| {
        let svd = matrix.clone().svd(true, true);
        let largest = svd.singular_values.max();
        svd.pseudo_inverse(1e-11 * largest).expect("finite")
    };
    let rest = DMatrix::identity(load.len(), load.len()) - &driven * inverse(&driven);
    let scales = joints
        .iter()
        .map(|&column| 1.0 / weights[column].expect("a weight"));
    let scales = DVector::from_iterator(joints.len(), scales);
    let scaled = &joint_balance * DMatrix::from_diagonal(&scales);
    let least_norm = inverse(&(&rest * scaled)) * (&rest * load);
    let forces = least_norm.component_mul(&scales);
    let left = load - &joint_balance * &forces;
    let efforts = inverse(&driven) * left;
    let mut all = DVector::zeros(weights.len());
    for (place, &column) in joints.iter().enumerate() {
        all[column] = forces[place];
    }
    for (place, &column) in drivers.iter().enumerate() {
        all[column] = efforts[place];
    }
    all
}

#[test]
fn redundant_joints_carry_the_smallest_forces_that_balance_every_body() {
    for case in [cranks(3), cranks(4), alike(), rails(), rods()] {
        let derived = &systems(case.name, &case.text)[0];
        assert!(!derived.system.monitored.is_empty());
        let length = derived.system.mechanism.characteristic_length;
        let mut followed = Followed::new(derived, 0.0).expect("as drawn");
        let dense = Dense::new(derived);
        for step in 1..=20 {
            assert!(followed.advance(0.1 * f64::from(step)), "{}", case.name);
            let (balance, weights) = balance(&followed, &case, length);
            let mut acts = DVector::zeros(balance.nrows());
            for weight in &case.weights {
                let load = weight.load(GRAVITY, &moving(weight.body, followed.instant()));
                for axis in 0..3 {
                    acts[3 * weight.body + axis] += load[axis];
                }
            }
            let expected = least(&balance, &weights, &-&acts);
            let all = followed.all();
            let of = |word: &str| -> Vec<f64> {
                let named = all.iter().filter(|(name, _)| name.starts_with(word));
                named.map(|(_, value)| *value).collect()
            };
            let components: Vec<f64> = [of("reaction"), of("effort")].concat();
            let components = DVector::from_vec(components);
            // All equations at once give equal forces.
            let at_once = dense.reported(followed.instant()).expect("regular");
            for ((name, one), other) in all.iter().zip(at_once) {
                assert!(
                    (one - other).abs() <= 1e-11 * components.amax(),
                    "{} {name}: {one} {other}",
                    case.name
                );
            }
            assert_eq!(components.len(), expected.len(), "{}: {all:?}", case.name);
            let largest = expected.amax();
            // Each body is balanced, and the forces are those of the least norm.
            let left = (&balance * &components + &acts).amax();
            assert!(left <= 1e-12 * largest, "{} {step}: {left}", case.name);
            let missed = (&components - &expected).amax();
            assert!(
                missed <= 1e-11 * largest,
                "{} {step}: {missed}\n{all:?}\n{expected}",
                case.name
            );
        }
    }
}

/// The least-norm reactions do not depend on the joint that is marked as redundant.
#[test]
fn the_smallest_forces_do_not_depend_on_which_joint_is_marked() {
    let text = cranks(3).text;
    let other = text
        .replace("redundant revolute M", "revolute M")
        .replace("revolute K", "redundant revolute K");
    let [mut one, mut other] = [text, other].map(|text| {
        let derived = &systems("cranks", &text)[0];
        Followed::new(derived, 0.0).expect("as drawn")
    });
    for step in 1..=20 {
        let t = 0.1 * f64::from(step);
        assert!(one.advance(t) && other.advance(t));
        let largest = one.all().iter().map(|it| it.1.abs()).fold(0.0, f64::max);
        for (name, value) in one.all() {
            let missed = (value - other.value(name)).abs();
            assert!(missed <= 1e-11 * largest, "{name}: {missed}");
        }
    }
}

/// Two collinear hinges carry one half each.
#[test]
fn two_hinges_carry_one_half_each() {
    let text = "mechanism door {
        point O = (0, 0), P = (0, 0);
        body leaf at O { O, P, S: (2, 0) }
        revolute O(ground, leaf);
        redundant revolute P(ground, leaf);
        drive phi(leaf) = 0.3*t;
        mass leaf = 3kg at S;
        gravity = (0, -9.81);
        reactions;
        least_norm;
    }";
    let mut door = Followed::new(&systems("door", text)[0], 0.0).expect("as drawn");
    assert!(door.advance(1.0));
    let (sine, cosine) = 0.3_f64.sin_cos();
    let half = [-3.0 * cosine * 0.09, 0.5 * (3.0 * 9.81 - 6.0 * sine * 0.09)];
    for name in ["reaction_o", "reaction_p"] {
        let reaction = ["x", "y"].map(|axis| door.value(&format!("{name}_{axis}")));
        assert!(
            (reaction[0] - half[0]).abs() <= 1e-14,
            "{name}: {reaction:?}"
        );
        assert!(
            (reaction[1] - half[1]).abs() <= 1e-14 * 30.0,
            "{name}: {reaction:?}"
        );
    }
}

fn errors(text: &str) -> String {
    let source = Source::new("door.mech", text);
    let findings = linkwright_codegen::read(&source).expect_err("an error");
    findings.render(&source)
}

#[test]
fn it_is_asked_for_where_there_is_a_choice() {
    let text = rails().text;
    for (from, to, message) in [
        (
            "redundant ",
            "",
            "without redundant joints, reactions are unique",
        ),
        (
            "reactions;",
            "",
            "`least_norm` requires `reaction` or `reactions`",
        ),
        (
            "least_norm;",
            "least_norm; least_norm;",
            "reactions of the least norm are already requested",
        ),
        (
            "least_norm;",
            "",
            "or write `least_norm;` for the smallest reactions",
        ),
    ] {
        let rendered = errors(&text.replace(from, to));
        assert!(rendered.contains(message), "{rendered}");
    }
}
