//! *A block without a closed form, and what is known before it* → *all of its poses, and what is not decided*.
//!
//! No pose is anywhere but among those that are found and in the parts that stay undecided; each that is found is one alone.

use std::f64::consts::TAU;

use linkwright_math::double;

use super::boxes::isolate_common;
use super::interval::Interval;
use super::isolation::isolate;
use super::sought::Sought;
use crate::expr::SymbolId;
use crate::joint::Quantity;
use crate::program::NewtonBlock;
use crate::system::System;

/// Where the range of an angle begins: not at zero or half a turn, where a person would draw a link.
const BEGINNING: f64 = -3.0;

/// How near to the same direction two angles at both ends of their range are one.
const SAME_DIRECTION: f64 = 1e-8;

/// Angles and lengths that differ by less do not order poses, in rad or m: they may differ by rounding alone.
const SAME_VALUE: f64 = 1e-8;

/// How many parts are looked at for one that touches.
const LOOKED_BACK: usize = 256;

/// How much larger a part may be than those that it is made of.
const LOOSE: f64 = 1.5;

/// The side of a part that is made of any that touch, in rad: nobody looks into it.
const TINY: f64 = 1e-4;

/// Parts that stay undecided and are nearer to one another than this are one, in rad.
const MERGED: f64 = 1e-6;

/// A range of each angle that was sought.
pub type Part = Vec<[f64; 2]>;

/// All poses of a block.
#[derive(Clone, Debug)]
pub struct Poses {
    /// Ascending in what was sought.
    pub found: Vec<Pose>,
    /// Which of the block's unknowns were sought, from 0.
    pub sought: Vec<usize>,
    /// Where it is not known whether there are poses.
    pub undecided: Vec<Part>,
    /// Which part of all that could be is decided, at most 1.
    pub decided: f64,
}

/// One pose of a block.
#[derive(Clone, Debug, PartialEq)]
pub struct Pose {
    /// The values of its unknowns; an angle within half a turn, or what was sought in the turn that begins at −3.
    pub unknowns: Vec<f64>,
}

/// The poses of a block, where at most so many parts are looked at. `None` where they are not the zeros of functions of one or two
/// angles, or not all numbers that they need are known.
pub fn poses(
    newton: &NewtonBlock,
    system: &System,
    known: &dyn Fn(SymbolId) -> Option<Interval>,
    parts: usize,
) -> Option<Poses> {
    let sought = Sought::of(newton, system, known)?;
    let count = sought.places.len();
    let range = [BEGINNING, (BEGINNING + TAU).next_up()];
    let choices = 1_usize << sought.signs;
    let mut registers = Vec::new();
    let mut found: Vec<(Vec<f64>, usize)> = Vec::new();
    let mut undecided: Vec<Part> = Vec::new();
    for choice in 0..choices {
        let mut left = parts / choices;
        if count == 1 {
            let zeros = isolate(range, &mut left, |cell| {
                let values = sought.remaining(&[cell], choice, &mut registers);
                [values[0], values[1]]
            });
            found.extend(zeros.found.into_iter().map(|zero| (vec![zero], choice)));
            undecided.extend(zeros.undecided.into_iter().map(|it| vec![it]));
        } else {
            let zeros = isolate_common([range, range], &mut left, |part| {
                let values = sought.remaining(&part, choice, &mut registers);
                let [a, b, c, d, e, f] = [0, 1, 2, 3, 4, 5].map(|place| values[place]);
                ([a, b], [[c, d], [e, f]])
            });
            found.extend(zeros.found.into_iter().map(|it| (it.to_vec(), choice)));
            undecided.extend(zeros.undecided.into_iter().map(|it| it.to_vec()));
        }
    }
    let whole = choices as f64 * TAU.powi(i32::try_from(count).unwrap_or(1));
    let decided = 1.0 - undecided.iter().map(size).sum::<f64>() / whole;
    without_doubles(&mut found);
    let mut poses: Vec<Pose> = Vec::new();
    for (at, choice) in found {
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

/// What poses of a block ascend in: what was sought, and then everything else, angles in one turn and without rounding.
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

/// What lies at both ends of the range is one. Poses beside one another stay two, however near they are: each is one alone.
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

/// The unknowns of a block where what is sought is found; `None` where closed forms do not reach to it.
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
        let own = sought.places.iter().position(|&it| it == place);
        unknowns.push(match own {
            Some(own) => at[own],
            None if quantity == Quantity::Angle => double::atan2(sine.middle(), cosine.middle()),
            None => cosine.middle(),
        });
    }
    let finite = unknowns.iter().all(|value| value.is_finite());
    finite.then_some(Pose { unknowns })
}

/// Parts that touch as one where that is hardly larger, ascending.
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
    // Each with the size of what it is made of.
    let parts = parts.into_iter().map(|part| (size(&part), part));
    let mut parts: Vec<(f64, Part)> = parts.collect();
    // Until nothing touches any more: a merged part may touch one that came before.
    loop {
        parts.sort_by(|(_, one), (_, other)| ascending(&lows(one), &lows(other)));
        let before = parts.len();
        let mut whole: Vec<(f64, Part)> = Vec::new();
        for (filled, part) in parts {
            let mut near = whole.iter_mut().rev().take(LOOKED_BACK);
            let own = near.find(|(own_filled, own)| {
                let both = hull(own, &part);
                let is_tiny = both.iter().all(|it| it[1] - it[0] <= TINY);
                touch(own, &part) && (is_tiny || size(&both) <= LOOSE * (*own_filled + filled))
            });
            match own {
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
        let mut found = vec![(vec![low], 0), (vec![high], 0), (vec![high], 1)];
        without_doubles(&mut found);
        assert_eq!(found, [(vec![low], 0), (vec![high], 1)]);
        let near = vec![(vec![0.5], 0), (vec![0.5 + 5e-9], 0)];
        let mut found = near.clone();
        without_doubles(&mut found);
        assert_eq!(found, near);
    }
}
