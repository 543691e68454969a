//! Coulomb friction in joints, against free bodies by hand, and between formulations.

use linkwright::{Blocks, Failure, FailureKind, Settings, Shell};
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::{Dense, Instant, Interpreted, Numbers, Schedule, View, reported};
use linkwright_tests::description;
use linkwright_tests::description::written;
use nalgebra::{SMatrix, SVector};

/// Columns of forces along a motion, by name.
struct Columns {
    names: Vec<String>,
    rows: Vec<(Instant, Vec<f64>)>,
}

impl Columns {
    fn each(&self, wanted: &[&str], mut each: impl FnMut(&Instant, &[f64])) {
        let places = wanted.iter().map(|name| {
            let place = self.names.iter().position(|it| it == name);
            place.unwrap_or_else(|| panic!("no {name} in {:?}", self.names))
        });
        let places: Vec<usize> = places.collect();
        for (instant, row) in &self.rows {
            let values: Vec<f64> = places.iter().map(|&place| row[place]).collect();
            each(instant, &values);
        }
    }
}

fn times(end: f64) -> impl Iterator<Item = f64> {
    (0..=100).map(move |step| 0.01 * end * f64::from(step))
}

/// Columns of a view at these times, up to a failure.
fn followed<V: View>(
    view: &V,
    parameters: Option<V::Parameters>,
    end: f64,
) -> (Columns, Option<Failure>) {
    let laws = view.input_laws();
    let parameters = parameters.unwrap_or_else(|| view.nominal_parameters());
    let (pose, modes) = (view.drawn_pose(&parameters), view.drawn_branches());
    let (inputs, settings) = (laws.at(0.0), Settings::default());
    let names = reported::names(view.pool(), view.system());
    let mut columns = Columns {
        names: names.into_iter().map(|it| it.0).collect(),
        rows: Vec::new(),
    };
    let shell = Shell::assemble(
        view.clone(),
        &parameters,
        &pose,
        modes,
        0.0,
        &inputs,
        settings,
    );
    let mut shell = match shell {
        Ok(shell) => shell,
        Err(failure) => return (columns, Some(failure)),
    };
    for t in times(end) {
        if let Err(failure) = shell.advance(t, &laws.at(t)) {
            return (columns, Some(failure));
        }
        let row = view.reported(shell.frame());
        columns
            .rows
            .push((shell.frame().clone(), row.expect("regular")));
    }
    (columns, None)
}

/// Columns of a motion in both formulations, which agree to rounding.
fn solved(derived: &Derived, end: f64) -> Columns {
    let (solved, failure) = followed(&Interpreted::new(derived).expect("a motion"), None, end);
    assert_eq!(failure, None);
    let (dense, failure) = followed(&Dense::new(derived), None, end);
    assert_eq!(failure, None);
    let mut worst = 0.0_f64;
    for ((_, own), (_, other)) in solved.rows.iter().zip(&dense.rows) {
        let size = own.iter().fold(1.0_f64, |size, it| size.max(it.abs()));
        let differences = own
            .iter()
            .zip(other)
            .map(|(own, other)| (own - other).abs());
        worst = differences.fold(worst, |worst, it| worst.max(it / size));
    }
    println!("both formulations: {worst:e}");
    assert!(worst < 1e-12, "{worst:e}");
    solved
}

/// Block that a cylinder moves on an incline.
fn incline(mu: f64, slope: f64, motion: &str) -> Derived {
    written(&format!(
        "mechanism incline {{
            point O = (0, 0), T = ({}, {});
            body block at T {{ B: (0, 0) }}
            translational rail (ground, block) along O -> B;
            drive push: length(O, B) = {motion};
            mass block = 10kg;
            gravity = (0, -9.81);
            friction rail = {mu};
            energy;
        }}",
        0.5 * slope.cos(),
        0.5 * slope.sin()
    ))
}

#[test]
fn a_block_on_an_incline_takes_its_weight_and_friction() {
    for (mu, slope) in [(0.2, 0.35), (0.4, 0.35), (0.05, -0.6), (0.0, 0.35)] {
        let columns = solved(&incline(mu, slope, "0.5m + 0.1*sin(2*t)"), 3.0);
        let names = [
            "effort_push",
            "friction_rail",
            "frictionless_power",
            "backward_power",
        ];
        let (mut worst, mut count) = (0.0_f64, 0);
        columns.each(&names, |instant, values| {
            let t = instant.t();
            let (rate, acceleration) = (0.2 * (2.0 * t).cos(), -0.4 * (2.0 * t).sin());
            let rubs = mu * 98.1 * slope.cos() * rate.signum();
            let alone = 98.1 * slope.sin() + 10.0 * acceleration;
            let expected = [alone + rubs, -rubs, alone * rate, (alone - rubs) * rate];
            for (value, expected) in values.iter().zip(expected) {
                worst = worst.max((value - expected).abs());
                count += 1;
            }
        });
        println!("mu {mu}, slope {slope}: {worst:e} in {count} values");
        assert!(worst < 1e-12 && count == 404);
    }
}

