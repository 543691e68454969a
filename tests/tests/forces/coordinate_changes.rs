//! Free coordinates whose rate vanishes in between: the motion is that of a coordinate whose rate never does.

use linkwright_solver::dormand_prince::Step;
use linkwright_solver::rates::Rates;
use linkwright_solver::{Simulation, Tolerances, View};
use linkwright_tests::description;
use linkwright_tests::simulated::{
    coordinate, elliptic, energy, force, n_four_bar, options, simulation,
};
use nalgebra::{SMatrix, SVector};

/// Crank with an eccentric weight and a piston; `free` names its free coordinate.
fn engine(free: &str) -> String {
    format!(
        "mechanism engine {{
            point A = (0, 0), B = (0.1, 0.1), C = (0.4, 0);
            body crank at A facing A -> B {{ A, B }}
            body rod at B facing B -> C {{ B, C, S: (0.15, 0.01) }}
            body piston at C {{ C }}
            revolute A(ground, crank);
            revolute B(crank, rod);
            revolute C(rod, piston);
            absolute_y(piston) = 0;
            absolute_angle(piston) = 0;
            {free}
            mass crank = 2kg at B inertia 0.01;
            mass rod = 0.7kg at S inertia 0.008;
            mass piston = 0.5kg;
            gravity = (0, -9.81);
            reactions;
            energy;
        }}"
    )
}

/// Coordinate of a description and its initial rate, as a statement that frees another one there.
fn freed(start: &Simulation, name: &str, written: &str) -> String {
    let [value, rate] = coordinate(start, name);
    format!("free other: {written} = {value:?} rate {rate:?};")
}

/// Largest difference of all coordinates and of their rates, beside the largest rate.
fn difference(one: &Simulation, other: &Simulation) -> [f64; 2] {
    let [one, other] = [one.frame(), other.frame()];
    let largest = |pairs: [&[f64]; 2]| {
        let pairs = pairs[0].iter().zip(pairs[1]);
        pairs
            .map(|(one, other)| (one - other).abs())
            .fold(0.0, f64::max)
    };
    let rate = one.qd().iter().map(|rate| rate.abs()).fold(1.0, f64::max);
    [
        largest([one.q(), other.q()]),
        largest([one.qd(), other.qd()]) / rate,
    ]
}

/// Follows two descriptions of one motion; returns the one that changes its coordinates, and the largest differences.
fn followed(changed: &str, reference: &str, end: f64, steps: u32) -> (Simulation, [f64; 2]) {
    let mut reference = simulation(reference, end, options(1e-13));
    let mut changed = simulation(changed, end, options(1e-13));
    let first = energy(&changed);
    let (mut worst, mut kinetic) = ([0.0_f64; 2], 0.0_f64);
    let mut drift = 0.0_f64;
    for step in 1..=steps {
        let t = end * f64::from(step) / f64::from(steps);
        reference.advance(t).expect("no end");
        if let Err(stop) = changed.advance(t) {
            panic!("{}", stop.explained(changed.view(), changed.frame()));
        }
        let gaps = difference(&changed, &reference);
        worst = [0, 1].map(|level| worst[level].max(gaps[level]));
        kinetic = kinetic.max(force(&changed, "kinetic_energy"));
        let work = changed.added_work().expect("on the step");
        drift = drift.max((energy(&changed) - first - work).abs());
    }
    assert!(drift <= 1e-10 * kinetic, "{drift} {kinetic}");
    (changed, worst)
}

#[test]
fn a_piston_moves_its_crank_over_both_dead_centers() {
    let reference = engine("free turn: phi(crank) = pi/4 rate 25;");
    let start = simulation(&reference, 0.0, options(1e-12));
    let changed = engine(&freed(&start, "x_piston", "x(piston)"));
    let (found, worst) = followed(&changed, &reference, 3.0, 300);
    assert!(worst[0] <= 1e-9 && worst[1] <= 1e-9, "{worst:?}");
    // About twelve turns.
    assert!(coordinate(&found, "phi_crank")[0].abs() > 60.0);
}

