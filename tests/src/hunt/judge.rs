//! Judges the answer of a call at an instant by what the call promises.

use std::f64::consts::{PI, TAU};

use super::known::{Instant, Known, elsewhere};
use super::ways::{Answered, Call};
use crate::stability::precise::Precise;
use crate::stability::verdict::Scalar;

/// Bound on a zero quantity in 384 bits, relative to the other quantities.
const NOISE: f64 = 1e-60;

/// Roundings of an elimination per equation: see [`super::mixing`].
const MIXED: f64 = 3.0;

/// Bound of a coordinate, in its scale, beyond which none of its digits is known.
const NO_DIGITS: f64 = 1e-2;

/// Promise of a call about the pose it returns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Promise {
    /// A pose of the equations.
    Pose,
    /// A pose whose determinant has the sign of the branch.
    Branch,
    /// The pose on the path.
    Path,
    /// The pose on the path, with each angle within half a turn of its last value.
    PathButTurns,
}

/// Promise of a call whose motion has been on the path so far.
pub fn promise(call: Call, known: &Known) -> Promise {
    match call {
        Call::Assemble | Call::AdvanceFine | Call::Advance => Promise::Pose,
        Call::Afar => Promise::Branch,
        Call::Follow | Call::FollowLong => Promise::Path,
        // The branches of closed forms are those of the design configuration: those of the path if both poses
        // coincide.
        Call::SolvedAssemble | Call::SolvedAfar if known.is_drawn_exactly && known.is_closed => {
            Promise::Branch
        }
        Call::SolvedAssemble | Call::SolvedAfar => Promise::Pose,
        Call::SolvedFine | Call::Solved | Call::SolvedLong => Promise::PathButTurns,
    }
}

/// Outcome of an instant.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// On the path, within the bound; the ratio of error to bound.
    Correct {
        /// Largest ratio of error to bound over all coordinates and levels.
        ratio: f64,
    },
    /// Another pose than that on the path, within its bound; the call promises only a pose.
    Other,
    /// Another pose within its bound, after the end of the path.
    Beyond,
    /// A typed failure where the path has a pose: its kind, and whether the bound leaves no digits.
    Failed(String),
    /// A typed failure where the path has ended.
    Ended(String),
    /// Anything else.
    Wrong(String),
}

/// Judges the answers of one scalar, each motion in order.
pub fn judge(known: &Known, answers: &[Answered], scalar: Scalar) -> Vec<Outcome> {
    let mut last: Option<(Call, Followed)> = None;
    let mut outcomes = Vec::new();
    for answered in answers {
        let motion = match last.take() {
            Some((call, motion)) if call == answered.call => motion,
            _ => Followed {
                on_path: true,
                turned: false,
                q: known.task.start.clone(),
            },
        };
        let (outcome, motion) = one(known, answered, scalar, motion);
        outcomes.push(outcome);
        last = Some((answered.call, motion));
    }
    outcomes
}

/// True if the bound of the pose leaves two digits.
fn has_digits(known: &Known, exact: &Instant, scalar: Scalar) -> bool {
    let [bounds, _, _] = &exact.bounds[usize::from(scalar == Scalar::F32)];
    let scales = known.truth.scales(known.size);
    bounds
        .iter()
        .zip(scales)
        .all(|(bound, scale)| bound / scale < NO_DIGITS)
}

/// State of a motion.
struct Followed {
    on_path: bool,
    /// True if an angle is whole turns away from the path.
    turned: bool,
    /// Last pose.
    q: Vec<f64>,
}

