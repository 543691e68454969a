//! Divides a motion that may be too long for one step, within a budget of attempts.
//!
//! [`in_steps`] first tries the whole motion. If an attempt fails, it tries half the distance from the last time that
//! was reached. After two successes in a row it doubles the step again. It therefore halves the distance to a time
//! beyond which motion is impossible until the budget is used up. The time that it reports is as exact as the budget
//! allows: about two attempts per bit. If links do not reach, the missing distance grows smoothly with time: two
//! attempts predict its zero, and a few more locate it to rounding.
//!
//! [`crate::Frame::follow`] follows a single system of equations. A closure moves a mechanism of several blocks as a whole,
//! because each block has its equations at one time only.

use crate::failure::{Failure, FailureKind};
use crate::math::Real;

/// Part of the whole distance below which a step is so short that a failure of its attempt lies on the path.
pub const REFINED: f64 = 1.0 / 256.0;

/// Motion that could not be completed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Broken<T = f64> {
    /// Last time that was reached.
    pub reached: T,
    /// Reason for the end of the motion. Its time is the earliest one that was tried in vain after `reached`, or
    /// `reached` itself if the budget ended without an obstacle.
    pub failure: Failure<T>,
}

/// Moves from the time `from` to the time `to` in as many steps as needed, at most `budget` attempts; returns the
/// number of attempts.
///
/// `attempt` moves to the given time from the last time for which it returned `Ok`, at first from `from`. If it fails,
/// it must leave its state unchanged.
///
/// # Errors
/// Returns the failure of the attempt nearest to the last time reached, if shorter steps would not help:
/// [`FailureKind::OutOfReach`], by the distance that is missing at `to` if the same block does not reach there either.
/// If the step is at most `REFINED` times the whole distance, also [`FailureKind::Singular`],
/// [`FailureKind::WrongBranch`], [`FailureKind::NotPositive`] and [`FailureKind::NotFinite`]. All others are
/// [`FailureKind::StepTooLarge`].
///
/// # Work
/// At most `budget` attempts, and at least one.
pub fn in_steps<T: Real>(
    from: T,
    to: T,
    budget: u16,
    mut attempt: impl FnMut(T) -> Result<(), Failure<T>>,
) -> Result<u16, Broken<T>> {
    let mut reached = from;
    let mut step = to - from;
    let mut succeeded = false;
    let mut refused: Option<Failure<T>> = None;
    // True if the last attempt was aimed at a time that two others have predicted.
    let mut aimed = false;
    let mut whole: Option<Failure<T>> = None;
    let mut latest = None;
    // Nearest time without a pose.
    let mut beyond: Option<Failure<T>> = None;
    let refined = (to - from).abs() * T::from_f64(REFINED);
    let mut attempts = 0;
    loop {
        let rest = to - reached;
        // Written so that a NaN time is tried, and refused by the attempt.
        let shorter = step.abs() < rest.abs();
        let target = if shorter { reached + step } else { to };
        attempts += 1;
        match attempt(target) {
            Ok(()) if !shorter => return Ok(attempts),
            Ok(()) => {
                reached = target;
                // A failure from farther away may have been passed.
                refused = refused.filter(|failure| {
                    if from < to {
                        target < failure.time
                    } else {
                        failure.time < target
                    }
                });
                match refused {
                    // From nearer, the links reach no farther.
                    Some(failure) if missing(&failure).is_some() => {
                        step = T::HALF * (failure.time - reached);
                    }
                    _ if succeeded => step += step,
                    _ => {}
                }
                (succeeded, aimed) = (true, false);
            }
            Err(failure) => {
                // From farther away, the missing distance may belong to another gap than the next one.
                let is_near = (target - reached).abs() <= refined;
                let aim = refused.filter(|_| is_near);
                let aim = aim.and_then(|farther| end_of_reach(reached, &failure, &farther));
                // Links that reach by less than rounding are collinear.
                let in_line = aimed && matches!(failure.kind, FailureKind::Singular { .. });
                aimed = aim.is_some() || in_line;
                if attempts == 1 {
                    whole = Some(failure);
                }
                (refused, latest) = (Some(failure), Some(failure.block));
                if missing(&failure).is_some()
                    || matches!(failure.kind, FailureKind::Singular { .. })
                    || failure.kind.refuses_number()
                {
                    beyond = Some(failure);
                }
                step = aim.map_or(T::HALF * (target - reached), |aim| aim - reached);
                succeeded = false;
                if in_line {
                    break;
                }
            }
        }
        let next = reached + step;
        let repeated = refused.is_some_and(|failure| failure.time == next) && aimed;
        let distinct = next != reached && next.is_finite() && !repeated;
        if attempts >= budget || !distinct {
            break;
        }
    }
    // If the steps of a block have become as short, and it has no pose farther on, or none shortly beyond, that is the
    // reason.
    let refused = refused.map(|failure| match beyond {
        Some(beyond)
            if failure.kind == FailureKind::StepTooLarge
                && step.abs() <= refined
                && match beyond.kind.refuses_number() {
                    true => (beyond.time - reached).abs() <= refined,
                    false => beyond.block == failure.block,
                } =>
        {
            Failure {
                time: failure.time,
                ..beyond
            }
        }
        _ => failure,
    });
    let failure = match refused {
        Some(failure) => {
            // Written so that a motion of zero or NaN duration counts as refined.
            let coarse = step.abs() > refined && !aimed;
            // The distance missing at the end says more than the zero at the end of reach.
            let ends =
                missing(&failure).is_some() || matches!(failure.kind, FailureKind::Singular { .. });
            let missing = whole
                .filter(|whole| ends && missing(whole).is_some() && whole.block == failure.block);
            Failure {
                kind: missing.map_or(lasting(failure.kind, coarse), |whole| whole.kind),
                ..failure
            }
        }
        // The only obstacle is the budget, which some block has used up.
        None => Failure {
            kind: FailureKind::StepTooLarge,
            time: reached,
            block: latest.unwrap_or(0),
            iterations: 0,
            residual: T::ZERO,
            row: 0,
            input: None,
        },
    };
    Err(Broken { reached, failure })
}

