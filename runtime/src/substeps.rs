//! A motion that may be too long for one step → the same motion in as many steps as it needs, within a budget.
//!
//! [`in_steps`] first tries the whole way. Where an attempt fails, it tries half the way from the last time that was
//! reached; after two successes in a row it doubles the step again. So it halves the distance to a time beyond which there is
//! no motion until the budget is used up, and the time that it reports is as exact as the budget allows: about two attempts
//! per bit. Where links do not reach, what is missing grows smoothly with time: two attempts foresee the time at which it is
//! zero, and a few more find it to rounding.
//!
//! The module does not know what moves. A single system of equations is followed by [`crate::follow`]; a mechanism of
//! several blocks, which know their equations at one time only, is moved as a whole by the closure.

use crate::failure::{Failure, FailureKind};
use crate::math::Real;

/// The part of the whole way below which a step is so short that what its attempt has met lies on the path.
pub const REFINED: f64 = 1.0 / 256.0;

/// A motion that could not be completed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Broken<T = f64> {
    /// The last time that was reached.
    pub reached: T,
    /// Why the motion could not be completed. Its time is the earliest one that was tried in vain after `reached`, or
    /// `reached` itself if the budget ended on a way that was free.
    pub failure: Failure<T>,
}

/// Moves from the time `from` to the time `to` by as many steps as it takes, at most `budget` attempts of them; gives the
/// number of attempts.
///
/// `attempt` moves to the time it is given from the last time for which it returned `Ok`, at first from `from`. Where it
/// fails it must leave what it moves as it was.
///
/// # Errors
/// What the attempt nearest to the last time reached has failed with, if shorter steps would not help:
/// [`FailureKind::OutOfReach`], by what is missing at `to` if the same block does not reach there either, and where the step is at most [`REFINED`] times the whole way also
/// [`FailureKind::Singular`], [`FailureKind::WrongBranch`], [`FailureKind::NotPositive`] and [`FailureKind::NotFinite`]. All others
/// are [`FailureKind::StepTooLarge`].
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
    // Whether the last attempt was aimed at a time that two others have foreseen.
    let mut aimed = false;
    let mut whole: Option<Failure<T>> = None;
    let mut latest = None;
    // The nearest time at which there is no pose.
    let mut beyond: Option<Failure<T>> = None;
    let refined = (to - from).abs() * T::from_f64(REFINED);
    let mut attempts = 0;
    loop {
        let rest = to - reached;
        // Written so that a time that is no number is tried, and refused by the attempt.
        let shorter = step.abs() < rest.abs();
        let target = if shorter { reached + step } else { to };
        attempts += 1;
        match attempt(target) {
            Ok(()) if !shorter => return Ok(attempts),
            Ok(()) => {
                reached = target;
                // What was refused from farther away may have been passed.
                refused = refused.filter(|failure| {
                    if from < to {
                        target < failure.time
                    } else {
                        failure.time < target
                    }
                });
                match refused {
                    // From nearer the links reach no farther.
                    Some(failure) if missing(&failure).is_some() => {
                        step = T::HALF * (failure.time - reached);
                    }
                    _ if succeeded => step += step,
                    _ => {}
                }
                (succeeded, aimed) = (true, false);
            }
            Err(failure) => {
                // From farther away, what is missing may belong to another gap than the next one.
                let is_near = (target - reached).abs() <= refined;
                let aim = refused.filter(|_| is_near);
                let aim = aim.and_then(|farther| end_of_reach(reached, &failure, &farther));
                // Links that reach by less than rounding are in line.
                let in_line = aimed && matches!(failure.kind, FailureKind::Singular { .. });
                aimed = aim.is_some() || in_line;
                if attempts == 1 {
                    whole = Some(failure);
                }
                (refused, latest) = (Some(failure), Some(failure.block));
                if missing(&failure).is_some()
                    || matches!(
                        failure.kind,
                        FailureKind::Singular { .. }
                            | FailureKind::NotPositive { .. }
                            | FailureKind::NotFinite
                            | FailureKind::LoadNotFinite { .. }
                    )
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
    // Where the steps of a block have become as short, and it has no pose farther on, or none has shortly beyond, that is why.
    let refused = refused.map(|failure| match beyond {
        Some(beyond)
            if failure.kind == FailureKind::StepTooLarge
                && step.abs() <= refined
                && match beyond.kind {
                    FailureKind::NotPositive { .. }
                    | FailureKind::NotFinite
                    | FailureKind::LoadNotFinite { .. } => (beyond.time - reached).abs() <= refined,
                    _ => beyond.block == failure.block,
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
            // Written so that a way of no length, or of a length that is no number, counts as refined.
            let coarse = step.abs() > refined && !aimed;
            // How much is missing at the end says more than that nothing is where the reach ends.
            let ends =
                missing(&failure).is_some() || matches!(failure.kind, FailureKind::Singular { .. });
            let missing = whole
                .filter(|whole| ends && missing(whole).is_some() && whole.block == failure.block);
            Failure {
                kind: missing.map_or(lasting(failure.kind, coarse), |whole| whole.kind),
                ..failure
            }
        }
        // Nothing stands in the way but the budget, which some block has used up.
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

/// By how much links do not reach, if that is the failure.
fn missing<T: Real>(failure: &Failure<T>) -> Option<T> {
    match failure.kind {
        FailureKind::OutOfReach { by } => Some(by),
        _ => None,
    }
}

/// The part of the way to the foreseen end of reach that the next attempt leaves, so that it as a rule lies on the same side.
const LEFT: f64 = 1.0 / 16.0;

/// A time shortly beyond that at which links cease to reach, from two times at which they do not, by the rule of the secant.
/// None where what is missing does not fall towards `reached`.
fn end_of_reach<T: Real>(reached: T, nearer: &Failure<T>, farther: &Failure<T>) -> Option<T> {
    let (near, far) = (missing(nearer)?, missing(farther)?);
    let way = near * (farther.time - nearer.time) / (far - near);
    let aim = nearer.time - way * (T::ONE - T::from_f64(LEFT));
    let between = (aim - reached) * (nearer.time - aim) >= T::ZERO;
    (near < far && between && aim != reached).then_some(aim)
}

/// The kind of a failure that no shorter step would have avoided. Where links do not reach there is no pose; but that an
/// iteration from far away has met a singular Jacobian, or another branch, says nothing about the path.
fn lasting<T: Real>(kind: FailureKind<T>, coarse: bool) -> FailureKind<T> {
    match kind {
        FailureKind::OutOfReach { .. } => kind,
        FailureKind::Singular { .. }
        | FailureKind::WrongBranch
        | FailureKind::NotPositive { .. }
        | FailureKind::NotFinite
        | FailureKind::LoadNotFinite { .. }
            if !coarse =>
        {
            kind
        }
        _ => FailureKind::StepTooLarge,
    }
}
