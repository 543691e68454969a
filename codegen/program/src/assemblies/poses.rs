//! Finds all poses of a block without a closed form, and the undecided ranges.
//!
//! Every pose is among the poses found or in an undecided range; each pose found is isolated.

use std::f64::consts::TAU;

use linkwright_math::double;

use super::boxes::isolate_common;
use super::interval::Interval;
use super::isolation::isolate;
use super::sought::Sought;
use crate::expr::SymbolId;
use crate::joint::Quantity;
use crate::pool::Pool;
use crate::program::NewtonBlock;
use crate::system::System;

/// Start of the range of an angle, in rad. It differs from zero and half a turn, the likely angles of drawn links.
const BEGINNING: f64 = -3.0;

/// Largest difference at which angles at both ends of their range are one direction, in rad.
const SAME_DIRECTION: f64 = 1e-8;

/// Smallest difference that orders poses, in rad or m; smaller ones may be rounding.
const SAME_VALUE: f64 = 1e-8;

/// Number of earlier parts that are searched for one that touches.
const LOOKED_BACK: usize = 256;

/// Largest size of a merged part, relative to its pieces.
const LOOSE: f64 = 1.5;

/// Side below which touching parts are merged in any case, in rad: such parts are not resolved.
const TINY: f64 = 1e-4;

/// Distance below which undecided parts are merged, in rad.
const MERGED: f64 = 1e-6;

/// Range of each angle that is searched.
pub type Part = Vec<[f64; 2]>;

/// All poses of a block.
#[derive(Clone, Debug)]
pub struct Poses {
    /// Poses, ascending in the searched unknowns.
    pub found: Vec<Pose>,
    /// Searched unknowns of the block: indices from 0.
    pub sought: Vec<usize>,
    /// Parts that may have poses.
    pub undecided: Vec<Part>,
    /// Fraction of the search range that is decided, at most 1.
    pub decided: f64,
}

/// Pose of a block.
#[derive(Clone, Debug, PartialEq)]
pub struct Pose {
    /// Values of its unknowns. Angles are within half a turn; searched angles are in the turn that begins at −3.
    pub unknowns: Vec<f64>,
}

/// Finds the poses of a block and examines at most `parts` parts. `None` if the poses are not zeros of functions of one or two
/// angles, or if a number that they need is unknown.
pub fn poses(
    newton: &NewtonBlock,
    pool: &Pool,
    system: &System,
    known: &dyn Fn(SymbolId) -> Option<Interval>,
    parts: usize,
) -> Option<Poses> {
    let sought = Sought::of(newton, pool, system, known)?;
    let count = sought.places.len();
    let range = [BEGINNING, (BEGINNING + TAU).next_up()];
    let choices = 1_usize << sought.signs;
    let mut registers = Vec::new();
    let mut zeros_found: Vec<(Vec<f64>, usize)> = Vec::new();
    let mut undecided: Vec<Part> = Vec::new();
    for choice in 0..choices {
        let mut left = parts / choices;
        if count == 1 {
            let zeros = isolate(range, &mut left, |cell| {
                let values = sought.remaining(&[cell], choice, &mut registers);
                [values[0], values[1]]
            });
            zeros_found.extend(zeros.found.into_iter().map(|zero| (vec![zero], choice)));
            undecided.extend(zeros.undecided.into_iter().map(|it| vec![it]));
        } else {
            let zeros = isolate_common([range, range], &mut left, |part| {
                let values = sought.remaining(&part, choice, &mut registers);
                let [a, b, c, d, e, f] = [0, 1, 2, 3, 4, 5].map(|place| values[place]);
                ([a, b], [[c, d], [e, f]])
            });
            zeros_found.extend(zeros.found.into_iter().map(|it| (it.to_vec(), choice)));
            undecided.extend(zeros.undecided.into_iter().map(|it| it.to_vec()));
        }
    }
    let whole = choices as f64 * TAU.powi(i32::try_from(count).unwrap_or(1));
    let decided = 1.0 - undecided.iter().map(size).sum::<f64>() / whole;
    without_doubles(&mut zeros_found);
    let mut poses: Vec<Pose> = Vec::new();
    for (at, choice) in zeros_found {
        match pose(newton, system, &sought, &at, choice) {
            Some(pose) => poses.push(pose),
            None => undecided.push(at.iter().map(|&value| [value, value]).collect()),
        }
    }
    let is_angle = |place: usize| {
        let unknown = newton.unknowns[place];
        system.vector_form.unknowns[unknown].quantity == Quantity::Angle
    };
    poses.sort_by_cached_key(|pose| order(&pose.unknowns, is_angle, &sought.places));
    Some(Poses {
        found: poses,
        sought: sought.places,
        undecided: merged(undecided),
        decided: decided.clamp(0.0, 1.0),
    })
}