/// Cylinder that a crank swings: the length is shortest and longest where they are collinear.
fn cylinder(free: &str) -> String {
    format!(
        "mechanism pump {{
            point A = (0, 0), B = (0.05, 0.02), C = (0.3, 0);
            body crank at A facing A -> B {{ A, B }}
            body rod at B facing B -> C {{ B }}
            body barrel at C facing C -> B {{ C, S: (0.08, 0) }}
            revolute A(ground, crank);
            revolute B(crank, rod);
            revolute C(ground, barrel);
            translational (barrel, rod) along C -> B;
            {free}
            mass crank = 1kg at B inertia 0.002;
            mass rod = 0.3kg inertia 0.001;
            mass barrel = 0.9kg at S inertia 0.004;
            gravity = (0, -9.81);
            energy;
        }}"
    )
}

#[test]
fn a_length_moves_its_crank_over_both_dead_centers() {
    let reference = cylinder("free turn: phi(crank) = atan2(0.02, 0.05) rate 12;");
    let start = simulation(&reference, 0.0, options(1e-12));
    let [x, y] = [coordinate(&start, "x_rod"), coordinate(&start, "y_rod")];
    let (along, across) = (x[0] - 0.3, y[0]);
    let length = along.hypot(across);
    let rate = (along * x[1] + across * y[1]) / length;
    let changed = cylinder(&format!(
        "free other: length(C, B) = {length:?} rate {rate:?};"
    ));
    let (_, worst) = followed(&changed, &reference, 4.0, 400);
    assert!(worst[0] <= 1e-9 && worst[1] <= 1e-9, "{worst:?}");
}

/// Two point masses at the pins of a four-bar in which no link can turn round: its four coordinates with multipliers.
struct PointMasses {
    masses: [f64; 2],
    pivots: [[f64; 2]; 2],
}

impl Rates for PointMasses {
    type Failure = ();

    fn rates(&mut self, _t: f64, state: &[f64], rates: &mut [f64]) -> Result<(), ()> {
        let at = |place: usize| [state[2 * place], state[2 * place + 1]];
        let ends = [
            [at(0), self.pivots[0], at(2), [0.0; 2]],
            [at(0), at(1), at(2), at(3)],
            [at(1), self.pivots[1], at(3), [0.0; 2]],
        ];
        let mut matrix = SMatrix::<f64, 7, 7>::zeros();
        let mut right = SVector::<f64, 7>::zeros();
        for axis in 0..2 {
            for (mass, own) in self.masses.iter().enumerate() {
                let place = 2 * mass + axis;
                matrix[(place, place)] = *own;
                right[place] = if axis == 1 { -9.81 * own } else { 0.0 };
            }
            for (row, [one, other, moves, others]) in ends.iter().enumerate() {
                let gap = one[axis] - other[axis];
                let signs = [[1.0, 0.0], [1.0, -1.0], [0.0, 1.0]][row];
                for mass in 0..2 {
                    matrix[(4 + row, 2 * mass + axis)] = signs[mass] * gap;
                    matrix[(2 * mass + axis, 4 + row)] = signs[mass] * gap;
                }
                right[4 + row] -= (moves[axis] - others[axis]).powi(2);
            }
        }
        let solution = matrix.lu().solve(&right).ok_or(())?;
        rates[..4].copy_from_slice(&state[4..]);
        rates[4..].copy_from_slice(&solution.as_slice()[..4]);
        Ok(())
    }

    fn judged(&self) -> usize {
        8
    }
}

