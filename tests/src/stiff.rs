//! Mechanisms with a damper that makes them stiff, and their motions: in closed form, or by short steps in
//! coordinates of their own.

use linkwright_solver::dormand_prince::Step;
use linkwright_solver::rates::Rates;
use linkwright_solver::simulation::Effort;
use linkwright_solver::{Method, Simulation, SimulationOptions, Stop, Tolerances};

use crate::multipliers::larger;
use crate::simulated::{coordinate, simulation};

/// Number of instants at which a motion is compared.
pub const INSTANTS: u32 = 40;

const MASS: f64 = 2.0;
const STIFFNESS: f64 = 50.0;
const GRAVITY: f64 = 9.81;
const BOB: f64 = 1.0;
const ARM: f64 = 0.5;
const INERTIA: f64 = 0.01;

/// Mechanism with a damper.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Damped {
    /// A mass between a spring and a damper, pushed by 3 N · sin(2 t).
    Slider,
    /// A pendulum that hangs on such a mass, without an external force.
    Cart,
}

/// Coordinates and rates: of the mass, and of the pendulum.
type State = [f64; 4];

/// Largest error of a simulated motion, and its effort.
#[derive(Clone, Copy, Debug)]
pub struct Found {
    /// Error in m or rad, and m/s or rad/s.
    pub error: f64,
    /// Evaluations and steps.
    pub effort: Effort,
}

impl Damped {
    /// Description, with a damper (N·s/m).
    pub fn text(self, damper: f64) -> String {
        let (more, force) = match self {
            Damped::Slider => (String::new(), "force on mass.P = (3N*sin(2*t), 0);"),
            Damped::Cart => (
                format!(
                    "body bob at P {{ P, S: (0, -{ARM}) }}
                    revolute P(mass, bob);
                    free swing: phi(bob) = 1;
                    mass bob = {BOB}kg at S inertia {INERTIA};"
                ),
                "gravity = (0, -9.81);",
            ),
        };
        format!(
            "mechanism damped {{
                point W = (-2, 0), P = (0, 0);
                body mass at P {{ P }}
                absolute_y(mass) = 0;
                absolute_angle(mass) = 0;
                free slide: x(mass) = 0.1;
                mass mass = {MASS}kg;
                {more}
                {force}
                spring (ground.W, mass.P) = {STIFFNESS} free 2;
                damper (ground.W, mass.P) = {damper};
                energy;
            }}"
        )
    }

    /// Motion at equal intervals of time up to the end: that of the slider in closed form.
    pub fn motion(self, damper: f64, end: f64) -> Vec<State> {
        let times = (1..=INSTANTS).map(|step| end * f64::from(step) / f64::from(INSTANTS));
        match self {
            Damped::Slider => times.map(|t| pushed(damper, t)).collect(),
            Damped::Cart => swung(damper, &times.collect::<Vec<f64>>()),
        }
    }

    /// Compares a simulation with that motion.
    ///
    /// # Errors
    /// The simulation ends early.
    pub fn compared(
        self,
        damper: f64,
        motion: &[State],
        end: f64,
        options: SimulationOptions,
    ) -> Result<Found, Stop> {
        let mut simulation = simulation(&self.text(damper), end, options);
        let mut error = 0.0_f64;
        for (step, state) in motion.iter().enumerate() {
            let t = end * (step + 1) as f64 / motion.len() as f64;
            simulation.advance(t)?;
            let simulated = self.state(&simulation);
            for (one, other) in simulated.iter().zip(state) {
                error = larger(error, (one - other).abs());
            }
        }
        Ok(Found {
            error,
            effort: simulation.effort(),
        })
    }

    /// Coordinates and rates of a simulation.
    pub fn state(self, simulation: &Simulation) -> State {
        let [place, rate] = coordinate(simulation, "x_mass");
        let [angle, spin] = match self {
            Damped::Slider => [0.0; 2],
            Damped::Cart => coordinate(simulation, "phi_bob"),
        };
        [place, rate, angle, spin]
    }
}

