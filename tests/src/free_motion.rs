//! Mechanisms of the gallery whose drivers are free, from random states, beside all coordinates integrated with multipliers.
//!
//! Many of them start beside a dead center of what is called free, where the determinant of Φ_q with it is small. What is allowed is
//! measured by what a small change of the start becomes.

use linkwright::{Blocks, Shell, Signal};
use linkwright_solver::interpreted::Interpreted;
use linkwright_solver::simulation::Simulation;
use linkwright_solver::supplied::InputSignals;
use linkwright_solver::view::View;
use nalgebra::DVector;

use crate::files;
use crate::forces::Weight;
use crate::multipliers::{Motion, Multipliers};
use crate::random::Random;
use crate::simulated::{interpreted, options};
use crate::values::assembled_with;

/// Length of a motion (s), and number of times at which it is compared.
const TIME: f64 = 0.6;
const FRAMES: usize = 12;

/// The relative error of a step of the reference.
const EXACT: f64 = 1e-13;

/// Change of the start whose growth is seen.
const CHANGE: f64 = 1e-6;

/// The relative tolerances of simulations.
pub const TOLERANCES: [f64; 2] = [1e-7, 1e-10];

/// Powers of ten from which to which the rate of what is free lies, beside all rates.
const CLOSENESS: [f64; 2] = [-8.0, -1.0];

/// A mechanism of the gallery and what is free in it.
pub struct Freed {
    /// Its file.
    pub file: &'static str,
    free: &'static [Range],
}

/// A free coordinate, and where it starts.
struct Range {
    free: &'static str,
    start: Place,
}

#[derive(Clone, Copy)]
enum Place {
    /// Beside the dead center of a coordinate of this name.
    DeadCenter(&'static str),
    /// Around its value in the drawing: how far value and rate may be from there.
    Drawing(&'static str, f64, f64),
}

const fn turning(free: &'static str, name: &'static str) -> Range {
    Range {
        free,
        start: Place::DeadCenter(name),
    }
}

const fn around(free: &'static str, drawn: &'static str, value: f64, rate: f64) -> Range {
    Range {
        free,
        start: Place::Drawing(drawn, value, rate),
    }
}

/// Mechanisms with one free coordinate that turns back at a dead center.
pub const DEAD_CENTERS: [Freed; 6] = [
    Freed {
        file: "four_bar",
        free: &[turning("phi(rocker)", "phi_rocker")],
    },
    Freed {
        file: "slider_crank",
        free: &[turning("x(slider)", "x_slider")],
    },
    Freed {
        file: "inverted_slider_crank",
        free: &[turning("phi(sleeve)", "phi_sleeve")],
    },
    Freed {
        file: "quick_return",
        free: &[turning("phi(lever)", "phi_lever")],
    },
    Freed {
        file: "scotch_yoke",
        free: &[turning("x(yoke)", "x_yoke")],
    },
    Freed {
        file: "jansen",
        free: &[turning("phi(swing)", "phi_swing")],
    },
];

/// Mechanisms that start around their drawing.
pub const ANYWHERE: [Freed; 6] = [
    Freed {
        file: "stephenson",
        free: &[around("phi(arm)", "0", 0.2, 2.0)],
    },
    Freed {
        file: "peaucellier",
        free: &[around("phi(crank)", "0", 0.5, 3.0)],
    },
    Freed {
        file: "pantograph",
        free: &[
            around("near.P.x", "0.25", 0.05, 0.5),
            around("near.P.y", "0.1", 0.04, 0.5),
        ],
    },
    Freed {
        file: "platform_3rpr",
        free: &[
            around("length(A, P)", "distance(A, P)", 0.05, 0.5),
            around("length(B, Q)", "distance(B, Q)", 0.05, 0.5),
            around("length(C, R)", "distance(C, R)", 0.05, 0.5),
        ],
    },
    Freed {
        file: "arm",
        free: &[
            around("length(A, D)", "distance(A, D)", 0.03, 0.3),
            around("length(B, H)", "distance(B, H)", 0.03, 0.3),
        ],
    },
    Freed {
        file: "excavator",
        free: &[
            around("length(N, M)", "distance(N, M)", 0.03, 0.3),
            around("length(H, G)", "distance(H, G)", 0.03, 0.3),
        ],
    },
];

/// The end of a simulation.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// It went to the end, with this error in tolerances times growth.
    Went(f64),
    /// It ended with a typed error.
    Ended(String),
    /// It did not start, or there is no reference.
    NotCompared,
}

/// A simulation that is judged.
#[derive(Clone, Debug)]
pub struct Verdict {
    /// The mechanism.
    pub file: &'static str,
    /// Rate of the slowest free coordinate, beside the norm of all rates.
    pub closeness: f64,
    /// The relative tolerance.
    pub relative: f64,
    /// Its end.
    pub outcome: Outcome,
}

/// A mechanism with masses, and with free coordinates in place of its drivers.
struct Weighed {
    /// Without what is free, and the brace at the end.
    text: String,
    weights: Vec<Weight>,
    gravity: [f64; 2],
}

impl Weighed {
    fn new(file: &str, random: &mut Random) -> Weighed {
        let path = files::repository().join(format!("mechanisms/{file}.mech"));
        let read = std::fs::read_to_string(path).expect("a mechanism of the gallery");
        let lines = read.lines();
        let kept = lines.filter(|line| !line.trim_start().starts_with("drive "));
        let mut text = kept.collect::<Vec<_>>().join("\n");
        text.truncate(text.rfind('}').expect("an end"));
        let names: Vec<String> = text
            .lines()
            .filter_map(|line| line.trim_start().strip_prefix("body "))
            .map(|rest| rest.split_whitespace().next().expect("a name").to_string())
            .collect();
        let mut weights = Vec::new();
        for (body, name) in names.iter().enumerate() {
            let weight = Weight {
                body,
                mass: random.between(0.3, 2.0),
                center: [0, 1].map(|_| random.between(-0.05, 0.05)),
                inertia: random.between(0.001, 0.02),
            };
            let ([x, y], Weight { mass, inertia, .. }) = (weight.center, &weight);
            text += &format!("    mass {name} = {mass}kg at ({x}, {y}) inertia {inertia};\n");
            weights.push(weight);
        }
        let gravity = [random.between(-3.0, 3.0), random.between(-10.0, 0.0)];
        text += &format!("    gravity = ({}, {});\n", gravity[0], gravity[1]);
        Weighed {
            text,
            weights,
            gravity,
        }
    }

