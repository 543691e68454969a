//! What forces move, against closed solutions in elliptic functions, against 28 digits of Andrews' mechanism, and against energy.

use linkwright::Signal;
use linkwright_solver::simulation::ReducedMotion;
use linkwright_solver::{Simulation, Stop, View};
use linkwright_tests::description;
use linkwright_tests::simulated::{
    PENDULUM, by_blocks, coordinate, energy, interpreted, n_four_bar, options, simulation, swung,
};

mod free_linkage {
    linkwright::include_mechanism!(free_linkage);
}

/// From rest at 150 degrees, several periods.
#[test]
fn a_pendulum_swings_as_elliptic_functions_do() {
    let mut pendulum = simulation(PENDULUM, 20.0, options(1e-12));
    let first = energy(&pendulum);
    for step in 1..=200 {
        let t = 0.1 * f64::from(step);
        pendulum.advance(t).expect("no end");
        let [angle, rate] = swung(t);
        let found = coordinate(&pendulum, "phi_bob");
        assert!((found[0] - angle).abs() <= 1e-9, "{t}: {found:?} {angle}");
        assert!((found[1] - rate).abs() <= 1e-9, "{t}: {found:?} {rate}");
        assert!((energy(&pendulum) - first).abs() <= 1e-9 * 3.0 * 9.81 * 4.0);
    }
}

/// A pendulum that has turned a thousand times is as accurate as one that has not, in as many steps.
#[test]
fn turns_of_the_past_allow_no_larger_errors() {
    let run = |turns: u32| {
        let start = format!("150deg + {turns}*360deg");
        let text = PENDULUM.replace("150deg", &start);
        let mut pendulum = simulation(&text, 5.0, options(1e-8));
        let first = energy(&pendulum);
        pendulum.advance(5.0).expect("no end");
        (pendulum.effort().steps, energy(&pendulum) - first)
    };
    let [(steps, drift), (more_steps, other_drift)] = [run(0), run(1000)];
    assert!(steps.abs_diff(more_steps) <= 2, "{steps} {more_steps}");
    assert!(
        drift.abs().max(other_drift.abs()) <= 1e-6,
        "{drift} {other_drift}"
    );
}

/// At t = 0.03 s, of which 28 digits are known: β, θ, γ, φ, δ, Ω, ε and their rates.
const ANDREWS: [[f64; 2]; 7] = [
    [15.810_771_195_153_707, 1_139.920_302_259_106_1],
    [-15.756_371_058_411_84, -1_424.379_295_177_540_1],
    [0.040_822_240_119_645_85, 11.032_911_910_618_594],
    [-0.534_730_116_342_079_6, 19.293_374_105_032_04],
    [0.524_409_965_879_954_1, 0.573_569_914_829_502_5],
    [0.534_730_116_342_079_6, -19.293_374_105_032_04],
    [1.048_080_741_041_938, 0.323_179_149_249_130_9],
];

/// The mechanism of the gallery, with the torque of the benchmark in place of its motor.
fn andrews() -> String {
    let mut text = description::source("andrews").text;
    let start = text.find("drive motor").expect("the driver");
    let end = start + text[start..].find(';').expect("its end");
    text.replace_range(
        start..end,
        "free motor: phi(k1) = beta; torque on k1 = 33mN*1m",
    );
    text
}

/// With fewer than 2,500 evaluations; an index-3 code took 1,112 steps, each with several evaluations and a factorization (PSIDE, rtol = atol = 1e-14, the published reference of the Test Set for IVP Solvers).
#[test]
fn andrews_mechanism_arrives_where_it_should() {
    let mut andrews = simulation(&andrews(), 0.03, options(1e-11));
    andrews.advance(0.03).expect("no end");
    let name = |body: usize| format!("phi_k{body}");
    let bodies: Vec<[f64; 2]> = (1..=7)
        .map(|body| coordinate(&andrews, &name(body)))
        .collect();
    let against = |body: usize, of: usize| {
        [0, 1].map(|level| bodies[body - 1][level] - bodies[of - 1][level])
    };
    let found = [
        bodies[0],
        against(2, 1),
        bodies[2],
        against(4, 5),
        bodies[4],
        against(6, 7),
        bodies[6],
    ];
    let mut worst = [0.0_f64; 2];
    for (found, expected) in found.iter().zip(&ANDREWS) {
        for level in 0..2 {
            let error = ((found[level] - expected[level]) / expected[level]).abs();
            worst[level] = worst[level].max(error);
        }
    }
    let effort = andrews.effort();
    assert!(worst[0] <= 1e-9 && worst[1] <= 1e-8, "{worst:?}");
    assert!(effort.evaluations <= 2500, "{effort:?}");
}

