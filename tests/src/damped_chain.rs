//! Chains of pendulums with a damper in each joint between them, and their motions beside the limit in which they turn as one body.
//!
//! Of strong dampers D, what they exert follows from the pose and the rates to 1/D² (singular perturbation): the chain turns as one body, its
//! joints creep by what they carry over D, and its angular momentum about the pivot changes by gravity alone. With weak ones Lagrange's
//! equations are integrated in steps shorter than any decay.

use linkwright_solver::dormand_prince::Step;
use linkwright_solver::rates::Rates;
use linkwright_solver::{SimulationOptions, Stop, Tolerances};
use nalgebra::{DMatrix, DVector};

use crate::multipliers::larger;
use crate::simulated::{coordinate, simulation};
use crate::stiff::{Found, INSTANTS};

const GRAVITY: f64 = 9.81;

/// Damper from which on the motion is that of the limit.
const STRONG: f64 = 1e5;

/// Longest step of a reference (s).
const LONGEST: f64 = 1e-3;

/// Lengths, masses, inertias and angles at the start of the pendulums; each has its mass at a part of its length.
const LENGTHS: [f64; 3] = [0.5, 0.4, 0.3];
const MASSES: [f64; 3] = [1.0, 0.7, 0.5];
const INERTIAS: [f64; 3] = [0.02, 0.01, 0.005];
const ANGLES: [f64; 3] = [1.0, 1.7, 0.2];
const PART: f64 = 0.6;

/// Distance of a damper's ends from the joint.
const ARM: f64 = 0.3;

/// A chain of pendulums from rest.
#[derive(Clone, Copy, Debug)]
pub struct DampedChain {
    /// Number of pendulums, at most three.
    pub count: usize,
    /// Damper in each joint between them (N·m·s), or between points of both beside it (N·s/m).
    pub damper: f64,
    /// What acts between them.
    pub element: Element,
}

/// What resists the motion of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Element {
    /// A damper about the joint.
    Joint,
    /// A damper between two points.
    Strut,
    /// Two torques whose formula is that of a damper about the joint.
    Torques,
    /// Two forces whose formula is that of a damper between two points.
    Forces,
}

impl DampedChain {
    /// The description.
    pub fn text(self) -> String {
        let mut places = vec![[0.0, 0.0]];
        let mut text = String::new();
        for link in 0..self.count {
            let [x, y] = places[link];
            let (sine, cosine) = ANGLES[link].sin_cos();
            places.push([x + LENGTHS[link] * sine, y - LENGTHS[link] * cosine]);
            let [length, center] = [LENGTHS[link], PART * LENGTHS[link]];
            let next = link + 1;
            let before = match link {
                0 => "ground".to_string(),
                _ => format!("b{link}"),
            };
            text += &format!(
                "body b{next} at ({x:?}, {y:?}, {}) {{ P{link}: (0, 0), P{next}: (0, -{length}), S: (0, -{center}), U{next}: (0, {}), V{next}: (0, -{ARM}) }}
                revolute P{link}({before}, b{next});
                free turn{next}: phi(b{next}) = {};
                mass b{next} = {}kg at S inertia {};\n",
                ANGLES[link], ARM - length, ANGLES[link], MASSES[link], INERTIAS[link]
            );
            if link > 0 {
                text += &self.between(link);
            }
        }
        let points = places.iter().enumerate();
        let points = points.map(|(place, [x, y])| format!("P{place} = ({x:?}, {y:?})"));
        let points: Vec<String> = points.collect();
        let points = points.join(", ");
        format!(
            "mechanism damped_chain {{ point {points};\n{text}gravity = (0, -{GRAVITY}); energy; }}"
        )
    }

    /// What acts between a pendulum and the next one.
    fn between(self, link: usize) -> String {
        let (next, damper) = (link + 1, self.damper);
        let [near, far] = [format!("b{link}.U{link}"), format!("b{next}.V{next}")];
        match self.element {
            Element::Joint => format!("damper about (b{link}, b{next}) = {damper};\n"),
            Element::Strut => format!("damper ({near}, {far}) = {damper};\n"),
            Element::Torques => format!(
                "torque on b{link} = {damper}*rate(phi(b{next}) - phi(b{link}));
                torque on b{next} = -{damper}*rate(phi(b{next}) - phi(b{link}));\n"
            ),
            Element::Forces => {
                let distance = format!("distance({near}, {far})");
                let along = |axis: char| {
                    format!("{damper}*rate({distance})*({axis}({far}) - {axis}({near}))/{distance}")
                };
                let [x, y] = ['x', 'y'].map(along);
                format!("force on {near} = ({x}, {y});\nforce on {far} = (-{x}, -{y});\n")
            }
        }
    }