#[test]
fn a_block_locks_itself_where_friction_exceeds_the_slope() {
    // So slow that no inertia matters: 0.35 rad locks itself with mu > tan 0.35 = 0.365.
    for (mu, locks) in [(0.36, false), (0.37, true)] {
        let derived = incline(mu, 0.35, "0.5m + 0.01*t");
        let view = Interpreted::new(&derived).expect("a motion");
        let schedule = Schedule::range(0.0, 2.0, 0.5).expect("a step");
        let check = linkwright_solver::Check::new(view, &schedule, |_| ());
        let losses = check.losses.expect("friction");
        let expected = if locks { vec![[0.0, 2.0]] } else { Vec::new() };
        assert_eq!(losses.locked(), expected);
        // The efficiency is tan a / (tan a + mu).
        let efficiency = 0.35_f64.tan() / (0.35_f64.tan() + mu);
        let [work, without] = losses.driving;
        assert!((without / work - efficiency).abs() < 1e-14);
        assert!((losses.lowest.expect("it drives").efficiency - efficiency).abs() < 1e-14);
        assert!((without - 98.1 * 0.35_f64.sin() * 0.02).abs() < 1e-14);
    }
}

#[test]
fn a_lever_turns_on_its_friction_circle() {
    let derived = written(
        "mechanism lever {
            point O = (0, 0);
            body arm at O { O, S: (0.2, 0) }
            revolute O(ground, arm);
            drive crank: phi(arm) = 0.9*sin(3*t);
            mass arm = 3kg at S inertia 0.02;
            gravity = (0, -9.81);
            friction O = 0.3 radius 15mm;
            reaction O;
        }",
    );
    let names = ["effort_crank", "friction_o", "reaction_o_x", "reaction_o_y"];
    let (mut worst, mut signs) = (0.0_f64, [0; 2]);
    solved(&derived, 2.0).each(&names, |instant, values| {
        let t = instant.t();
        let phi = 0.9 * (3.0 * t).sin();
        let (rate, spin) = (2.7 * (3.0 * t).cos(), -8.1 * (3.0 * t).sin());
        // m (a − g) in the pin, and the weight and the inertia about it.
        let x = 3.0 * 0.2 * (-spin * phi.sin() - rate * rate * phi.cos());
        let y = 3.0 * (0.2 * (spin * phi.cos() - rate * rate * phi.sin()) + 9.81);
        let rubs = 0.3 * 0.015 * x.hypot(y) * rate.signum();
        let effort = (0.02 + 3.0 * 0.04) * spin + 3.0 * 9.81 * 0.2 * phi.cos() + rubs;
        for (value, expected) in values.iter().zip([effort, -rubs, x, y]) {
            worst = worst.max((value - expected).abs());
        }
        signs[usize::from(rate > 0.0)] += 1;
    });
    println!("{worst:e}, turning back and forth: {signs:?}");
    assert!(worst < 1e-12 && signs.iter().all(|it| *it > 20));
}

/// A wedge under a weight, all on plain slides: P = W (tan (a + f) + tan f) with the angle of friction f.
fn wedge(mu: f64, angle: f64) -> Derived {
    written(&format!(
        "mechanism wedge {{
            point O = (0, 0);
            body wedge at (1, 0) {{ B: (0, 0), P: (0, 0), R: ({}, {}) }}
            body weight at (1, 0) {{ Q: (0, 0) }}
            absolute_x(weight) = 1;
            absolute_angle(weight) = 0;
            translational floor (ground, wedge) along O -> B;
            point_on_line slope (weight.Q, wedge) along P -> R;
            drive push: length(O, B) = 1m - 0.1m*cos(t);
            force on weight.Q = (0, -100N);
            friction floor = {mu};
            friction slope = {mu};
        }}",
        angle.cos(),
        -angle.sin()
    ))
}