/// Two coordinates push one another: the accelerations of a double pendulum of two points, from Lagrange's equations written out.
#[test]
fn a_double_pendulum_has_the_accelerations_of_the_textbook() {
    let (m, n, l, k, g) = (1.5, 0.7, 0.9, 0.6, 9.81);
    for case in 0..50 {
        let turned = |step: f64| (step * f64::from(case) + 0.3) % 6.2 - 3.1;
        let [a, b, u, v] = [turned(0.7), turned(1.1), turned(1.9), turned(2.3)];
        let text = format!(
            "mechanism double {{
                point O = (0, 0);
                body upper at (0, 0, {a}) {{ O, Q: (0, -{l}) }}
                body lower at ({l}*sin({a}), -{l}*cos({a}), {b}) {{ Q: (0, 0), S: (0, -{k}) }}
                revolute O(ground, upper);
                revolute Q(upper, lower);
                free first: phi(upper) = {a} rate {u};
                free second: phi(lower) = {b} rate {v};
                mass upper = {m} at Q;
                mass lower = {n} at S;
                gravity = (0, -{g});
            }}"
        );
        let start = simulation(&text, 0.0, options(1e-9));
        let (sine, cosine) = (a - b).sin_cos();
        let mass = [(m + n) * l * l, n * l * k * cosine, n * k * k];
        let force = [
            -n * l * k * v * v * sine - (m + n) * g * l * a.sin(),
            n * l * k * u * u * sine - n * g * k * b.sin(),
        ];
        let determinant = mass[0] * mass[2] - mass[1] * mass[1];
        let expected = [
            (mass[2] * force[0] - mass[1] * force[1]) / determinant,
            (mass[0] * force[1] - mass[1] * force[0]) / determinant,
        ];
        let view = interpreted(&text);
        let (motion, frame) = (
            ReducedMotion::of(&view).expect("free"),
            by_blocks(&view, &start),
        );
        let reduced = motion.acceleration(&frame).expect("masses");
        let matrix = motion.mass(&frame);
        let accelerations = start.frame().qdd();
        let found = [accelerations[2], accelerations[5]];
        for (one, other) in reduced.iter().zip(found) {
            assert!((one - other).abs() <= 1e-12 * one.abs().max(100.0));
        }
        for (place, entry) in [((0, 0), 0), ((1, 0), 1), ((0, 1), 1), ((1, 1), 2)] {
            assert!((matrix[place] - mass[entry]).abs() <= 1e-14 * mass[0]);
        }
        for (found, expected) in reduced.iter().zip(expected) {
            let size = expected.abs().max(100.0);
            assert!(
                (found - expected).abs() <= 1e-13 * size,
                "{case}: {found} {expected}"
            );
        }
    }
}

/// What is free of it: it starts upright at 1 m/s.
const FREE_TURN: &str = "free turn: phi(link0) = pi/2 rate -1;";

/// On the parallelogram θ = 2 am(t/2 | −4 W g/I) with I = (N + 1)/3 + N and W = (N + 1)/2 + N, to 20 digits: B0 at t = 1, 4 and 10 s.
const N_FOUR_BAR: [(f64, [f64; 2]); 3] = [
    (1.0, [-0.195_020_301_949_435_1, -0.980_799_205_662_173_8]),
    (4.0, [0.117_616_102_376_808_61, 0.993_059_138_451_325_1]),
    (10.0, [0.328_458_111_540_815_4, 0.944_518_538_178_600_9]),
];

#[test]
fn an_n_four_bar_goes_straight_through_its_flat_poses() {
    let mut bars = simulation(&n_four_bar(0.0, FREE_TURN), 10.0, options(1e-12));
    let first = energy(&bars);
    for (t, expected) in N_FOUR_BAR {
        bars.advance(t).expect("no end");
        let [angle, _] = coordinate(&bars, "phi_link0");
        let found = [angle.cos(), angle.sin()];
        for axis in 0..2 {
            assert!(
                (found[axis] - expected[axis]).abs() <= 1e-9,
                "{t}: {found:?}"
            );
        }
        // It is still the parallelogram.
        let [bar, _] = coordinate(&bars, "phi_bar1");
        assert!(bar.sin().abs() <= 1e-9 && bar.cos() > 0.0, "{t}: {bar}");
        assert!((energy(&bars) - first).abs() <= 1e-9 * 70.0);
    }
    assert_eq!(bars.passed().len(), 10, "{:?}", bars.passed());
}