    /// The whole text, with what is free and where it starts.
    fn started(&self, free: &[(&str, String, f64)]) -> String {
        let lines = free.iter().enumerate();
        let lines = lines.map(|(place, (what, value, rate))| {
            format!("    free free{place}: {what} = {value} rate {rate};\n")
        });
        format!("{}{}}}\n", self.text, lines.collect::<String>())
    }
}

/// The pose that blocks find for a value of what is free.
fn pose(view: &Interpreted, value: f64) -> Option<Vec<f64>> {
    let inputs = InputSignals(vec![Signal::new(value, 0.0, 0.0)]);
    let found: Result<Shell<Interpreted>, _> =
        assembled_with(view.clone(), &[], 0.0, &inputs, Default::default());
    Some(found.ok()?.frame().q().to_vec())
}

/// The last value of what is free, from one in a direction, at which there is a pose; `None` where it goes on and on.
fn dead_center(view: &Interpreted, from: f64, mut step: f64) -> Option<f64> {
    let (mut inside, mut outside) = (from, from);
    for _ in 0..400 {
        outside += step;
        step *= 1.03;
        if pose(view, outside).is_none() {
            break;
        }
        inside = outside;
    }
    if pose(view, outside).is_some() {
        return None;
    }
    loop {
        let middle = 0.5 * (inside + outside);
        if middle == inside || middle == outside {
            return Some(inside);
        }
        match pose(view, middle) {
            Some(_) => inside = middle,
            None => outside = middle,
        }
    }
}

/// A motion of the reference at the times of frames, and how much a small change of its start has grown by then.
struct Expected {
    start: Motion,
    frames: Vec<(Motion, f64)>,
    /// The largest coordinate or rate.
    size: f64,
}

/// The largest difference of coordinates and rates.
fn apart(one: &Motion, other: &Motion) -> f64 {
    let pose = (&one.pose - &other.pose).amax();
    pose.max((&one.rates - &other.rates).amax())
}

fn frame(simulation: &Simulation) -> Motion {
    Motion {
        pose: DVector::from_column_slice(simulation.frame().q()),
        rates: DVector::from_column_slice(simulation.frame().qd()),
    }
}

impl Expected {
    /// From a start; `None` where the reference comes too close to a singular pose of the joints, or does not keep its energy.
    fn of(reference: &Multipliers, start: &Motion, random: &mut Random) -> Option<Expected> {
        let missed = reference.missed(start);
        assert!(missed < 1e-10, "{missed}");
        let mut changed = start.clone();
        for vector in [&mut changed.pose, &mut changed.rates] {
            let moved = DVector::from_fn(vector.len(), |_, _| random.between(-1.0, 1.0));
            let moved = reference.allowed(&start.pose, &moved);
            *vector += moved.scale(CHANGE / moved.amax());
        }
        reference.project(&mut changed);
        let change = apart(start, &changed);
        let mut own = start.clone();
        let (mut growth, mut size) = (1.0_f64, 1.0_f64);
        let mut lengths = [1e-3; 2];
        let mut frames = Vec::new();
        for _ in 0..FRAMES {
            let between = TIME / FRAMES as f64;
            own = reference.after(&own, between, EXACT, &mut lengths[0])?;
            changed = reference.after(&changed, between, EXACT, &mut lengths[1])?;
            growth = growth.max(apart(&changed, &own) / change);
            size = size.max(own.pose.amax()).max(own.rates.amax());
            frames.push((own.clone(), growth));
        }
        let [first, last] = [start, &own].map(|motion| reference.energy(motion));
        let is_kept = (last - first).abs() <= 1e-10 * (first.abs() + size);
        is_kept.then(|| Expected {
            start: start.clone(),
            frames,
            size,
        })
    }