/// SimulationOptions of a method.
pub fn options(method: Method, relative: f64) -> SimulationOptions {
    SimulationOptions {
        method,
        ..crate::simulated::options(relative)
    }
}

/// m ẍ + d ẋ + k x = 3 sin 2t from x = 0.1 at rest.
fn pushed(damper: f64, t: f64) -> State {
    let (force, omega) = (3.0, 2.0);
    let [along, across] = [STIFFNESS - MASS * omega * omega, damper * omega];
    let size = force / (along * along + across * across);
    let (sine, cosine) = (omega * t).sin_cos();
    let steady = [
        size * (along * sine - across * cosine),
        size * omega * (along * cosine + across * sine),
    ];
    let [place, rate] = [0.1 + size * across, -size * omega * along];
    let inner = damper * damper - 4.0 * MASS * STIFFNESS;
    let free = if inner > 0.0 {
        let fast = -(damper + inner.sqrt()) / (2.0 * MASS);
        let slow = STIFFNESS / (MASS * fast);
        let slow_part = (rate - fast * place) / (slow - fast) * (slow * t).exp();
        let other = (slow * place - rate) / (slow - fast) * (fast * t).exp();
        [slow_part + other, slow * slow_part + fast * other]
    } else {
        let decay = damper / (2.0 * MASS);
        let turn = (-inner).sqrt() / (2.0 * MASS);
        let (sine, cosine) = (turn * t).sin_cos();
        let side = (rate + decay * place) / turn;
        let left = (-decay * t).exp();
        let value = left * (place * cosine + side * sine);
        let moved = left * turn * (side * cosine - place * sine);
        [value, moved - decay * value]
    };
    [steady[0] + free[0], steady[1] + free[1], 0.0, 0.0]
}

/// Lagrange's equations of the cart and its pendulum.
struct Lagrange {
    damper: f64,
}

impl Rates for Lagrange {
    type Failure = ();

    fn rates(&mut self, _t: f64, state: &[f64], rates: &mut [f64]) -> Result<(), ()> {
        let [place, rate, angle, spin] = [0, 1, 2, 3].map(|component: usize| state[component]);
        let (sine, cosine) = angle.sin_cos();
        let coupling = BOB * ARM * cosine;
        let [own, about] = [MASS + BOB, INERTIA + BOB * ARM * ARM];
        let force = BOB * ARM * spin * spin * sine - self.damper * rate - STIFFNESS * place;
        let torque = -BOB * GRAVITY * ARM * sine;
        let determinant = own * about - coupling * coupling;
        rates.copy_from_slice(&[
            rate,
            (about * force - coupling * torque) / determinant,
            spin,
            (own * torque - coupling * force) / determinant,
        ]);
        Ok(())
    }

    fn judged(&self) -> usize {
        4
    }
}

/// Motion of the cart by steps of order 8 that are shorter than any decay.
fn swung(damper: f64, times: &[f64]) -> Vec<State> {
    let mut equations = Lagrange { damper };
    let tolerances = Tolerances {
        relative: 1.0,
        absolute: 1.0,
    };
    let longest = (2.0 / damper).min(1e-3);
    let mut state = vec![0.1, 0.0, 1.0, 0.0];
    let mut last = 0.0;
    let mut states = Vec::new();
    for &time in times {
        let count = ((time - last) / longest).ceil();
        for step in 0..count as u64 {
            let range = [step, step + 1].map(|it| last + (time - last) * it as f64 / count);
            let mut slope = vec![0.0; 4];
            equations
                .rates(range[0], &state, &mut slope)
                .expect("everywhere");
            let taken = Step::attempt(&mut equations, range, &state, &slope, &tolerances);
            state = taken.expect("everywhere").end().to_vec();
        }
        last = time;
        states.push([0, 1, 2, 3].map(|component: usize| state[component]));
    }
    states
}
