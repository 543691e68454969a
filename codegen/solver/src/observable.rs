//! Lists the measurable quantities of a motion by their names in tables of frames: coordinates, their rates and accelerations, points,
//! requested forces, and measures.
//!
//! Names of other programs are guessed from an object and a component; the caller reports the use of a guess.

use linkwright_codegen::stages::columns::Unit;
use linkwright_codegen::stages::joint::Quantity;
use linkwright_codegen::stages::model::Body;
use linkwright_codegen::stages::pool::Pool;
use linkwright_codegen::stages::system::{Derived, System};

use crate::instant::Instant;
use crate::view::View;

/// Quantity of a motion with a number at every instant, in SI units: m, s, kg, rad.
///
/// ```
/// use linkwright::{Blocks, Settings, Shell};
/// use linkwright_codegen::{Source, read};
/// use linkwright_solver::{Interpreted, Observable, View};
///
/// let text = "
///     mechanism crank {
///         point O = (0, 0);
///         body arm at O { O, A: (2, 0) }
///         revolute O(ground, arm);
///         drive phi(arm) = 3*t;
///         output A;
///     }";
/// let read = read(&Source::new("crank.mech", text)).expect("no errors");
/// let derived = &read.motions[0];
/// // Velocity of A in y, and the angular acceleration of the arm.
/// let quantities = ["A_vy", "phi_arm_dd"].map(|name| Observable::named(derived, name).expect("a quantity"));
///
/// let blocks = Interpreted::new(derived).expect("the equations determine the motion");
/// let (parameters, laws) = (blocks.nominal_parameters(), blocks.input_laws());
/// let (pose, modes) = (blocks.drawn_pose(&parameters), blocks.drawn_branches());
/// let crank = Shell::assemble(blocks, &parameters, &pose, modes, 0.0, &laws.at(0.0), Settings::default())?;
/// assert_eq!(Observable::values(crank.blocks(), &quantities, crank.frame()), [6.0, 0.0]);
/// # Ok::<(), linkwright::Failure>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Observable {
    /// Coordinate (level 0), its rate (1) or its acceleration (2).
    Coordinate {
        /// Index among the coordinates.
        place: usize,
        /// Order of differentiation.
        level: usize,
    },
    /// Component of a point.
    Point {
        /// Index among the outputs.
        place: usize,
        /// 0 for x, 1 for y.
        axis: usize,
        /// 0 for position, 1 for velocity, 2 for acceleration.
        level: usize,
    },
    /// Requested force or measure: index among their columns in tables of frames.
    Reported(usize),
}

/// Observable with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct Named {
    /// Name in tables of frames: `phi2`, `phi2_d`, `K_x`, `K_vx`, `effort_crank`.
    pub name: String,
    /// Quantity.
    pub observable: Observable,
    /// Powers of m, s, kg and rad.
    pub powers: [i32; 4],
    /// Unit in tables of frames.
    pub unit: String,
}

/// Interpretation of a name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Guess {
    /// Index among all observables.
    pub place: usize,
    /// Alternatives in words; empty if there are none.
    pub doubt: String,
}

/// Suffixes of a coordinate, its rate and its acceleration.
const RATES: [&str; 3] = ["", "_d", "_dd"];

/// Suffixes of a point's components, by order of differentiation.
const OF_POINT: [[&str; 2]; 3] = [["x", "y"], ["vx", "vy"], ["ax", "ay"]];

/// Units of the three orders of differentiation, by dimension.
const LENGTHS: [&str; 3] = ["m", "m/s", "m/s²"];
const ANGLES: [&str; 3] = ["rad", "rad/s", "rad/s²"];
const NUMBERS: [&str; 3] = ["", "1/s", "1/s²"];

/// Returns all observables of a system, in the order of tables of frames.
pub fn all(pool: &Pool, system: &System) -> Vec<Named> {
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
                unit: units[level].to_string(),
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
                    unit: LENGTHS[level].to_string(),
                });
            }
        }
    }
    for (place, (name, unit)) in crate::reported::names(pool, system).into_iter().enumerate() {
        let powers = Unit::parse(&unit).map_or([0; 4], |it| it.powers);
        all.push(Named {
            name,
            observable: Observable::Reported(place),
            powers,
            unit,
        });
    }
    all
}

impl Observable {
    /// Returns the quantity of this name in tables of frames: `phi2`, `phi2_d`, `K_x`, `K_vx`, `effort_crank`. `None` if
    /// there is none.
    pub fn named(derived: &Derived, name: &str) -> Option<Observable> {
        let all = all(&derived.pool, &derived.system).into_iter();
        let mut named = all.filter(|it| it.name == name);
        named.next().map(|it| it.observable)
    }

