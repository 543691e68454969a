//! *A description* → *all its rewritings*, each with what it does to the coordinates.

use std::f64::consts::TAU;

use linkwright_codegen::diagnostic::{Diagnostics, Source};
use linkwright_codegen::stages::syntax::{Equation, parse};
use linkwright_codegen::stages::system::{Derived, Described};

use super::lengths::{FACTORS, scaled, shifted, turned};
use super::naming::renamed;
use super::order::reordered;
use super::swapping::swapped;

/// The seed of the first permutation; the others follow it.
pub const SEED: u64 = 0x6d65_7461;

/// How often bodies and joints are put into another order.
pub const PERMUTATIONS: u64 = 3;

/// How far the origin is moved, as written and in m.
const SHIFTS: [([&str; 2], [f64; 2]); 2] = [
    (["5/4", "-17/8"], [1.25, -2.125]),
    (["-40000", "30000"], [-4e4, 3e4]),
];

/// What a rewriting does to the coordinates.
#[derive(Clone, Copy, Debug)]
pub enum Change {
    /// Nothing.
    None,
    /// Lengths become larger by this factor.
    Factor(f64),
    /// Places are moved by this much (m).
    Shift([f64; 2]),
    /// Everything is turned by atan2(4, 3).
    Turn,
}

/// A description that says the same in another way.
#[derive(Clone, Debug)]
pub struct Rewriting {
    /// What was done.
    pub name: String,
    /// The description.
    pub source: Source,
    /// What this does to the coordinates.
    pub change: Change,
    /// Whether coordinates are found by their names, since they stand in another order; by their places otherwise.
    pub by_name: bool,
}

/// The rewritings of a description whose equations are `motions`, and why others are left out.
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
    for seed in SEED..SEED + PERMUTATIONS {
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

/// The power of the length that an equation is measured in.
fn power(equation: &Equation, motions: &[Derived]) -> i32 {
    let rows = motions.iter().flat_map(|derived| {
        let own = |row: &&linkwright_codegen::stages::system::Row| {
            derived.system.mechanism.joints[row.joint].span == equation.span
        };
        derived
            .system
            .rows
            .iter()
            .chain(&derived.system.monitored)
            .filter(own)
    });
    let powers: Vec<i32> = rows.map(|row| row.quantity.power_of_length()).collect();
    *powers.first().expect("the row of an equation")
}

impl Change {
    /// What becomes of the `level`th derivative of the coordinates of `system`.
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

    /// Whether angles stay the same only but for whole turns: a direction of the drawing has an angle of at most half a turn, so
    /// what is turned may be wound by a whole one.
    pub fn winds(&self) -> bool {
        matches!(self, Change::Turn)
    }

    /// By how much the coordinate at `place` may be off after the change, when all were off by `bounds` before.
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

/// How far two values of the coordinate at `place` are apart; angles of bodies but for whole turns where they may be wound.
pub fn distance(derived: &Derived, place: usize, [one, other]: [f64; 2], wound: bool) -> f64 {
    let difference = one - other;
    match derived.system.coordinates[place].describes {
        Described::Pose { axis: 2, .. } if wound => {
            (difference - TAU * (difference / TAU).round()).abs()
        }
        _ => difference.abs(),
    }
}

/// Which coordinate of the rewritten system each one of the original became.
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
