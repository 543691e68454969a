//! Rewrites a description in all equivalent forms, each with its effect on the coordinates.

use std::f64::consts::TAU;

use linkwright_codegen::diagnostic::{Diagnostics, Source};
use linkwright_codegen::stages::syntax::{Equation, parse};
use linkwright_codegen::stages::system::{Derived, Described};

use super::lengths::{FACTORS, scaled, shifted, turned};
use super::naming::renamed;
use super::order::reordered;
use super::swapping::swapped;
use crate::random::cases;

/// Seed of the first permutation; the seeds of the others follow it.
pub const SEED: u64 = 0x6d65_7461;

/// Shifts of the origin, as text and in m.
const SHIFTS: [([&str; 2], [f64; 2]); 2] = [
    (["5/4", "-17/8"], [1.25, -2.125]),
    (["-40000", "30000"], [-4e4, 3e4]),
];

/// Effect of a rewriting on the coordinates.
#[derive(Clone, Copy, Debug)]
pub enum Change {
    /// Nothing.
    None,
    /// Lengths become larger by this factor.
    Factor(f64),
    /// Shifts positions by these lengths (m).
    Shift([f64; 2]),
    /// Turns everything by atan2(4, 3).
    Turn,
}

/// Equivalent description.
#[derive(Clone, Debug)]
pub struct Rewriting {
    /// Name of the rewriting.
    pub name: String,
    /// The description.
    pub source: Source,
    /// Effect on the coordinates.
    pub change: Change,
    /// True if coordinates are matched by name because their order differs; they are matched by index otherwise.
    pub by_name: bool,
}

/// Rewritings of a description whose equations are `motions`, and the reasons why others are left out.
///
/// # Panics
/// If the description has errors.
pub fn all(source: &Source, motions: &[Derived]) -> (Vec<Rewriting>, Vec<String>) {
    let document = parse(source, &mut Diagnostics::new()).expect("a description without errors");
    let text = source.text.as_str();
    let rewritten = |name: String, text: String, change, by_name| Rewriting {
        name,
        source: Source {
            text,
            ..source.clone()
        },
        change,
        by_name,
    };
    let power = |equation: &Equation| power(equation, motions);
    let mut all = Vec::new();
    for factor in FACTORS {
        let name = format!("lengths times {:e}", factor.value);
        let text = scaled(text, &document, factor, &power);
        all.push(rewritten(name, text, Change::Factor(factor.value), false));
    }
    for ([x, y], shift) in SHIFTS {
        let name = format!("the origin at ({x}, {y})");
        let text = shifted(text, &document, x, y);
        all.push(rewritten(name, text, Change::Shift(shift), false));
    }
    let mut left_out = Vec::new();
    match turned(text, &document) {
        Some(text) => all.push(rewritten("turned".to_string(), text, Change::Turn, false)),
        None => left_out.push("turning: it speaks of the directions x and y".to_string()),
    }
    let other = renamed(text, &document, SEED);
    all.push(rewritten("renamed".to_string(), other, Change::None, false));
    for seed in SEED..SEED + cases(1) {
        let text = reordered(text, &document, seed);
        all.push(rewritten(
            format!("order {seed:#x}"),
            text,
            Change::None,
            true,
        ));
    }
    let swapped = swapped(text, &document);
    if swapped == text {
        left_out.push("swapping: no joint says the same of j and i as of i and j".to_string());
    } else {
        all.push(rewritten(
            "swapped".to_string(),
            swapped,
            Change::None,
            false,
        ));
    }
    (all, left_out)
}

/// Power of length in the dimension of an equation.
fn power(equation: &Equation, motions: &[Derived]) -> i32 {
    let rows = motions.iter().flat_map(|derived| {
        let is_of_equation = |row: &&linkwright_codegen::stages::system::Row| {
            derived.system.mechanism.joints[row.joint].span == equation.span
        };
        derived
            .system
            .rows
            .iter()
            .chain(&derived.system.monitored)
            .filter(is_of_equation)
    });
    let powers: Vec<i32> = rows.map(|row| row.quantity.power_of_length()).collect();
    *powers.first().expect("the row of an equation")
}

impl Change {
    /// Values of the `level`th derivative of the coordinates of `system` after the change.
    pub fn apply(&self, derived: &Derived, values: &[f64], level: usize) -> Vec<f64> {
        let mut changed = values.to_vec();
        for (place, coordinate) in derived.system.coordinates.iter().enumerate() {
            let Described::Pose { axis, .. } = coordinate.describes else {
                continue;
            };
            let at_rest = f64::from(u8::from(level == 0));
            changed[place] = match (self, axis) {
                (Change::Factor(factor), 0 | 1) => factor * values[place],
                (Change::Shift(shift), 0 | 1) => values[place] + at_rest * shift[axis],
                (Change::Turn, 0) => 0.6 * values[place] - 0.8 * values[place + 1],
                (Change::Turn, 1) => 0.8 * values[place - 1] + 0.6 * values[place],
                (Change::Turn, _) => values[place] + at_rest * 4_f64.atan2(3.0),
                _ => values[place],
            };
        }
        changed
    }

    /// True if angles may change by whole turns: a direction in the picture has an angle of at most half a turn, so
    /// that a turned one may be wound by a whole turn.
    pub fn winds(&self) -> bool {
        matches!(self, Change::Turn)
    }

    /// Bound on the error of the coordinate at `place` after the change, if all errors were within `bounds` before.
    pub fn bound(&self, derived: &Derived, bounds: &[f64], place: usize) -> f64 {
        let coordinate = &derived.system.coordinates[place];
        match (self, coordinate.describes) {
            (Change::Factor(factor), Described::Pose { axis: 0 | 1, .. }) => factor * bounds[place],
            (Change::Turn, Described::Pose { axis: 0, .. }) => bounds[place] + bounds[place + 1],
            (Change::Turn, Described::Pose { axis: 1, .. }) => bounds[place] + bounds[place - 1],
            _ => bounds[place],
        }
    }
}

/// Distance between two values of the coordinate at `place`; whole turns of bodies do not count if they may be wound.
pub fn distance(derived: &Derived, place: usize, [one, other]: [f64; 2], wound: bool) -> f64 {
    let difference = one - other;
    match derived.system.coordinates[place].describes {
        Described::Pose { axis: 2, .. } if wound => {
            (difference - TAU * (difference / TAU).round()).abs()
        }
        _ => difference.abs(),
    }
}

/// Index in the rewritten system of each coordinate of the original.
///
/// # Panics
/// If one is missing.
pub fn places(rewriting: &Rewriting, before: &Derived, after: &Derived) -> Vec<usize> {
    assert_eq!(
        before.system.coordinates.len(),
        after.system.coordinates.len()
    );
    if !rewriting.by_name {
        return (0..before.system.coordinates.len()).collect();
    }
    let place = |name: &str| {
        after
            .system
            .coordinates
            .iter()
            .position(|it| it.name == name)
    };
    before
        .system
        .coordinates
        .iter()
        .map(|it| place(&it.name).unwrap_or_else(|| panic!("no coordinate {}", it.name)))
        .collect()
}