#[test]
fn a_wedge_lifts_by_the_angle_of_friction() {
    for (mu, angle) in [(0.1, 0.2), (0.2, 0.5), (0.3, 1.1), (0.15, 1.35)] {
        let columns = solved(&wedge(mu, angle), 6.0);
        let friction = mu.atan();
        let (mut worst, mut count, mut rests) = (0.0_f64, [0; 2], 0);
        let names = ["effort_push", "frictionless_power", "backward_power"];
        columns.each(&names, |instant, values| {
            let rate = 0.1 * instant.t().sin();
            if rate == 0.0 {
                rests += 1;
                return;
            }
            let force = |sign: f64| {
                let friction = sign * friction;
                100.0 * ((angle + friction).tan() + friction.tan())
            };
            let lifts = if rate > 0.0 { 1.0 } else { -1.0 };
            let expected = [force(lifts), force(0.0) * rate, force(-lifts) * rate];
            for (value, expected) in values.iter().zip(expected) {
                worst = worst.max((value - expected).abs() / expected.abs().max(1.0));
            }
            count[usize::from(lifts > 0.0)] += 1;
        });
        println!("mu {mu}, angle {angle}: {worst:e}, {count:?}");
        assert!(worst < 1e-12 && count.iter().all(|it| *it > 40) && rests <= 1);
    }
}

#[test]
fn a_steep_wedge_jams() {
    // Beyond a + f = 90°, no force lifts the weight.
    let view = Interpreted::new(&wedge(0.3, 1.4)).expect("a motion");
    let (columns, failure) = followed(&view, None, 6.0);
    // At rest, at first, nothing slides.
    assert_eq!(columns.rows.len(), 1);
    let failure = failure.expect("it jams");
    let FailureKind::FrictionUnsettled { change } = failure.kind else {
        panic!("{failure:?}");
    };
    assert!(change > 1e-10);
    let message = view.explained(&failure).to_string();
    assert!(
        message.contains("the forces of friction do not settle"),
        "{message}"
    );
}

#[test]
fn a_drawer_is_held_by_the_edges_of_its_guide() {
    // A load at the distance e from the line: the moment F e over the length L presses both ends.
    let derived = written(
        "mechanism drawer {
            point O = (0, 0);
            body drawer at (0.5, 0) { B: (0, 0), K: (0, 0.15) }
            translational rail (ground, drawer) along O -> B;
            drive pull: length(O, B) = 0.5m + 0.1*sin(2*t);
            force on drawer.K = (-80N, 0);
            friction rail = 0.25 over 0.2m;
            reaction rail;
        }",
    );
    let names = ["effort_pull", "friction_rail", "reaction_rail_moment"];
    solved(&derived, 3.0).each(&names, |instant, values| {
        let sign = (2.0 * instant.t()).cos().signum();
        let rubs = 0.25 * 2.0 * (80.0 * 0.15 / 0.2) * sign;
        for (value, expected) in values.iter().zip([80.0 + rubs, -rubs, -12.0]) {
            assert!(
                (value - expected).abs() < 1e-12,
                "{value}, expected {expected}"
            );
        }
    });
}

/// Pose, rate and acceleration of the described press: of the crank, the rod and the ram.
struct Press {
    crank: [f64; 3],
    rod: [f64; 3],
    ram: [f64; 3],
}

const CRANK: f64 = 0.03;
const ROD: f64 = 0.1;

fn press(t: f64) -> Press {
    let crank = [
        60_f64.to_radians() + 4.0 * t + 0.3 * (3.0 * t).sin(),
        4.0 + 0.9 * (3.0 * t).cos(),
        -2.7 * (3.0 * t).sin(),
    ];
    // r sin φ + l sin ψ = 0 and x = r cos φ + l cos ψ, differentiated twice.
    let [phi, rate, spin] = crank;
    let psi = (-CRANK * phi.sin() / ROD).asin();
    let of_rod = -CRANK * phi.cos() * rate / (ROD * psi.cos());
    let centripetal = CRANK * phi.sin() * rate * rate + ROD * psi.sin() * of_rod * of_rod;
    let rod_spin = (centripetal - CRANK * phi.cos() * spin) / (ROD * psi.cos());
    let x = CRANK * phi.cos() + ROD * psi.cos();
    let speed = -CRANK * phi.sin() * rate - ROD * psi.sin() * of_rod;
    let acceleration = -CRANK * (phi.cos() * rate * rate + phi.sin() * spin)
        - ROD * (psi.cos() * of_rod * of_rod + psi.sin() * rod_spin);
    Press {
        crank,
        rod: [psi, of_rod, rod_spin],
        ram: [x, speed, acceleration],
    }
}

