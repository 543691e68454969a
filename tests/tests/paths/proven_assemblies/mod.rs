//! Compares lists of assemblies that are reported as complete with independent lists: closed forms by hand, signs of
//! a function on a fine grid, Newton-Raphson from many starts.

mod ankle;
mod chain;

use std::f64::consts::{PI, TAU};

use linkwright::{Equations, Frame, Settings};
use linkwright_codegen::stages::joint::Quantity;
use linkwright_solver::assemblies::assemblies;
use linkwright_solver::textbook::TextbookEquations;
use linkwright_solver::{Assemblies, Interpreted};
use linkwright_tests::description::{source, system, written};
use linkwright_tests::random::Random;
use nalgebra::DVector;

/// Largest difference of the angles of a pose from those of the list.
const POSE_DIFFERENCE_LIMIT: f64 = 1e-9;

/// Angle without whole turns.
fn turned(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}

/// Largest difference of angles, without whole turns.
fn difference(one: &[f64], other: &[f64]) -> f64 {
    let pairs = one.iter().zip(other);
    pairs.fold(0.0, |most, (a, b)| turned(a - b).abs().max(most))
}

/// Values of these coordinates in every assembly.
fn found(all: &Assemblies, coordinates: &[usize]) -> Vec<Vec<f64>> {
    let of = |q: &[f64]| coordinates.iter().map(|&at| q[at]).collect();
    all.found.iter().map(|it| of(it.instant.q())).collect()
}

/// True if a pose lies in a region that is undecided; unknowns are the coordinates, and then others.
fn is_undecided(all: &Assemblies, coordinates: &[usize], pose: &[f64]) -> bool {
    all.undecided.iter().any(|part| {
        part.0.iter().all(|&(unknown, [low, high])| {
            let index = coordinates.iter().position(|&it| it == unknown);
            let value = pose[index.expect("the pose has what is sought")];
            let middle = 0.5 * (low + high);
            turned(value - middle).abs() <= 0.5 * (high - low) + POSE_DIFFERENCE_LIMIT
        })
    })
}

/// Checks that every pose of the list is found or undecided, and that every found one is in the list.
fn assert_agrees(all: &Assemblies, coordinates: &[usize], known: &[Vec<f64>], what: &str) {
    let assemblies = found(all, coordinates);
    for pose in known {
        let is_found = assemblies
            .iter()
            .any(|it| difference(it, pose) < POSE_DIFFERENCE_LIMIT);
        assert!(
            is_found || is_undecided(all, coordinates, pose),
            "{pose:?} is missed among {assemblies:?} and {:?} of {what}",
            all.undecided
        );
    }
    for pose in &assemblies {
        let is_known = known
            .iter()
            .any(|it| difference(it, pose) < POSE_DIFFERENCE_LIMIT);
        assert!(is_known, "{pose:?} is none of {known:?} of {what}");
    }
    for (place, pose) in assemblies.iter().enumerate() {
        let mut before = assemblies[..place].iter();
        assert!(
            !before.any(|it| difference(it, pose) < POSE_DIFFERENCE_LIMIT),
            "{pose:?} is assemblies twice of {what}"
        );
    }
}

type Point = [f64; 2];

fn from_to([a, b]: Point, [x, y]: Point) -> Point {
    [x - a, y - b]
}

fn length([x, y]: Point) -> f64 {
    x.hypot(y)
}

fn direction([x, y]: Point) -> f64 {
    y.atan2(x)
}

fn placed([x, y]: Point, angle: f64, [a, b]: Point) -> Point {
    let (sine, cosine) = angle.sin_cos();
    [x + cosine * a - sine * b, y + sine * a + cosine * b]
}

/// Each body's angle is the third of its coordinates.
const ANGLES: [usize; 4] = [2, 5, 8, 11];

/// Twice as many teeth or half as many: a whole turn leads to another pose, and nothing may be claimed.
#[test]
fn nothing_is_proven_where_turns_count() {
    let text = source("mirrored_cranks").text.to_string();
    for ratio in ["2", "0.5", "1.5"] {
        let other = text.replace(
            "external_gear (1, 4) = 1",
            &format!("external_gear (1, 4) = {ratio}"),
        );
        assert_ne!(text, other);
        let all = assemblies(&Interpreted::new(&written(&other)).expect("a plan"), 0.0);
        assert!(!all.proven, "{ratio}");
    }
}