fn one(
    known: &Known,
    answered: &Answered,
    scalar: Scalar,
    mut motion: Followed,
) -> (Outcome, Followed) {
    let exact = known.instants.get(answered.instant);
    let compare = |levels, exact| compare(levels, exact, scalar);
    let levels = match (&answered.answer, exact) {
        (Ok(levels), _) => levels,
        (Err(kind), Some(exact)) if has_digits(known, exact, scalar) => {
            return (Outcome::Failed(kind.clone()), motion);
        }
        (Err(kind), Some(_)) => return (Outcome::Failed(format!("{kind}, no digits")), motion),
        (Err(kind), None) => return (Outcome::Ended(kind.clone()), motion),
    };
    let missed = exact.map(|exact| compare(levels, exact));
    if let Some(Ok(ratio)) = missed {
        motion.on_path = true;
        motion.turned = false;
        motion.q.clone_from(&levels[0]);
        return (Outcome::Correct { ratio }, motion);
    }
    // The answer may be another pose.
    let other = elsewhere(known, answered.instant, &levels[0]);
    let why = missed.and_then(Result::err);
    let Some(other) = other else {
        let why = why.unwrap_or_else(|| "a pose where there is none".to_string());
        return (Outcome::Wrong(why), motion);
    };
    if let Err(off) = compare(levels, &other) {
        let why = why.map_or(off.clone(), |why| {
            format!("{why}; from the next pose {off}")
        });
        return (Outcome::Wrong(why), motion);
    }
    let promise = if answered.instant == 0 && answered.call.moves() {
        Promise::Pose
    } else if motion.on_path && exact.is_some() {
        promise(answered.call, known)
    } else {
        Promise::Pose
    };
    let kept = match (promise, exact) {
        (Promise::Pose, _) => Ok(()),
        (Promise::Branch, _) if other.exact.is_negative == known.task.is_negative => Ok(()),
        (Promise::Branch, _) => Err("a pose of the other branch"),
        (Promise::PathButTurns, Some(exact)) => {
            if !is_turned(known, &levels[0], exact) {
                Err("another assembly than that of the path")
            } else if motion.turned || has_far_turn(known, &motion.q, exact) {
                motion.turned = true;
                Ok(())
            } else {
                Err("an angle off by whole turns, although it has moved by less than half a turn")
            }
        }
        _ => Err("another pose than that of the path"),
    };
    motion.on_path = motion.turned && exact.is_some();
    motion.q.clone_from(&levels[0]);
    let outcome = match (kept, exact) {
        (Err(what), _) => Outcome::Wrong(format!("{what}: {}", why.unwrap_or_default())),
        (Ok(()), Some(_)) => Outcome::Other,
        (Ok(()), None) => Outcome::Beyond,
    };
    (outcome, motion)
}

fn is_angle(known: &Known, place: usize) -> bool {
    known.derived.system.coordinates[place]
        .quantity
        .power_of_length()
        == 0
}

/// True if the pose is that on the path except for whole turns.
fn is_turned(known: &Known, q: &[f64], exact: &Instant) -> bool {
    let near = |place: usize| {
        let off = q[place] - exact.exact.levels[0][place].to_f64();
        if is_angle(known, place) {
            (off - (off / TAU).round() * TAU).abs() < 1e-2
        } else {
            off.abs() < 1e-2 * known.size + exact.bounds[1][0][place]
        }
    };
    (0..q.len()).all(near)
}

/// True if an angle has moved by half a turn or more since the last pose.
fn has_far_turn(known: &Known, before: &[f64], exact: &Instant) -> bool {
    (0..before.len()).any(|place| {
        let moved = exact.exact.levels[0][place].to_f64() - before[place];
        is_angle(known, place) && moved.abs() > 0.99 * PI
    })
}

/// Largest ratio of error to bound; an error names a value that exceeds its bound.
fn compare(levels: &[Vec<f64>; 3], exact: &Instant, scalar: Scalar) -> Result<f64, String> {
    let bounds = &exact.bounds[usize::from(scalar == Scalar::F32)];
    let mut ratio = 0.0_f64;
    for (level, found) in levels.iter().enumerate() {
        let expected_level = &exact.exact.levels[level];
        let largest = expected_level
            .iter()
            .map(|it| it.to_f64().abs())
            .fold(0.0, f64::max);
        let roundings = MIXED * found.len() as f64 * scalar.epsilon();
        for (place, found) in found.iter().enumerate() {
            let off = Precise::from_f64(*found).minus(&expected_level[place]);
            let off = off.to_f64().abs();
            let mixed = match level {
                0 => 0.0,
                _ => roundings * exact.mixed[level - 1][place],
            };
            let limit = bounds[level][place].max(mixed).max(NOISE * largest);
            // A comparison with NaN is false, so that NaN is wrong too.
            let within = off <= limit;
            if !within {
                let name = ["q", "q̇", "q̈"][level];
                let expected_level = expected_level[place].to_f64();
                return Err(format!(
                    "{name}[{place}] = {found:e} instead of {expected_level:e}, off by {off:.1e} where {limit:.1e} is allowed"
                ));
            }
            if limit > 0.0 {
                ratio = ratio.max(off / limit);
            }
        }
    }
    Ok(ratio)
}