    /// Angles, then rates, at equal distances of time up to the end.
    pub fn motion(self, end: f64) -> Vec<Vec<f64>> {
        let times = (1..=INSTANTS).map(|step| end * f64::from(step) / f64::from(INSTANTS));
        let times: Vec<f64> = times.collect();
        let angles = &ANGLES[..self.count];
        match self.about(&ANGLES, 1) >= STRONG {
            true => {
                let state = angles.iter().copied().chain([0.0]).collect();
                let states = integrated(&mut AsOne(self), state, &times, LONGEST);
                let with_rates = states.into_iter().map(|state| {
                    let (angles, momentum) = (&state[..self.count], state[self.count]);
                    let rates = self.creeping(angles, momentum);
                    angles
                        .iter()
                        .copied()
                        .chain(rates.iter().copied())
                        .collect()
                });
                with_rates.collect()
            }
            false => {
                let state = angles
                    .iter()
                    .copied()
                    .chain(vec![0.0; self.count])
                    .collect();
                let most = match self.element {
                    Element::Strut | Element::Forces => self.damper * ARM * ARM,
                    Element::Joint | Element::Torques => self.damper,
                };
                let longest = LONGEST.min(0.01 / most);
                integrated(&mut Lagrange(self), state, &times, longest)
            }
        }
    }

    /// The largest error of a simulation beside a motion, and its effort.
    ///
    /// # Errors
    /// It ends early.
    pub fn compared(
        self,
        motion: &[Vec<f64>],
        end: f64,
        options: SimulationOptions,
    ) -> Result<Found, Stop> {
        let mut simulation = simulation(&self.text(), end, options);
        let mut error = 0.0_f64;
        for (step, expected) in motion.iter().enumerate() {
            simulation.advance(end * (step + 1) as f64 / motion.len() as f64)?;
            for link in 0..self.count {
                let found = coordinate(&simulation, &format!("phi_b{}", link + 1));
                let expected = [expected[link], expected[self.count + link]];
                for (one, other) in found.iter().zip(expected) {
                    let missed = (one - other).abs();
                    error = larger(error, missed);
                }
            }
        }
        Ok(Found {
            error,
            effort: simulation.effort(),
        })
    }

    /// Mass that a joint carries, times what is beyond it: m a of the pendulum itself and m l of those beyond.
    fn moment(self, link: usize) -> f64 {
        let beyond: f64 = MASSES[link + 1..self.count].iter().sum();
        LENGTHS[link] * (PART * MASSES[link] + beyond)
    }

    /// Constant factors of cos(φᵢ − φⱼ) in M.
    fn factor(self, one: usize, other: usize) -> f64 {
        let [near, far] = [one.min(other), one.max(other)];
        match near == far {
            true => {
                let beyond: f64 = MASSES[far + 1..self.count].iter().sum();
                let own = PART * PART * MASSES[far] + beyond;
                INERTIAS[far] + LENGTHS[far] * LENGTHS[far] * own
            }
            false => LENGTHS[near] * self.moment(far),
        }
    }

    /// Damper about the joint before a link. That between two points at a distance a turns with it by ℓ² = 2 a² (1 + cos δ).
    fn about(self, angles: &[f64], link: usize) -> f64 {
        let half = 0.5 * (angles[link] - angles[link - 1]);
        match self.element {
            Element::Strut | Element::Forces => self.damper * (ARM * half.sin()).powi(2),
            Element::Joint | Element::Torques => self.damper,
        }
    }

    fn mass(self, angles: &[f64]) -> DMatrix<f64> {
        DMatrix::from_fn(self.count, self.count, |row, column| {
            self.factor(row, column) * (angles[row] - angles[column]).cos()
        })
    }