/// Both cranks are mirrored. If they do not meet, the pin lies on the axis; if they do, both links coincide.
#[test]
fn double_poses_of_mirrored_cranks_are_undecided() {
    let all = assemblies(
        &Interpreted::new(&system("mirrored_cranks")).expect("a plan"),
        0.0,
    );
    assert!(all.proven && !all.undecided.is_empty());
    let (crank, link) = (length([-0.5, 1.0]), length([1.5, 1.2]));
    let of = |b: Point, c: Point| {
        let d = [2.0 - b[0], b[1]];
        vec![
            direction(b),
            direction(from_to(b, c)),
            direction(from_to(d, c)),
            direction(from_to([2.0, 0.0], d)),
        ]
    };
    let pin: Point = [1.0, 2.2];
    let (far, to_pin) = (length(pin), direction(pin));
    let cosine = (crank * crank + far * far - link * link) / (2.0 * crank * far);
    let mut known: Vec<Vec<f64>> = [1.0, -1.0]
        .map(|side| {
            of(
                placed([0.0, 0.0], to_pin + side * cosine.acos(), [crank, 0.0]),
                pin,
            )
        })
        .to_vec();
    let b = [1.0, (crank * crank - 1.0).sqrt()];
    let across = (link * link - (pin[1] - b[1]) * (pin[1] - b[1])).sqrt();
    known.extend([across, -across].map(|across| of(b, [1.0 + across, pin[1]])));
    assert_agrees(&all, &ANGLES, &known, "mirrored cranks");
}

#[test]
fn no_start_at_random_finds_another_assembly_of_rocking_cams() {
    let derived = system("rocking_cams");
    let textbook = TextbookEquations::new(&derived.pool, &derived.system);
    let is_angle = |at: usize| derived.system.coordinates[at].quantity == Quantity::Angle;
    let all = assemblies(&Interpreted::new(&derived).expect("a plan"), 0.0);
    assert!(all.proven && all.undecided.is_empty());
    assert_eq!(all.found.len(), 8);
    let size = textbook.dimension().0;
    let mut residual = DVector::zeros(size);
    let mut largest = |q: &DVector<f64>| {
        textbook.residual(q, 0.0, &mut residual);
        residual.amax()
    };
    let known: Vec<DVector<f64>> = all
        .found
        .iter()
        .map(|it| DVector::from_column_slice(it.instant.q()))
        .collect();
    for pose in &known {
        assert!(largest(pose) < 1e-12, "{pose}");
    }
    let mut random = Random::new(3);
    let mut reached = [0; 8];
    for _ in 0..2000 {
        let start = DVector::from_fn(size, |at, _| match is_angle(at) {
            true => random.between(-PI, PI),
            false => known[0][at] + textbook.coordinate_scale(at) * random.between(-1.0, 1.0),
        });
        let Ok(frame) = Frame::assemble(&textbook, &start, 0.0, &Settings::default()) else {
            continue;
        };
        let is_there = |pose: &DVector<f64>| {
            (0..size).all(|at| {
                let off = frame.q[at] - pose[at];
                let off = if is_angle(at) { turned(off) } else { off };
                off.abs() < POSE_DIFFERENCE_LIMIT
            })
        };
        let place = known.iter().position(is_there);
        reached[place.unwrap_or_else(|| panic!("{} is another one", frame.q))] += 1;
    }
    println!("reached: {reached:?}");
    assert!(reached.iter().all(|&it| it > 0), "{reached:?}");
}

/// Six-bar linkage of `mechanisms/stephenson.mech` with additional statements.
fn six_bar_with(others: &str) -> String {
    let text = source("stephenson").text;
    let end = text.rfind('}').expect("an end");
    format!("{}{others} }}", &text[..end])
}