/// No angle of it is a coordinate all the way round: those of both rockers turn back, and so does that of the
/// coupler.
#[test]
fn a_triple_rocker_goes_round_by_one_angle_after_the_other() {
    let text = "mechanism rockers {
        point A = (0, 0), B = (0.2, 0.7), C = (1, 0.75), D = (1.2, 0);
        body left at A facing A -> B { A, B }
        body coupler at B facing B -> C { B, C }
        body right at D facing D -> C { D, C }
        revolute A(ground, left);
        revolute B(left, coupler);
        revolute C(coupler, right);
        revolute D(ground, right);
        free swing: phi(left) = atan2(0.7, 0.2) rate 9;
        mass left = 2kg at B;
        mass right = 1kg at C;
        gravity = (0, -9.81);
        energy;
    }";
    let mut rockers = simulation(text, 4.0, options(1e-13));
    let first = energy(&rockers);
    let mut masses = PointMasses {
        masses: [2.0, 1.0],
        pivots: [[0.0, 0.0], [1.2, 0.0]],
    };
    let names = ["B", "C"];
    let pins = |simulation: &Simulation| -> Vec<[f64; 4]> {
        let view = simulation.view();
        let points = view.points(simulation.frame());
        let outputs = &view.system().outputs;
        let values_by_name = names.map(|name| {
            let place = outputs
                .iter()
                .position(|it| it.name == name)
                .expect("a pin");
            let [position, velocity] = [points[place].position, points[place].velocity];
            [position[0], position[1], velocity[0], velocity[1]]
        });
        values_by_name.to_vec()
    };
    let start = pins(&rockers);
    let mut state: Vec<f64> = start.iter().flat_map(|it| [it[0], it[1]]).collect();
    state.extend(start.iter().flat_map(|it| [it[2], it[3]]));
    let tolerances = Tolerances {
        relative: 1e-13,
        absolute: 1e-13,
    };
    let (mut worst, mut drift) = (0.0_f64, 0.0_f64);
    let steps = 8000_u32;
    for step in 1..=steps {
        let [from, t] = [step - 1, step].map(|it| 4.0 * f64::from(it) / f64::from(steps));
        let mut slope = vec![0.0; 8];
        masses.rates(from, &state, &mut slope).expect("regular");
        let taken = Step::attempt(&mut masses, [from, t], &state, &slope, &tolerances);
        let taken = taken.expect("regular");
        assert!(taken.error <= 1.0, "{}", taken.error);
        state = taken.end().to_vec();
        if let Err(stop) = rockers.advance(t) {
            panic!("{}", stop.explained(rockers.view(), rockers.frame()));
        }
        for (place, pin) in pins(&rockers).iter().enumerate() {
            for axis in 0..2 {
                worst = worst.max((pin[axis] - state[2 * place + axis]).abs());
            }
        }
        drift = drift.max((energy(&rockers) - first).abs());
    }
    assert!(worst <= 1e-10, "{worst}");
    assert!(drift <= 1e-10 * first, "{drift}");
}

/// The angle from upright of a windowed four-bar with two windows that was upright at t = 0 and moved at 1 m/s, and its rate:
/// θ = 2 am(t/2 | m) with m = −4 W g/I.
fn leaning(t: f64) -> [f64; 2] {
    let m: f64 = -4.0 * 3.5 * 9.81 / 3.0;
    // Of a negative parameter by that of m/(m − 1) (Abramowitz and Stegun 16.10).
    let stretched = (1.0 - m).sqrt();
    let [sn, cn, dn] = elliptic(0.5 * t * stretched, m / (m - 1.0));
    let angle = 2.0 * (sn / stretched).atan2(cn);
    [angle, 1.0 / dn]
}

/// Positions of B0 at t = 1, 4 and 10 s, to 20 digits.
const N_FOUR_BAR: [(f64, [f64; 2]); 3] = [
    (1.0, [-0.195_020_301_949_435_1, -0.980_799_205_662_173_8]),
    (4.0, [0.117_616_102_376_808_61, 0.993_059_138_451_325_1]),
    (10.0, [0.328_458_111_540_815_4, 0.944_518_538_178_600_9]),
];

/// The height of its bars is free after they have passed their first flat pose.
fn falling_bars(start: f64) -> String {
    let [angle, rate] = leaning(start);
    let [height, falls] = [angle.cos(), -angle.sin() * rate];
    n_four_bar(
        angle,
        &format!("free height: y(bar0) = {height:?} rate {falls:?};"),
    )
}

/// That height is the cosine of their angle, and its rate vanishes where they are upright. In the flat poses
/// equations of the joints lose rank, and the motion passes straight through.
#[test]
fn an_n_four_bar_goes_on_by_an_angle_and_straight_through_its_flat_poses() {
    let start = 0.8;
    let mut bars = simulation(&falling_bars(start), 10.0 - start, options(1e-12));
    let first = energy(&bars);
    for (t, expected) in N_FOUR_BAR {
        bars.advance(t - start).expect("no end");
        let tip = ["x_bar0", "y_bar0"].map(|name| coordinate(&bars, name)[0]);
        for axis in 0..2 {
            assert!((tip[axis] - expected[axis]).abs() <= 1e-9, "{t}: {tip:?}");
        }
        assert!((energy(&bars) - first).abs() <= 1e-9 * 70.0);
    }
    assert_eq!(bars.passed().len(), 9);
}