    /// Returns all quantities of a motion with their names, in the order of tables of frames.
    pub fn all(derived: &Derived) -> Vec<(String, Observable)> {
        let all = all(&derived.pool, &derived.system).into_iter();
        all.map(|it| (it.name, it.observable)).collect()
    }

    /// Returns the index of a measure among the mechanism's measurements; `None` for other quantities.
    #[doc(hidden)]
    pub fn measurement(&self, derived: &Derived) -> Option<usize> {
        let Observable::Reported(place) = *self else {
            return None;
        };
        let columns = crate::reported::names(&derived.pool, &derived.system).len();
        // Measures are the last columns.
        place.checked_sub(columns - derived.system.mechanism.measurements.len())
    }

    /// Returns the order of differentiation in time: 0 for positions, 1 for rates, 2 for accelerations, 3 for forces.
    #[doc(hidden)]
    pub fn order(&self, derived: &Derived) -> usize {
        match *self {
            Observable::Coordinate { level, .. } | Observable::Point { level, .. } => level,
            Observable::Reported(_) => {
                let measurements = &derived.system.mechanism.measurements;
                let measurement = self.measurement(derived);
                measurement.map_or(3, |it| measurements[it].order)
            }
        }
    }

    /// True for an angle, whose whole turns are indistinguishable.
    #[doc(hidden)]
    pub fn is_angle(&self, system: &System) -> bool {
        match *self {
            Observable::Coordinate { place, level: 0 } => {
                system.coordinates[place].quantity == Quantity::Angle
            }
            _ => false,
        }
    }

    /// Returns the values of observables at an instant, in SI units; NaN for forces and measures if the equations are singular.
    pub fn values<V: View>(view: &V, observables: &[Observable], instant: &Instant) -> Vec<f64> {
        let has = |is: fn(&Observable) -> bool| observables.iter().any(is);
        let points = match has(|it| matches!(it, Observable::Point { .. })) {
            true => view.points(instant),
            false => Vec::new(),
        };
        let reported = match has(|it| matches!(it, Observable::Reported(_))) {
            true => view.reported(instant).unwrap_or_default(),
            false => Vec::new(),
        };
        let value = |observable: &Observable| match *observable {
            Observable::Coordinate { place, level } => {
                instant.coordinate(place).map(|it| it[level])
            }
            Observable::Point { place, axis, level } => points
                .get(place)
                .map(|it| [it.position, it.velocity, it.acceleration][level][axis]),
            Observable::Reported(place) => reported.get(place).copied(),
        };
        let results = observables.iter().map(value);
        results.map(|it| it.unwrap_or(f64::NAN)).collect()
    }
}

/// Component of a motion: axis and order of differentiation.
type Component = (usize, usize);

/// x (0), y (1) or the angle (2) of a body.
type Axis = usize;

/// Axis of the angle.
const TURN: Axis = 2;

/// Words for x, y and the angle.
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

/// Words for a rate or an acceleration, before or after an axis, or alone.
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

/// Words for the rate or the acceleration of an angle.
const TURNING: [(&str, Component); 4] = [
    ("omega", (TURN, 1)),
    ("ω", (TURN, 1)),
    ("alpha", (TURN, 2)),
    ("α", (TURN, 2)),
];

fn found<T: Copy>(list: &[(&str, T)], part: &str) -> Option<T> {
    list.iter().find(|it| it.0 == part).map(|it| it.1)
}

/// Reads a component: `x`, `xd`, `vx`, `phi_dd` without its separators, `omega`.
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

/// Guesses the observable of a name from another program; `None` without a unique guess.
pub fn guess(system: &System, all: &[Named], name: &str) -> Option<Guess> {
    let folded = name.to_lowercase();
    let mut alike = (0..all.len()).filter(|&place| all[place].name.to_lowercase() == folded);
    if let (Some(place), None) = (alike.next(), alike.next()) {
        let doubt = String::new();
        return Some(Guess { place, doubt });
    }
    let place = |wanted: Observable| all.iter().position(|it| it.observable == wanted);
    // The name may be a coordinate and a word for its rate.
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
        // The level of `x_K_dd` is at the end.
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
            let observable = Observable::Coordinate {
                place: coordinate.place,
                level,
            };
            let doubt = String::new();
            guesses.extend(place(observable).map(|place| Guess { place, doubt }));
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
                let observable = Observable::Coordinate {
                    place: place_of_angle,
                    level,
                };
                guesses.extend(place(observable).map(|place| Guess { place, doubt }));
            }
            (Some(point), axis) => {
                let observable = Observable::Point {
                    place: point,
                    axis,
                    level,
                };
                let doubt = String::new();
                guesses.extend(place(observable).map(|place| Guess { place, doubt }));
            }
        }
    }
    // A name with two interpretations has none.
    match guesses.len() {
        1 => guesses.pop(),
        _ => None,
    }
}