/// Two links that are collinear at t = 0, or almost: that pose is in the list, although it is too close to singular
/// to be solved.
#[test]
fn links_in_line_leave_assemblies_unproven() {
    for before in ["0", "1e-14"] {
        let text = six_bar_with(&format!(
            "point H = (5, 0), I = (6, 0), J = (8, 0), K = (8, 2);
            body k at H {{ H, I }}
            body l at I {{ I, J }}
            body m at K {{ K, J }}
            revolute H(ground, k); revolute I(k, l); revolute J(l, m); revolute K(ground, m);
            drive phi(m) = -t - {before};"
        ));
        let all = assemblies(&Interpreted::new(&written(&text)).expect("a plan"), 0.0);
        assert!(!all.proven, "{before}: {} assemblies", all.found.len());
    }
}

/// A dyad a billion times as small as the rest, or smaller: all of its poses are listed, or nothing is proven.
#[test]
fn links_that_are_too_small_for_the_textbook_equations_leave_assemblies_unproven() {
    for size in [1e-6, 1e-9, 1e-12] {
        let [i, j, k] = [[0.3, 0.9], [1.2, 1.1], [1.5, 0.0]];
        let [i, j, k] = [i, j, k].map(|[x, y]| format!("({:.17}, {:.17})", x * size, y * size));
        let text = six_bar_with(&format!(
            "point H = (0, 0), I = {i}, J = {j}, K = {k};
            body k at H {{ H, I }}
            body l at I {{ I, J }}
            body m at K {{ K, J }}
            revolute H(ground, k); revolute I(k, l); revolute J(l, m); revolute K(ground, m);
            drive phi(k) = t;"
        ));
        let all = assemblies(&Interpreted::new(&written(&text)).expect("a plan"), 0.0);
        // Four of the six-bar linkage, each with two of the dyad.
        assert!(
            all.found.len() == 8 || !all.proven,
            "{size}: {}",
            all.found.len()
        );
    }
}

/// A wheel that a gear turns half as far as the rocker of a six-bar linkage. A whole turn of the rocker gives an
/// equal pose of the linkage, but the wheel's pin is then on its other side.
const HALF: &str = "mechanism half {
    point A = (0, 0), B = (-0.4, 0.8), C = (1, 1), D = (1, 0), E = (0.3, 1.5), F = (1.9, 1.5), G = (2, 0.8);
    point W = (4, 4), X = (5, 4);
    body crank at A { A, B }
    body coupler at (0.3, 1.1) { B, C, E }
    body rocker at D { C, D }
    body link at F { E, F }
    body arm at G { F, G }
    body wheel at W { W, X }
    revolute A(ground, crank);
    revolute B(crank, coupler);
    revolute C(coupler, rocker);
    revolute D(ground, rocker);
    revolute E(coupler, link);
    revolute F(link, arm);
    revolute G(ground, arm);
    revolute W(ground, wheel);
    external_gear (rocker, wheel) = 0.5;
    drive phi(arm) = 0.3*sin(2*t);
}";

#[test]
fn a_gear_after_a_block_counts_the_turns_of_its_angles() {
    let derived = written(HALF);
    let textbook = TextbookEquations::new(&derived.pool, &derived.system);
    let all = assemblies(&Interpreted::new(&derived).expect("a plan"), 0.0);
    let [rocker, wheel] = ["phi_rocker", "phi_wheel"].map(|name| {
        let mut coordinates = derived.system.coordinates.iter();
        coordinates
            .position(|it| it.name == name)
            .expect("an angle")
    });
    let drawn = DVector::from_column_slice(all.found[0].instant.q());
    let mut start = drawn.clone();
    start[rocker] += TAU;
    start[wheel] -= PI;
    let other =
        Frame::assemble(&textbook, &start, 0.0, &Settings::default()).expect("another pose");
    let mut residual = DVector::zeros(start.len());
    textbook.residual(&other.q, 0.0, &mut residual);
    assert!(residual.amax() < 1e-12);
    let wheels = found(&all, &[wheel]);
    let is_found = wheels
        .iter()
        .any(|it| difference(it, &[other.q[wheel]]) < POSE_DIFFERENCE_LIMIT);
    assert!(
        is_found || !all.proven,
        "{} is none of {wheels:?}",
        other.q[wheel]
    );
}
