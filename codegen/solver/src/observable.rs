//! *A system* → *what of its motion can be measured*, by the names that tables of frames have: coordinates, their rates and
//! accelerations, points, and the forces that are asked for.
//!
//! Names that other programs give are guessed at by their parts, an object and a component; whoever uses a guess says so. The module
//! does not know tables.

use linkwright_codegen::stages::columns::Unit;
use linkwright_codegen::stages::joint::Quantity;
use linkwright_codegen::stages::model::Body;
use linkwright_codegen::stages::system::System;

use crate::instant::Instant;
use crate::view::View;

/// Something of a motion that is a number at every instant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Observable {
    /// A coordinate (0), its rate (1) or its acceleration (2).
    Coordinate {
        /// Its place among the coordinates.
        place: usize,
        /// How often it is differentiated.
        level: usize,
    },
    /// A component of a point.
    Point {
        /// Its place among the outputs.
        place: usize,
        /// 0 for x, 1 for y.
        axis: usize,
        /// 0 for its position, 1 for its velocity, 2 for its acceleration.
        level: usize,
    },
    /// A force that is asked for: its place among [`crate::forces::names`].
    Force(usize),
}

/// An observable with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct Named {
    /// As in tables of frames: `phi2`, `phi2_d`, `K_x`, `K_vx`, `effort_crank`.
    pub name: String,
    /// What it is.
    pub observable: Observable,
    /// Powers of m, s, kg and rad.
    pub powers: [i32; 4],
    /// The unit that tables of frames have.
    pub unit: &'static str,
}

/// What a name is taken for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Guess {
    /// The place among all observables.
    pub place: usize,
    /// What else it could be, in words; empty where there is nothing.
    pub doubt: String,
}

/// What follows the name of a coordinate.
const RATES: [&str; 3] = ["", "_d", "_dd"];

/// What follows the name of a point.
const OF_POINT: [[&str; 2]; 3] = [["x", "y"], ["vx", "vy"], ["ax", "ay"]];

/// Units of the three levels, by what is measured.
const LENGTHS: [&str; 3] = ["m", "m/s", "m/s²"];
const ANGLES: [&str; 3] = ["rad", "rad/s", "rad/s²"];
const NUMBERS: [&str; 3] = ["", "1/s", "1/s²"];

/// All observables of a system, in the order of tables of frames.
pub fn all(system: &System) -> Vec<Named> {
    let mut all = Vec::new();
    for (level, suffix) in RATES.iter().enumerate() {
        for (place, coordinate) in system.coordinates.iter().enumerate() {
            let (units, length, angle) = match coordinate.quantity {
                Quantity::Length => (LENGTHS, 1, 0),
                Quantity::Angle => (ANGLES, 0, 1),
                Quantity::Power(_) => (NUMBERS, 0, 0),
            };
            all.push(Named {
                name: format!("{}{suffix}", coordinate.name),
                observable: Observable::Coordinate { place, level },
                powers: [length, [0, -1, -2][level], 0, angle],
                unit: units[level],
            });
        }
    }
    for (place, output) in system.outputs.iter().enumerate() {
        for (level, components) in OF_POINT.iter().enumerate() {
            for (axis, component) in components.iter().enumerate() {
                all.push(Named {
                    name: format!("{}_{component}", output.name),
                    observable: Observable::Point { place, axis, level },
                    powers: [1, [0, -1, -2][level], 0, 0],
                    unit: LENGTHS[level],
                });
            }
        }
    }
    for (place, (name, unit)) in crate::forces::names(system).into_iter().enumerate() {
        let powers = Unit::parse(unit).map_or([0; 4], |it| it.powers);
        all.push(Named {
            name,
            observable: Observable::Force(place),
            powers,
            unit,
        });
    }
    all
}

impl Observable {
    /// Whether it is an angle, of which whole turns cannot be told apart.
    pub fn is_angle(&self, system: &System) -> bool {
        match *self {
            Observable::Coordinate { place, level: 0 } => {
                system.coordinates[place].quantity == Quantity::Angle
            }
            _ => false,
        }
    }
}

/// The values of observables at an instant, in SI units; NaN for forces where the equations are singular.
pub fn values<V: View>(view: &V, observables: &[Observable], instant: &Instant) -> Vec<f64> {
    let has = |is: fn(&Observable) -> bool| observables.iter().any(is);
    let points = match has(|it| matches!(it, Observable::Point { .. })) {
        true => view.points(instant),
        false => Vec::new(),
    };
    let forces = match has(|it| matches!(it, Observable::Force(_))) {
        true => view.forces(instant).unwrap_or_default(),
        false => Vec::new(),
    };
    let value = |observable: &Observable| match *observable {
        Observable::Coordinate { place, level } => instant.coordinate(place).map(|it| it[level]),
        Observable::Point { place, axis, level } => points
            .get(place)
            .map(|it| [it.position, it.velocity, it.acceleration][level][axis]),
        Observable::Force(place) => forces.get(place).copied(),
    };
    let found = observables.iter().map(value);
    found.map(|it| it.unwrap_or(f64::NAN)).collect()
}

/// A component of a motion: x, y or the angle, and how often it is differentiated.
type Component = (usize, usize);

/// x, y or the angle of a body.
type Axis = usize;

/// Angles are the third coordinate of a body.
const TURN: Axis = 2;

