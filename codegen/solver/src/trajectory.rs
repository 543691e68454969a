//! *A mechanism and times* → *its instants one after another, or how far the motion goes*.
//!
//! The mechanism is moved from time to time by its shell, which stays on its path. Nothing is kept: whoever follows sees every
//! instant once. The module does not know what is done with them.

use linkwright::{Failure, Shell};

use crate::instant::Instant;
use crate::schedule::{Leg, Visit};
use crate::supplied::InputLaws;
use crate::view::View;

/// How closely the end of a motion is found, beside the larger of the time and one second.
pub const END: f64 = 1e-12;

/// The end of a motion.
#[derive(Clone, Debug)]
pub struct End {
    /// Why it ends.
    pub failure: Failure,
    /// The last instant that could be solved, next to the end, at which the mechanism then is.
    pub last: Instant,
}

/// Moves a mechanism to one time after another; `see` is shown it at every instant, and whether the instant is wanted. Gives how the motion ends where
/// it does not go as far as the times do.
///
/// # Errors
/// Those of `see`, which end it.
pub fn follow<V: View, E>(
    shell: &mut Shell<V>,
    laws: &InputLaws,
    leg: &Leg,
    mut see: impl FnMut(&Shell<V>, bool) -> Result<(), E>,
) -> Result<Option<Box<End>>, E> {
    for Visit { t, wanted } in leg.visits() {
        match shell.advance(t, &laws.at(t)) {
            Ok(_) => see(shell, wanted)?,
            Err(failure) => {
                let last = last_before(shell, laws, failure.time);
                return Ok(Some(Box::new(End { failure, last })));
            }
        }
    }
    Ok(None)
}

/// The last instant before a time that cannot be reached, by bisection.
fn last_before<V: View>(shell: &mut Shell<V>, laws: &InputLaws, mut beyond: f64) -> Instant {
    loop {
        let t = shell.frame().t();
        let middle = t + 0.5 * (beyond - t);
        if (beyond - t).abs() <= END * beyond.abs().max(1.0) || middle == t || middle == beyond {
            return shell.frame().clone();
        }
        if shell.advance(middle, &laws.at(middle)).is_err() {
            beyond = middle;
        }
    }
}