/// Forces in the press from the balances of its three bodies, nine linear equations, with friction by substitution: pins O, A and B,
/// the normal force and the moment of the guide, and the torque.
fn balanced(press: &Press) -> SVector<f64, 9> {
    let turned = |angle: f64, [x, y]: [f64; 2]| {
        let (sine, cosine) = angle.sin_cos();
        [x * cosine - y * sine, x * sine + y * cosine]
    };
    let [phi, rate, spin] = press.crank;
    let [psi, of_rod, rod_spin] = press.rod;
    let accelerated = |arm: [f64; 2], rate: f64, spin: f64| {
        [
            -spin * arm[1] - rate * rate * arm[0],
            spin * arm[0] - rate * rate * arm[1],
        ]
    };
    let pin_a = turned(phi, [CRANK, 0.0]);
    let center = turned(phi, [0.01, 0.0]);
    let of_crank = accelerated(center, rate, spin);
    let at_a = accelerated(pin_a, rate, spin);
    let rod_center = turned(psi, [0.05, 0.005]);
    let rod_arm = turned(psi, [ROD, 0.0]);
    let relative = accelerated(rod_center, of_rod, rod_spin);
    let of_rod_center = [at_a[0] + relative[0], at_a[1] + relative[1]];
    let cross = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
    let mut friction = [0.0; 4];
    let mut forces = SVector::<f64, 9>::zeros();
    for _ in 0..200 {
        // Unknowns: O on the crank, A on the rod, B on the ram, the normal force and the moment on the ram, the torque.
        let mut matrix = SMatrix::<f64, 9, 9>::zeros();
        let mut right = SVector::<f64, 9>::zeros();
        let set = |matrix: &mut SMatrix<f64, 9, 9>, row: usize, entries: &[(usize, f64)]| {
            for &(column, value) in entries {
                matrix[(row, column)] = value;
            }
        };
        let (weight, inertia) = (9.81, [0.0004, 0.001]);
        set(&mut matrix, 0, &[(0, 1.0), (2, -1.0)]);
        right[0] = 0.5 * of_crank[0];
        set(&mut matrix, 1, &[(1, 1.0), (3, -1.0)]);
        right[1] = 0.5 * (of_crank[1] + weight);
        // Moments about O: the crank, then about A: the rod.
        set(&mut matrix, 2, &[(2, pin_a[1]), (3, -pin_a[0]), (8, 1.0)]);
        let moved = 0.5 * cross(center, [of_crank[0], of_crank[1] + weight]);
        right[2] = inertia[0] * spin + moved - friction[0] + friction[1];
        set(&mut matrix, 3, &[(2, 1.0), (4, -1.0)]);
        right[3] = 0.8 * of_rod_center[0];
        set(&mut matrix, 4, &[(3, 1.0), (5, -1.0)]);
        right[4] = 0.8 * (of_rod_center[1] + weight);
        set(&mut matrix, 5, &[(4, rod_arm[1]), (5, -rod_arm[0])]);
        let moved = 0.8 * cross(rod_center, [of_rod_center[0], of_rod_center[1] + weight]);
        right[5] = inertia[1] * rod_spin + moved - friction[1] + friction[2];
        set(&mut matrix, 6, &[(4, 1.0)]);
        right[6] = 2.0 * press.ram[2] + 200.0 - friction[3];
        set(&mut matrix, 7, &[(5, 1.0), (6, 1.0)]);
        right[7] = 2.0 * weight;
        set(&mut matrix, 8, &[(7, 1.0)]);
        right[8] = 2.0 * cross([0.02, 0.01], [press.ram[2], weight]) - friction[2];
        forces = matrix.lu().solve(&right).expect("regular");
        let pin = |at: usize| f64::hypot(forces[at], forces[at + 1]);
        let (front, back) = (
            0.5 * forces[6] + forces[7] / 0.06,
            0.5 * forces[6] - forces[7] / 0.06,
        );
        // On the second body of each joint, against its rate on the first one.
        let next = [
            -0.15 * 0.012 * pin(0) * rate.signum(),
            -0.15 * 0.01 * pin(2) * (of_rod - rate).signum(),
            -0.2 * 0.008 * pin(4) * (-of_rod).signum(),
            -0.1 * (front.abs() + back.abs()) * press.ram[1].signum(),
        ];
        if next == friction {
            break;
        }
        friction = next;
    }
    forces
}

#[test]
fn a_press_balances_body_by_body() {
    let columns = solved(&description::system("rubbing_press"), 2.0);
    let names = [
        "reaction_o_x",
        "reaction_o_y",
        "reaction_a_x",
        "reaction_a_y",
        "reaction_b_x",
        "reaction_b_y",
        "reaction_guide_normal",
        "reaction_guide_moment",
        "effort_motor",
    ];
    let (mut worst, mut turns) = (0.0_f64, [0; 2]);
    columns.each(&names, |instant, values| {
        let press = press(instant.t());
        let expected = balanced(&press);
        for (value, expected) in values.iter().zip(expected.iter()) {
            worst = worst.max((value - expected).abs());
        }
        turns[usize::from(press.ram[1] > 0.0)] += 1;
    });
    println!("{worst:e}, on the way in and out: {turns:?}");
    assert!(worst < 1e-10 && turns.iter().all(|it| *it > 20));
}