    /// The largest error of a simulation, in tolerances × growth.
    ///
    /// # Errors
    /// That it ends.
    fn missed(&self, simulation: &mut Simulation, relative: f64) -> Result<f64, String> {
        let mut largest = 0.0_f64;
        for (step, (expected, growth)) in self.frames.iter().enumerate() {
            let ended = simulation.advance(TIME * (step + 1) as f64 / FRAMES as f64);
            ended.map_err(|stop| format!("{stop:?}"))?;
            let missed = apart(&frame(simulation), expected);
            largest = largest.max(missed / (relative * self.size * growth));
        }
        Ok(largest)
    }
}

/// Simulations from a start at all tolerances.
fn judged(
    weighed: &Weighed,
    file: &'static str,
    free: &[(&str, String, f64)],
    random: &mut Random,
) -> Vec<Verdict> {
    let view = interpreted(&weighed.started(free));
    let reference = Multipliers::new(view.system(), &weighed.weights, weighed.gravity);
    let mut expected: Option<Option<Expected>> = None;
    let mut closeness = f64::NAN;
    let verdicts = TOLERANCES.map(|relative| {
        let started = Simulation::new(&view, None, TIME, options(relative));
        let outcome = started.map_or(Outcome::NotCompared, |mut simulation| {
            let start = frame(&simulation);
            let slowest = reference.free_rates(&start).amin();
            closeness = slowest / start.rates.norm();
            let expected = expected.get_or_insert_with(|| Expected::of(&reference, &start, random));
            let Some(expected) = expected else {
                return Outcome::NotCompared;
            };
            let same = (&expected.start.pose, &expected.start.rates);
            assert_eq!((&start.pose, &start.rates), same);
            match expected.missed(&mut simulation, relative) {
                Ok(missed) => Outcome::Went(missed),
                Err(stop) => Outcome::Ended(stop),
            }
        });
        Verdict {
            file,
            closeness,
            relative,
            outcome,
        }
    });
    verdicts.to_vec()
}

impl Freed {
    /// Simulations from random states.
    ///
    /// # Panics
    /// If the description is no longer what is expected of it.
    pub fn judged(&self, states: usize, random: &mut Random) -> Vec<Verdict> {
        let weighed = Weighed::new(self.file, random);
        let mut verdicts = Vec::new();
        if let [
            Range {
                free,
                start: Place::DeadCenter(name),
            },
        ] = self.free
        {
            let start = weighed.started(&[(free, "0".to_string(), 0.0)]);
            let view = interpreted(&start);
            for _ in 0..states {
                let beside = beside_dead_center(&view, &weighed, name, random);
                let Some((value, rate)) = beside else {
                    continue;
                };
                let free = [(*free, value.to_string(), rate)];
                verdicts.extend(judged(&weighed, self.file, &free, random));
            }
            return verdicts;
        }
        for _ in 0..states {
            let free = self.free.iter().map(|range| {
                let Place::Drawing(drawn, value, rate) = range.start else {
                    panic!("{} is one of several", range.free);
                };
                let [value, rate] = [value, rate].map(|most| random.between(-most, most));
                (range.free, format!("{drawn} + ({value})"), rate)
            });
            let free: Vec<_> = free.collect();
            verdicts.extend(judged(&weighed, self.file, &free, random));
        }
        verdicts
    }
}

/// Value and rate of what is free in a pose beside its dead center, where it moves slowly beside all else.
fn beside_dead_center(
    view: &Interpreted,
    weighed: &Weighed,
    name: &str,
    random: &mut Random,
) -> Option<(f64, f64)> {
    let mut coordinates = view.system().coordinates.iter();
    let place = coordinates.position(|it| it.name == name);
    let place = place.unwrap_or_else(|| panic!("no {name}"));
    let at = view.drawn_pose(&view.nominal_parameters()).0[place];
    let reference = Multipliers::new(view.system(), &weighed.weights, weighed.gravity);
    let step = if random.bits().is_multiple_of(2) {
        0.01
    } else {
        -0.01
    };
    let limit = dead_center(view, at, step * at.abs().clamp(0.1, 1.0))?;
    // Beside it, what is free moves in proportion to the root of its distance.
    let close = 10.0_f64.powf(random.between(CLOSENESS[0], CLOSENESS[1]));
    let value = limit + (at - limit) * close * close;
    let own = DVector::from_vec(pose(view, value)?);
    let moved = DVector::from_fn(own.len(), |_, _| random.between(-1.0, 1.0));
    let rates = reference.allowed(&own, &moved);
    let rates = rates.scale(random.between(2.0, 6.0) / rates.amax());
    let rate = reference.free_rates(&Motion { pose: own, rates })[0];
    Some((value, rate))
}