/// A coordinate in a formula may be at rest, too: a spring on the piston returns the energy that it stores.
#[test]
fn a_coordinate_that_is_mentioned_goes_on() {
    let text = engine(
        "free stroke: x(piston) = 0.4 rate 1;
        force on piston.C = (-3N*stroke, 0);",
    );
    let mut engine = simulation(&text, 5.0, options(1e-11));
    let kept = |engine: &Simulation| {
        let [x, _] = coordinate(engine, "x_piston");
        energy(engine) + 1.5 * x * x
    };
    let first = kept(&engine);
    for step in 1..=50 {
        engine.advance(0.1 * f64::from(step)).expect("no end");
        assert!(
            (kept(&engine) - first).abs() <= 1e-8 * first.abs().max(1.0),
            "{step}"
        );
    }
}

/// A driver that follows a free coordinate: a crank turns another one twice as fast, which adds four times its
/// inertia.
#[test]
fn a_driver_may_follow_what_is_free() {
    let text = "mechanism follower {
        point A = (0, 0), B = (1, 0);
        body crank at A { A }
        body other at B { B }
        revolute A(ground, crank);
        revolute B(ground, other);
        free turn: phi(crank) = 0 rate 1;
        drive phi(other) = 2*turn + 0.5*t;
        mass crank = 1kg inertia 2;
        mass other = 1kg inertia 3;
        torque on crank = 7Nm;
        energy;
    }";
    let mut cranks = simulation(text, 2.0, options(1e-11));
    cranks.advance(2.0).expect("no end");
    let [angle, rate] = coordinate(&cranks, "phi_crank");
    // (2 + 2² · 3) s̈ = 7.
    assert!(
        (angle - 3.0).abs() <= 1e-10 && (rate - 2.0).abs() <= 1e-10,
        "{angle} {rate}"
    );
    let [other, _] = coordinate(&cranks, "phi_other");
    assert!((other - 7.0).abs() <= 1e-10);
}

/// The rate of one of two free coordinates vanishes in between.
#[test]
fn one_of_two_coordinates_may_stand_still() {
    let text = |free: &str| {
        description::source("free_linkage")
            .text
            .replace("free turn: phi(crank) = atan2(0.3, 0.2) rate 0.5;", free)
    };
    let reference = text("free turn: phi(crank) = atan2(0.3, 0.2) rate 6;");
    let start = simulation(&reference, 0.0, options(1e-12));
    let changed = text(&freed(&start, "phi_rocker", "phi(rocker)"));
    let (_, worst) = followed(&changed, &reference, 3.0, 150);
    assert!(worst[0] <= 1e-8 && worst[1] <= 1e-8, "{worst:?}");
}

/// Reactions do not depend on the choice of the free coordinates.
#[test]
fn reactions_and_efforts_stay_those_of_the_description() {
    let reference = engine("free turn: phi(crank) = pi/4 rate 25; effort;");
    let start = simulation(&reference, 0.0, options(1e-12));
    let written = freed(&start, "x_piston", "x(piston)") + " effort;";
    let mut reference = simulation(&reference, 1.0, options(1e-13));
    let mut changed = simulation(&engine(&written), 1.0, options(1e-13));
    let names = |it: &Simulation| -> Vec<String> {
        let names = linkwright_solver::reported::names(it.view().pool(), it.view().system());
        names.into_iter().map(|(name, _)| name).collect()
    };
    let described = names(&changed);
    for step in 1..=50 {
        let t = 0.02 * f64::from(step);
        reference.advance(t).expect("no end");
        changed.advance(t).expect("no end");
        assert_eq!(names(&changed), described);
        let [own, others] =
            [&changed, &reference].map(|it| it.view().reported(it.frame()).expect("known"));
        let largest = others.iter().map(|it| it.abs()).fold(0.0, f64::max);
        for (name, (one, other)) in described.iter().zip(own.iter().zip(&others)) {
            assert!(
                (one - other).abs() <= 1e-8 * largest,
                "{t} {name}: {one} {other}"
            );
        }
    }
}
