//! Follows a mechanism over times, and finds the end of its motion.
//!
//! The shell of the mechanism moves it from time to time and stays on its path. Instants are not kept: the caller sees each once.

use linkwright::{Failure, Shell};

use crate::instant::Instant;
use crate::schedule::{Leg, Visit};
use crate::supplied::{InputLaws, InputSignals};
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

/// Mechanism that can be moved from its last instant to another time.
pub trait Movable {
    /// Last instant.
    fn instant(&self) -> &Instant;

    /// Moves the mechanism to the time `t` (s) with these inputs.
    ///
    /// # Errors
    /// The motion ends before that time; the last instant stays.
    fn move_to(&mut self, t: f64, inputs: &InputSignals) -> Result<(), Failure>;
}

impl<V: View> Movable for Shell<V> {
    fn instant(&self) -> &Instant {
        self.frame()
    }

    fn move_to(&mut self, t: f64, inputs: &InputSignals) -> Result<(), Failure> {
        self.advance(t, inputs).map(|_| ())
    }
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
pub fn follow<M: Movable, E>(
    moved: &mut M,
    laws: &InputLaws,
    leg: &Leg,
    mut see: impl FnMut(&M, bool) -> Result<(), E>,
) -> Result<Option<Box<End>>, E> {
    for Visit { t, wanted } in leg.visits() {
        match moved.move_to(t, &laws.at(t)) {
            Ok(()) => see(moved, wanted)?,
            Err(failure) => {
                let last = last_before(moved, laws, failure.time);
                return Ok(Some(Box::new(End { failure, last })));
            }
        }
    }
    Ok(None)
}

/// Returns the last instant before a time that cannot be reached, by bisection.
fn last_before(moved: &mut impl Movable, laws: &InputLaws, mut beyond: f64) -> Instant {
    loop {
        let t = moved.instant().t();
        let middle = t + 0.5 * (beyond - t);
        if (beyond - t).abs() <= END_PRECISION * beyond.abs().max(1.0)
            || middle == t
            || middle == beyond
        {
            return moved.instant().clone();
        }
        if moved.move_to(middle, &laws.at(middle)).is_err() {
            beyond = middle;
        }
    }
}
