//! Follows a mechanism over times, and finds the end of its motion.
//!
//! The shell of the mechanism moves it from time to time and stays on its path. Instants are not kept: the caller sees each once.

use linkwright::{Failure, Shell};

use crate::instant::Instant;
use crate::schedule::{Leg, Visit};
use crate::supplied::InputLaws;
use crate::view::View;

/// Precision of the end of a motion, relative to the larger of the time and one second.
pub(crate) const END_PRECISION: f64 = 1e-12;

/// End of a motion.
#[derive(Clone, Debug)]
pub struct End {
    /// Reason.
    pub failure: Failure,
    /// Last instant that could be solved, at which the mechanism then is.
    pub last: Instant,
}

/// Moves a mechanism to one time after another.
///
/// `see` receives the mechanism at every instant, and true if the instant is requested. Returns the end of the motion if it is early,
/// otherwise `None`.
///
/// ```
/// use std::convert::Infallible;
///
/// use linkwright::{Blocks, Settings, Shell};
/// use linkwright_codegen::Source;
/// use linkwright_solver::{Interpreted, Schedule, View, follow};
///
/// let text = "
///     mechanism crank {
///         point O = (0, 0);
///         body arm at O { O, A: (2, 0) }
///         revolute O(ground, arm);
///         drive phi(arm) = 3*t;
///     }";
/// let read = linkwright_codegen::read(&Source::new("crank.mech", text)).expect("no errors");
/// let blocks = Interpreted::new(&read.motions[0]).expect("the equations determine the motion");
/// let (parameters, laws) = (blocks.nominal_parameters(), blocks.input_laws());
/// let (pose, modes) = (blocks.drawn_pose(&parameters), blocks.drawn_branches());
/// let (schedule, settings) = (Schedule::range(0.0, 1.0, 0.25).expect("a step"), Settings::default());
/// let mut crank = Shell::assemble(blocks, &parameters, &pose, modes, 0.0, &laws.at(0.0), settings)?;
///
/// let mut angles = Vec::new();
/// let end = follow(&mut crank, &laws, &schedule.forward, |crank, _| {
///     angles.push(crank.frame().q()[2]);
///     Ok::<(), Infallible>(())
/// });
/// assert!(end.is_ok_and(|end| end.is_none()), "the motion is complete");
/// assert_eq!(angles, [0.75, 1.5, 2.25, 3.0]);
/// # Ok::<(), linkwright::Failure>(())
/// ```
///
/// # Errors
/// Errors of `see`, which end the motion.
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

/// Returns the last instant before a time that cannot be reached, by bisection.
fn last_before<V: View>(shell: &mut Shell<V>, laws: &InputLaws, mut beyond: f64) -> Instant {
    loop {
        let t = shell.frame().t();
        let middle = t + 0.5 * (beyond - t);
        if (beyond - t).abs() <= END_PRECISION * beyond.abs().max(1.0)
            || middle == t
            || middle == beyond
        {
            return shell.frame().clone();
        }
        if shell.advance(middle, &laws.at(middle)).is_err() {
            beyond = middle;
        }
    }
}