    /// Torques of gravity.
    fn weight(self, angles: &[f64]) -> DVector<f64> {
        DVector::from_fn(self.count, |link, _| {
            -GRAVITY * self.moment(link) * angles[link].sin()
        })
    }

    /// Torques of gravity and of turning.
    fn torques(self, angles: &[f64], rates: &[f64]) -> DVector<f64> {
        let mut torques = self.weight(angles);
        for row in 0..self.count {
            for column in 0..self.count {
                let turned = (angles[row] - angles[column]).sin();
                torques[row] -= self.factor(row, column) * turned * rates[column].powi(2);
            }
        }
        torques
    }

    /// Rates of a chain that turns as one body with this angular momentum while its joints creep.
    fn creeping(self, angles: &[f64], momentum: f64) -> DVector<f64> {
        let count = self.count;
        let mass = self.mass(angles);
        let one = mass.sum();
        let rates = vec![momentum / one; count];
        // M q̈ + Bᵀ λ = f and B q̈ = 0, where B subtracts each angle from the next one.
        let joints = count - 1;
        let mut whole = DMatrix::zeros(count + joints, count + joints);
        whole.view_mut((0, 0), (count, count)).copy_from(&mass);
        for joint in 0..joints {
            for (link, sign) in [(joint, -1.0), (joint + 1, 1.0)] {
                whole[(count + joint, link)] = sign;
                whole[(link, count + joint)] = sign;
            }
        }
        let mut right = DVector::zeros(count + joints);
        right
            .rows_mut(0, count)
            .copy_from(&self.torques(angles, &rates));
        let carried = whole.lu().solve(&right).expect("masses");
        let mut beside = DVector::zeros(count);
        for link in 1..count {
            beside[link] = beside[link - 1] + carried[count + link - 1] / self.about(angles, link);
        }
        let own = (momentum - (mass * &beside).sum()) / one;
        beside.add_scalar(own)
    }
}

/// Angles and angular momentum of a chain that turns as one body.
struct AsOne(DampedChain);

impl Rates for AsOne {
    type Failure = ();

    fn rates(&mut self, _t: f64, state: &[f64], rates: &mut [f64]) -> Result<(), ()> {
        let (angles, momentum) = state.split_at(self.0.count);
        let own = self.0.creeping(angles, momentum[0]);
        rates[..self.0.count].copy_from_slice(own.as_slice());
        rates[self.0.count] = self.0.weight(angles).sum();
        Ok(())
    }

    fn judged(&self) -> usize {
        self.0.count + 1
    }
}

/// Lagrange's equations of a chain.
struct Lagrange(DampedChain);

impl Rates for Lagrange {
    type Failure = ();

    fn rates(&mut self, _t: f64, state: &[f64], rates: &mut [f64]) -> Result<(), ()> {
        let count = self.0.count;
        let (angles, turning) = state.split_at(count);
        let mut torques = self.0.torques(angles, turning);
        for joint in 1..count {
            let damped = self.0.about(angles, joint) * (turning[joint] - turning[joint - 1]);
            torques[joint] -= damped;
            torques[joint - 1] += damped;
        }
        let own = self.0.mass(angles).lu().solve(&torques).expect("masses");
        rates[..count].copy_from_slice(turning);
        rates[count..].copy_from_slice(own.as_slice());
        Ok(())
    }

    fn judged(&self) -> usize {
        2 * self.0.count
    }
}

/// States at times by steps of order 8 of at most a length.
fn integrated<R: Rates<Failure = ()>>(
    rates: &mut R,
    mut state: Vec<f64>,
    times: &[f64],
    longest: f64,
) -> Vec<Vec<f64>> {
    let tolerances = Tolerances {
        relative: 1.0,
        absolute: 1.0,
    };
    let mut last = 0.0;
    let mut found = Vec::new();
    for &time in times {
        let count = ((time - last) / longest).ceil();
        for step in 0..count as u64 {
            let range = [step, step + 1].map(|it| last + (time - last) * it as f64 / count);
            let mut slope = vec![0.0; state.len()];
            rates
                .rates(range[0], &state, &mut slope)
                .expect("everywhere");
            let taken = Step::attempt(rates, range, &state, &slope, &tolerances);
            state = taken.expect("everywhere").end().to_vec();
        }
        last = time;
        found.push(state.clone());
    }
    found
}
