//! Simulated motions of descriptions with free coordinates, and their references.

use linkwright::{Blocks, Shell, Signal};
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::{
    InputSignals, Instant, Interpreted, Numbers, Simulation, SimulationOptions, Tolerances, View,
};

use crate::forces::systems;

/// Options of a test: a relative tolerance, with a far smaller absolute one.
pub fn options(relative: f64) -> SimulationOptions {
    SimulationOptions {
        tolerances: Tolerances {
            relative,
            absolute: relative * 1e-3,
        },
        method: Default::default(),
    }
}

/// Interpreter of a text.
///
/// # Panics
/// If it has errors.
pub fn interpreted(text: &str) -> Interpreted {
    let derived: &Derived = &systems("simulated", text)[0];
    Interpreted::new(derived).expect("an order")
}

/// Simulation of a text with forces from its start.
///
/// # Panics
/// If it has errors, or cannot be assembled.
pub fn simulation(text: &str, end: f64, options: SimulationOptions) -> Simulation {
    let view = interpreted(text);
    Simulation::new(&view, None, end, options).expect("it starts as drawn")
}

/// Instant that the blocks solve from the free coordinates of a simulation's frame.
///
/// # Panics
/// If they cannot be assembled there.
pub fn by_blocks(view: &Interpreted, simulation: &Simulation) -> Instant {
    let (frame, layout) = (simulation.frame(), simulation.view().layout());
    let slot = |symbol| frame.values()[layout.slot(symbol).expect("kept")];
    let inputs = view.system().mechanism.inputs.iter();
    let inputs = inputs.map(|input| {
        let [value, rate, acceleration] = input.symbols.map(slot);
        Signal::new(value, rate, acceleration)
    });
    let (inputs, pose) = (InputSignals(inputs.collect()), Numbers(frame.q().to_vec()));
    let (parameters, modes) = (view.nominal_parameters(), view.drawn_branches());
    let settings = Default::default();
    let blocks = view.clone();
    let shell = Shell::assemble(
        blocks,
        &parameters,
        &pose,
        modes,
        frame.t(),
        &inputs,
        settings,
    );
    shell.expect("as drawn").frame().clone()
}

/// A coordinate and its rate.
///
/// # Panics
/// If there is none of this name.
pub fn coordinate(simulation: &Simulation, name: &str) -> [f64; 2] {
    let coordinates = &simulation.view().system().coordinates;
    let place = coordinates.iter().position(|it| it.name == name);
    let place = place.unwrap_or_else(|| panic!("no {name}"));
    let frame = simulation.frame();
    [frame.q()[place], frame.qd()[place]]
}

/// Requested force.
///
/// # Panics
/// If it is not requested.
pub fn force(simulation: &Simulation, name: &str) -> f64 {
    let view = simulation.view();
    let names = linkwright_solver::reported::names(view.pool(), view.system());
    let place = names.iter().position(|(own, _)| own == name);
    let values = view.reported(simulation.frame()).expect("known");
    values[place.unwrap_or_else(|| panic!("no {name}"))]
}

/// The kinetic and the potential energy, which must be asked for (J).
pub fn energy(simulation: &Simulation) -> f64 {
    ["kinetic_energy", "potential_energy"]
        .iter()
        .map(|name| force(simulation, name))
        .sum()
}

/// A pendulum that starts at rest.
pub const PENDULUM: &str = "mechanism pendulum {
    point O = (0, 0);
    body bob at O { O, S: (0, -2) }
    revolute O(ground, bob);
    free swing: phi(bob) = 150deg;
    mass bob = 3kg at S inertia 0.5;
    gravity = (0, -9.81);
    energy;
}";

/// Its angle and the rate of it: sin(θ/2) = k cd(ω t, k²) with k = sin(θ₀/2).
pub fn swung(t: f64) -> [f64; 2] {
    let k = 75_f64.to_radians().sin();
    let omega = (3.0_f64 * 2.0 * 9.81 / (0.5 + 3.0 * 4.0)).sqrt();
    let [sn, cn, dn] = elliptic(omega * t, k * k);
    let half = k * cn / dn;
    let bend = -k * (1.0 - k * k) * sn / (dn * dn);
    [
        2.0 * half.asin(),
        2.0 * omega * bend / (1.0 - half.powi(2)).sqrt(),
    ]
}

/// sn, cn and dn of u with the parameter m, by the arithmetic-geometric mean (Abramowitz and Stegun 16.4).
pub fn elliptic(u: f64, m: f64) -> [f64; 3] {
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

/// The windowed four-bar with two windows: bars of 1 m and 1 kg that are drawn at an angle from upright, to the right.
pub fn n_four_bar(angle: f64, free: &str) -> String {
    let bar = "inertia 1kg*1m^2/12";
    let (sine, cosine) = angle.sin_cos();
    let [b0, b1, b2] = [0.0, 1.0, 2.0].map(|x| x + sine);
    format!(
        "mechanism n_four_bar {{
            point A0 = (0, 0), A1 = (1, 0), A2 = (2, 0), B0 = ({b0:?}, {cosine:?}), B1 = ({b1:?}, {cosine:?}), B2 = ({b2:?}, {cosine:?});
            body link0 at A0 facing A0 -> B0 {{ A0, B0, S: (0.5, 0) }}
            body link1 at A1 facing A1 -> B1 {{ A1, B1, S: (0.5, 0) }}
            body link2 at A2 facing A2 -> B2 {{ A2, B2, S: (0.5, 0) }}
            body bar0 at B0 {{ B0, B1, S: (0.5, 0) }}
            body bar1 at B1 {{ B1, B2, S: (0.5, 0) }}
            revolute A0(ground, link0);
            revolute A1(ground, link1);
            revolute A2(ground, link2);
            revolute B0(link0, bar0);
            revolute B1(bar0, link1);
            revolute B1(link1, bar1);
            revolute B2(bar1, link2);
            {free}
            mass link0 = 1kg at S {bar};
            mass link1 = 1kg at S {bar};
            mass link2 = 1kg at S {bar};
            mass bar0 = 1kg at S {bar};
            mass bar1 = 1kg at S {bar};
            gravity = (0, -9.81);
            energy;
        }}"
    )
}