/// What stands for x, y and the angle.
const AXES: [(&str, usize); 9] = [
    ("x", 0),
    ("y", 1),
    ("phi", TURN),
    ("φ", TURN),
    ("theta", TURN),
    ("θ", TURN),
    ("angle", TURN),
    ("psi", TURN),
    ("rz", TURN),
];

/// What stands for a rate or an acceleration, before or after an axis or for itself.
const LEVELS: [(&str, usize); 16] = [
    ("d", 1),
    ("dd", 2),
    ("p", 1),
    ("pp", 2),
    ("'", 1),
    ("''", 2),
    ("dot", 1),
    ("ddot", 2),
    ("dotdot", 2),
    ("v", 1),
    ("a", 2),
    ("vel", 1),
    ("velocity", 1),
    ("acc", 2),
    ("acceleration", 2),
    ("rate", 1),
];

/// What stands for the rate or the acceleration of an angle.
const TURNING: [(&str, Component); 4] = [
    ("omega", (TURN, 1)),
    ("ω", (TURN, 1)),
    ("alpha", (TURN, 2)),
    ("α", (TURN, 2)),
];

fn found<T: Copy>(list: &[(&str, T)], part: &str) -> Option<T> {
    list.iter().find(|it| it.0 == part).map(|it| it.1)
}

/// `x`, `xd`, `vx`, `phi_dd` without its separators, `omega`.
fn component(part: &str) -> Option<Component> {
    if let Some(axis) = found(&AXES, part) {
        return Some((axis, 0));
    }
    if let Some(turning) = found(&TURNING, part) {
        return Some(turning);
    }
    AXES.iter().find_map(|(name, axis)| {
        let after = part.strip_prefix(name).and_then(|it| found(&LEVELS, it));
        let before = || part.strip_suffix(name).and_then(|it| found(&LEVELS, it));
        Some((*axis, after.or_else(before)?))
    })
}

/// What a name that is none of the observables' probably means.
pub fn guess(system: &System, all: &[Named], name: &str) -> Option<Guess> {
    let folded = name.to_lowercase();
    let mut alike = (0..all.len()).filter(|&place| all[place].name.to_lowercase() == folded);
    if let (Some(place), None) = (alike.next(), alike.next()) {
        let doubt = String::new();
        return Some(Guess { place, doubt });
    }
    let place = |wanted: Observable| all.iter().position(|it| it.observable == wanted);
    // A coordinate, and a word for its rate.
    let coordinates = system.coordinates.iter().enumerate();
    let mut rates = coordinates.filter_map(|(own, it)| {
        let rest = folded.strip_prefix(&it.name.to_lowercase())?;
        let level = found(&LEVELS, rest.trim_start_matches(['_', ' ', '.']))?;
        place(Observable::Coordinate { place: own, level })
    });
    if let (Some(place), None) = (rates.next(), rates.next()) {
        let doubt = String::new();
        return Some(Guess { place, doubt });
    }
    let is_inside = |it: char| it.is_alphanumeric() || it == '\'';
    let parts: Vec<&str> = name
        .split(|it| !is_inside(it))
        .filter(|it| !it.is_empty())
        .collect();
    let mechanism = &system.mechanism;
    let mut guesses: Vec<Guess> = Vec::new();
    for (own, part) in parts.iter().enumerate() {
        let Some((axis, mut level)) = component(&part.to_lowercase()) else {
            continue;
        };
        let mut object: Vec<&str> = parts.clone();
        object.remove(own);
        // `x_K_dd` has its level elsewhere.
        if let (0, true, Some(further)) = (
            level,
            object.len() > 1,
            object
                .last()
                .and_then(|it| found(&LEVELS, &it.to_lowercase())),
        ) {
            level = further;
            object.pop();
        }
        let object = object.join("_");
        let body = mechanism
            .bodies
            .iter()
            .find(|it| it.name == object)
            .and_then(|it| it.coordinates[axis]);
        let point = system.outputs.iter().position(|it| it.name == object);
        if let Some(coordinate) = body {
            let wanted = Observable::Coordinate {
                place: coordinate.place,
                level,
            };
            let doubt = String::new();
            guesses.extend(place(wanted).map(|place| Guess { place, doubt }));
        }
        match (point, axis) {
            (None, _) => {}
            (Some(point), TURN) => {
                let carries = |it: &&Body| it.marks.iter().any(|mark| mark.name == object);
                let carriers: Vec<(usize, &str)> = mechanism
                    .bodies
                    .iter()
                    .filter(carries)
                    .filter_map(|it| Some((it.coordinates[TURN]?.place, it.name.as_str())))
                    .collect();
                let _ = point;
                let Some(&(place_of_angle, name)) = carriers.first() else {
                    continue;
                };
                let names: Vec<&str> = carriers.iter().map(|it| it.1).collect();
                let doubt = match names.as_slice() {
                    [_] => String::new(),
                    names => format!("{object} is on {}; `{name}` is the first", names.join(", ")),
                };
                let wanted = Observable::Coordinate {
                    place: place_of_angle,
                    level,
                };
                guesses.extend(place(wanted).map(|place| Guess { place, doubt }));
            }
            (Some(point), axis) => {
                let wanted = Observable::Point {
                    place: point,
                    axis,
                    level,
                };
                let doubt = String::new();
                guesses.extend(place(wanted).map(|place| Guess { place, doubt }));
            }
        }
    }
    // Two meanings are none.
    match guesses.len() {
        1 => guesses.pop(),
        _ => None,
    }
}