#[test]
fn powers_and_friction_balance_the_energies() {
    // The powers of drivers and what is added are the rate of both energies; a central difference of those, to its own error.
    let derived = description::system("rubbing_press");
    let view = Interpreted::new(&derived).expect("a motion");
    let (columns, _) = followed(&view, None, 0.01);
    let names = [
        "kinetic_energy",
        "potential_energy",
        "power_motor",
        "added_power",
        "frictionless_power",
    ];
    let mut rows = Vec::new();
    columns.each(&names, |instant, values| {
        rows.push((instant.t(), values.to_vec()))
    });
    let (mut worst, mut lost) = (0.0_f64, 0.0_f64);
    for around in rows.windows(3) {
        let energy = |it: &(f64, Vec<f64>)| it.1[0] + it.1[1];
        let rate = (energy(&around[2]) - energy(&around[0])) / (around[2].0 - around[0].0);
        let [_, _, power, added, frictionless] = around[1].1[..] else {
            panic!("five columns");
        };
        worst = worst.max((power + added - rate).abs());
        lost = lost.max(power - frictionless);
    }
    println!("{worst:e} W, beside {lost} W of friction");
    assert!(worst < 1e-5 && lost > 1.0);
}

#[test]
fn joints_without_a_coefficient_are_without_friction() {
    let source = description::source("rubbing_press");
    let plain: Vec<&str> = source
        .text
        .lines()
        .filter(|line| !line.trim_start().starts_with("friction"))
        .collect();
    let smooth = source
        .text
        .replace("mu = 0.15", "mu = 0")
        .replace("= 0.2 radius", "= 0 radius");
    let smooth = smooth.replace("guide = 0.1 over", "guide = 0 over");
    let smooth = solved(&written(&smooth), 2.0);
    let plain = plain
        .join("\n")
        .replace("param mu = 0.15;", "")
        .replace("param pin = 12mm;", "");
    let plain = solved(&written(&plain), 2.0);
    let names: Vec<&str> = plain.names.iter().map(String::as_str).collect();
    let mut rows = plain.rows.iter();
    smooth.each(&names, |_, values| {
        let (_, row) = rows.next().expect("as many");
        for ((name, value), expected) in names.iter().zip(values).zip(row) {
            let size = expected.abs().max(1.0);
            assert!(
                (value - expected).abs() < 1e-12 * size,
                "{name}: {value}, {expected}"
            );
        }
    });
}

#[test]
fn a_ladder_jams_at_the_angle_of_friction() {
    let derived = description::system("jamming_ladder");
    let view = Interpreted::new(&derived).expect("a motion");
    let (columns, failure) = followed(&view, None, 1.0);
    let failure = failure.expect("it jams");
    assert!(
        matches!(failure.kind, FailureKind::FrictionUnsettled { .. }),
        "{failure:?}"
    );
    // The pull T along the ladder at the angle b moves the foot by T cos b, and friction takes mu |T sin b - N| with the rest N of its load.
    let height = 0.5 + 0.35 * (2.0 * failure.time).sin();
    println!(
        "jams at t = {}, {}°",
        failure.time,
        height.asin().to_degrees()
    );
    assert!(!columns.rows.is_empty() && (height.asin().tan() - 1.25).abs() < 1e-3);
    // Less friction moves it on.
    let parameters = Numbers(vec![0.2, 1.0]);
    let (columns, failure) = followed(&view, Some(parameters), 1.0);
    assert_eq!((columns.rows.len(), failure), (101, None));
    // Parameters of impossible friction are refused.
    let (_, failure) = followed(&view, Some(Numbers(vec![-0.1, 1.0])), 1.0);
    let kind = failure.map(|it| it.kind);
    assert!(
        matches!(kind, Some(FailureKind::NotPositive { .. })),
        "{kind:?}"
    );
}

#[test]
fn nothing_rubs_at_rest() {
    let mut derived = description::system("rubbing_press");
    derived.system = derived.system.at_rest(&mut derived.pool);
    let columns = solved(&derived, 1.0);
    let names = [
        "friction_o",
        "friction_guide",
        "frictionless_power",
        "backward_power",
    ];
    columns.each(&names, |_, values| {
        assert!(values.iter().all(|it| *it == 0.0))
    });
}