/// Returns the sort key of a pose: the searched unknowns, then all others, with angles in one turn and without rounding.
pub fn order(unknowns: &[f64], is_angle: impl Fn(usize) -> bool, sought: &[usize]) -> Vec<i64> {
    let all = sought.iter().copied().chain(0..unknowns.len());
    let values = all.map(|place| match is_angle(place) {
        true => unknowns[place] - TAU * ((unknowns[place] - BEGINNING) / TAU).floor(),
        false => unknowns[place],
    });
    values
        .map(|value| (value / SAME_VALUE).round() as i64)
        .collect()
}

fn ascending(one: &[f64], other: &[f64]) -> std::cmp::Ordering {
    let mut pairs = one.iter().zip(other);
    let differs = pairs.find_map(|(a, b)| Some(a.total_cmp(b)).filter(|it| it.is_ne()));
    differs.unwrap_or(std::cmp::Ordering::Equal)
}

/// Removes poses that occur at both ends of the range. Adjacent poses stay separate, however close, as each is isolated.
fn without_doubles(found: &mut Vec<(Vec<f64>, usize)>) {
    let is_again = |one: &(Vec<f64>, usize), other: &(Vec<f64>, usize)| {
        let mut pairs = one.0.iter().zip(&other.0);
        let is_turned = pairs.clone().any(|(a, b)| (a - b).abs() > 1.0);
        one.1 == other.1
            && is_turned
            && pairs.all(|(a, b)| {
                let off = a - b;
                (off - TAU * (off / TAU).round()).abs() < SAME_DIRECTION
            })
    };
    let mut at = 0;
    while at < found.len() {
        match found[..at]
            .iter()
            .any(|before| is_again(before, &found[at]))
        {
            true => {
                found.remove(at);
            }
            false => at += 1,
        }
    }
}

/// Returns the unknowns of a block for given searched values; `None` if a closed form has no solution there.
fn pose(
    newton: &NewtonBlock,
    system: &System,
    sought: &Sought,
    at: &[f64],
    choice: usize,
) -> Option<Pose> {
    let values = sought.whole(at, choice);
    let (cosines, sines) = values.split_at_checked(newton.unknowns.len())?;
    let mut unknowns = Vec::with_capacity(cosines.len());
    for (place, (cosine, sine)) in cosines.iter().zip(sines).enumerate() {
        let quantity = system.vector_form.unknowns[newton.unknowns[place]].quantity;
        let position = sought.places.iter().position(|&it| it == place);
        unknowns.push(match position {
            Some(position) => at[position],
            None if quantity == Quantity::Angle => double::atan2(sine.middle(), cosine.middle()),
            None => cosine.middle(),
        });
    }
    let finite = unknowns.iter().all(|value| value.is_finite());
    finite.then_some(Pose { unknowns })
}

/// Merges touching parts if the result is hardly larger, ascending.
fn merged(parts: Vec<Part>) -> Vec<Part> {
    let touch = |one: &Part, other: &Part| {
        let mut sides = one.iter().zip(other);
        sides.all(|(a, b)| a[0] <= b[1] + MERGED && b[0] <= a[1] + MERGED)
    };
    let hull = |one: &Part, other: &Part| -> Part {
        let sides = one.iter().zip(other);
        sides
            .map(|(a, b)| [a[0].min(b[0]), a[1].max(b[1])])
            .collect()
    };
    let lows = |part: &Part| part.iter().map(|it| it[0]).collect::<Vec<f64>>();
    // Each part with the size of its pieces.
    let parts = parts.into_iter().map(|part| (size(&part), part));
    let mut parts: Vec<(f64, Part)> = parts.collect();
    // A merged part may touch an earlier one, so merging repeats.
    loop {
        parts.sort_by(|(_, one), (_, other)| ascending(&lows(one), &lows(other)));
        let before = parts.len();
        let mut whole: Vec<(f64, Part)> = Vec::new();
        for (filled, part) in parts {
            let mut near = whole.iter_mut().rev().take(LOOKED_BACK);
            let partner = near.find(|(own_filled, own)| {
                let both = hull(own, &part);
                let is_tiny = both.iter().all(|it| it[1] - it[0] <= TINY);
                touch(own, &part) && (is_tiny || size(&both) <= LOOSE * (*own_filled + filled))
            });
            match partner {
                Some((own_filled, own)) => {
                    *own_filled += filled;
                    *own = hull(own, &part);
                }
                None => whole.push((filled, part)),
            }
        }
        if whole.len() == before {
            return whole.into_iter().map(|(_, part)| part).collect();
        }
        parts = whole;
    }
}

fn size(part: &Part) -> f64 {
    part.iter().map(|[low, high]| high - low).product()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_lies_at_both_ends_is_one() {
        let [low, high] = [BEGINNING, BEGINNING + TAU];
        let mut poses = vec![(vec![low], 0), (vec![high], 0), (vec![high], 1)];
        without_doubles(&mut poses);
        assert_eq!(poses, [(vec![low], 0), (vec![high], 1)]);
        let near = vec![(vec![0.5], 0), (vec![0.5 + 5e-9], 0)];
        let mut poses = near.clone();
        without_doubles(&mut poses);
        assert_eq!(poses, near);
    }
}