/// What a damper takes and a torque brings is what the energy changes by.
#[test]
fn work_and_energy_balance() {
    let text = PENDULUM.replace(
        "energy;",
        "damper about (ground, bob) = 0.4; torque on bob = 5Nm*sin(2*t); energy;",
    );
    let mut pendulum = simulation(&text, 20.0, options(1e-11));
    let first = energy(&pendulum);
    let mut largest = 0.0_f64;
    for step in 1..=100 {
        pendulum.advance(0.2 * f64::from(step)).expect("no end");
        let work = pendulum.added_work().expect("on the step");
        largest = largest.max(work.abs());
        assert!((energy(&pendulum) - first - work).abs() <= 1e-8, "{step}");
    }
    assert!(largest > 10.0);
}

/// A free coordinate that moves nothing with a mass has no acceleration.
#[test]
fn what_has_no_mass_has_no_acceleration() {
    let text = "mechanism weightless {
        point O = (0, 0), Q = (1, 0);
        body one at O { O }
        body other at Q { Q }
        revolute O(ground, one);
        revolute Q(ground, other);
        free a: phi(one) = 0;
        free b: phi(other) = 0;
        mass one = 1kg inertia 2;
        torque on other = 1Nm;
    }";
    let view = interpreted(text);
    let stop = Simulation::new(&view, None, 1.0, options(1e-9)).expect_err("no mass");
    assert_eq!(
        stop,
        Stop::Massless {
            t: 0.0,
            coordinates: vec![1]
        }
    );
    let said = stop.not_begun(&view);
    assert!(said.contains("`free b: phi(other)`"), "{said}");
}

/// x = (1 − t)·φ moves a mass m, so that the reduced mass m·(1 − t)² of φ vanishes at t = 1 s. The other free coordinate keeps its own.
#[test]
fn a_coordinate_that_loses_its_mass_is_named_alone() {
    let text = "mechanism fading {
        point O = (0, 0), W = (0.5, 0), Q = (0, 1);
        body arm at O { O }
        body slide at Q { S: (0, 0) }
        body wheel at W { W }
        revolute O(ground, arm);
        revolute W(ground, wheel);
        absolute_y(slide) = 1;
        absolute_angle(slide) = 0;
        equation x(slide.S) = 1m*(1 - t)*phi(arm);
        free a: phi(arm) = 0;
        free b: phi(wheel) = 0 rate 1;
        mass slide = 2kg;
        mass wheel = 1kg inertia 0.5;
    }";
    // The free coordinates in the other order have the other places.
    let turned = text.replace("free a: phi(arm) = 0;", "");
    let turned = turned.replace("mass slide", "free a: phi(arm) = 0; mass slide");
    for (text, place) in [(text, 0), (turned.as_str(), 1)] {
        let mut fading = simulation(text, 2.0, options(1e-9));
        let mut times = (1..=20).map(|step| 0.1 * f64::from(step));
        let stop = times.find_map(|t| fading.advance(t).err());
        let expected = Stop::Massless {
            t: 1.0,
            coordinates: vec![place],
        };
        assert_eq!(stop, Some(expected), "{text}");
    }
}

/// Generated functions give the reduced mass and force of the interpreter.
#[test]
fn generated_code_has_the_reduced_mass_and_force_of_the_interpreter() {
    let text = description::source("free_linkage").text;
    let mut linkage = simulation(&text, 1.0, options(1e-10));
    let view = interpreted(&text);
    let motion = ReducedMotion::of(&view).expect("free");
    let start = generated_inputs(&linkage);
    let mut mechanism = free_linkage::FreeLinkage::assemble(0.0, &start).expect("as drawn");
    for step in 1..=50 {
        let t = 0.02 * f64::from(step);
        linkage.advance(t).expect("no end");
        let inputs = generated_inputs(&linkage);
        let frame = mechanism.advance(t, &inputs).expect("a path");
        let instant = by_blocks(&view, &linkage);
        let (mass, force) = (motion.mass(&instant), motion.force(&instant));
        let pairs = [
            (frame.reduced_mass_turn(), mass[(0, 0)]),
            (frame.reduced_mass_swing_turn(), mass[(1, 0)]),
            (frame.reduced_mass_swing(), mass[(1, 1)]),
            (frame.reduced_force_turn(), force[0]),
            (frame.reduced_force_swing(), force[1]),
        ];
        for (found, expected) in pairs {
            assert_eq!(
                found.to_bits(),
                expected.to_bits(),
                "{t}: {found} {expected}"
            );
        }
    }
}

/// What the interpreter was solved with.
fn generated_inputs(simulation: &Simulation) -> free_linkage::Inputs {
    let system = simulation.view().system();
    let [turn, swing] = [0, 1].map(|input: usize| {
        let symbols = system.mechanism.inputs[input].symbols;
        let layout = simulation.view().layout();
        let value =
            symbols.map(|symbol| simulation.frame().values()[layout.slot(symbol).expect("kept")]);
        Signal::new(value[0], value[1], value[2])
    });
    free_linkage::Inputs { turn, swing }
}
