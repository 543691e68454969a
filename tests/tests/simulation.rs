//! What forces move, against closed solutions in elliptic functions, against 28 digits of Andrews' mechanism, and against energy.

use linkwright_codegen::stages::system::System;
use linkwright_solver::interpreted::Interpreted;
use linkwright_solver::simulation::{Options, Simulation, Stop, Tolerances};
use linkwright_solver::view::View;
use linkwright_tests::description;
use linkwright_tests::forces::systems;

/// The options of a test: a relative tolerance, with an absolute one far below what is asked.
fn options(relative: f64) -> Options {
    Options {
        tolerances: Tolerances {
            relative,
            absolute: relative * 1e-3,
        },
        goes_through: false,
    }
}

fn interpreted(text: &str) -> Interpreted {
    let system: &System = &systems("simulated", text)[0];
    Interpreted::new(system).expect("an order")
}

fn simulation(text: &str, end: f64, options: Options) -> Simulation {
    let view = interpreted(text);
    Simulation::new(&view, None, end, options).expect("it starts as drawn")
}

/// A coordinate and its rate.
fn coordinate(simulation: &Simulation, name: &str) -> [f64; 2] {
    let coordinates = &simulation.view().system().coordinates;
    let place = coordinates.iter().position(|it| it.name == name);
    let place = place.unwrap_or_else(|| panic!("no {name}"));
    let frame = simulation.frame();
    [frame.q()[place], frame.qd()[place]]
}

/// A force that is asked for.
fn force(simulation: &Simulation, name: &str) -> f64 {
    let view = simulation.view();
    let names = linkwright_solver::forces::names(view.system());
    let place = names.iter().position(|(own, _)| own == name);
    let values = view.forces(simulation.frame()).expect("known");
    values[place.unwrap_or_else(|| panic!("no {name}"))]
}

fn energy(simulation: &Simulation) -> f64 {
    ["kinetic_energy", "potential_energy"]
        .iter()
        .map(|name| force(simulation, name))
        .sum()
}

/// sn, cn and dn of u with the parameter m, by the arithmetic-geometric mean (Abramowitz and Stegun 16.4).
fn elliptic(u: f64, m: f64) -> [f64; 3] {
    let (mut a, mut b, mut ratios) = (1.0_f64, (1.0 - m).sqrt(), Vec::new());
    let mut factor = 1.0;
    while ratios.last().is_none_or(|ratio: &f64| *ratio > 1e-17) && ratios.len() < 12 {
        let c = 0.5 * (a - b);
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
        ratios.push(c / a);
        factor *= 2.0;
    }
    let mut angle = factor * a * u;
    for ratio in ratios.iter().rev() {
        angle = 0.5 * (angle + (ratio * angle.sin()).asin());
    }
    let (sn, cn) = angle.sin_cos();
    [sn, cn, (1.0 - m * sn * sn).sqrt()]
}

const PENDULUM: &str = "mechanism pendulum {
    point O = (0, 0);
    body bob at O { O, S: (0, -2) }
    revolute O(ground, bob);
    free swing: phi(bob) = 150deg;
    mass bob = 3kg at S inertia 0.5;
    gravity = (0, -9.81);
    energy;
}";

/// sin(θ/2) = k cd(ω t, k²) with k = sin(θ₀/2): from rest at 150 degrees, several periods.
#[test]
fn a_pendulum_swings_as_elliptic_functions_do() {
    let mut pendulum = simulation(PENDULUM, 20.0, options(1e-12));
    let first = energy(&pendulum);
    let k = (75.0_f64).to_radians().sin();
    let omega = (3.0_f64 * 2.0 * 9.81 / (0.5 + 3.0 * 4.0)).sqrt();
    for step in 1..=200 {
        let t = 0.1 * f64::from(step);
        pendulum.advance(t).expect("no end");
        let [sn, cn, dn] = elliptic(omega * t, k * k);
        let angle = 2.0 * (k * cn / dn).asin();
        let bend = -k * (1.0 - k * k) * sn / (dn * dn);
        let rate = 2.0 * omega * bend / (1.0 - (k * cn / dn).powi(2)).sqrt();
        let found = coordinate(&pendulum, "phi_bob");
        assert!((found[0] - angle).abs() <= 1e-9, "{t}: {found:?} {angle}");
        assert!((found[1] - rate).abs() <= 1e-9, "{t}: {found:?} {rate}");
        assert!((energy(&pendulum) - first).abs() <= 1e-9 * 3.0 * 9.81 * 4.0);
    }
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

/// An index-3 code took 1,112 steps (PSIDE, rtol = atol = 1e-14, the published reference of the Test Set for IVP Solvers).
#[test]
fn andrews_mechanism_arrives_where_it_should() {
    let mut andrews = simulation(&andrews(), 0.03, options(1e-9));
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
    println!("{worst:?} {effort:?}");
    assert!(worst[0] <= 1e-9 && worst[1] <= 1e-8, "{worst:?}");
    assert!(effort.evaluations <= 2500, "{effort:?}");
}