/// Distance by which links do not reach; `None` for another failure.
fn missing<T: Real>(failure: &Failure<T>) -> Option<T> {
    match failure.kind {
        FailureKind::OutOfReach { by } => Some(by),
        _ => None,
    }
}

/// Part of the distance to the predicted end of reach that the next attempt leaves, so that it usually lies on the same
/// side.
const LEFT: f64 = 1.0 / 16.0;

/// Time shortly beyond the end of reach, from two times beyond it, by the secant rule. `None` if the missing distance
/// does not fall towards `reached`.
fn end_of_reach<T: Real>(reached: T, nearer: &Failure<T>, farther: &Failure<T>) -> Option<T> {
    let (near, far) = (missing(nearer)?, missing(farther)?);
    let way = near * (farther.time - nearer.time) / (far - near);
    let aim = nearer.time - way * (T::ONE - T::from_f64(LEFT));
    let between = (aim - reached) * (nearer.time - aim) >= T::ZERO;
    (near < far && between && aim != reached).then_some(aim)
}

/// Kind of a failure that no shorter step would have avoided. Links that do not reach have no pose. An iteration from
/// far away that met a singular Jacobian, or another branch, says nothing about the path.
fn lasting<T: Real>(kind: FailureKind<T>, coarse: bool) -> FailureKind<T> {
    match kind {
        FailureKind::OutOfReach { .. } => kind,
        FailureKind::Singular { .. } | FailureKind::WrongBranch if !coarse => kind,
        refused if refused.refuses_number() && !coarse => kind,
        _ => FailureKind::StepTooLarge,
    }
}
