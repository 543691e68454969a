//! Advances a mechanism along its path from one frame to another time, in as many steps as needed.
//!
//! A step that fails is halved ([`in_steps`]). At a change point of a block, the path continues straight in the other
//! mode ([`crate::crossing`]). If no time passes, only the inputs change, also in steps.

use crate::block::Start;
use crate::blocks::{Blocks, Conditions, Values};
use crate::failure::{Failure, FailureKind};
use crate::guard::{Guard, Pair};
use crate::math::Real;
use crate::settings::Settings;
use crate::shell::solve;
use crate::signal::Signal;
use crate::substeps::{Broken, in_steps};

/// Maximum number of change points per path.
const CROSSINGS: u8 = 8;

/// Path to a time, with the progress on it.
pub(crate) struct Way<'a, B: Blocks> {
    pub blocks: &'a B,
    pub parameters: &'a B::Parameters,
    pub settings: &'a Settings<B::Scalar>,
    /// Start and end (s).
    pub ends: [B::Scalar; 2],
    /// Signals at both ends.
    pub inputs: [&'a B::Inputs; 2],
    /// Completed part of the inputs' change; `None` on a path with a duration.
    pub changed: Option<B::Scalar>,
    /// Kind of the reached frame.
    pub start: Start,
    /// True if the frame at the end may be nearly singular, because no modes meet there.
    pub may_be_weak: bool,
    /// Last frame on the path.
    pub reached: B::Frame,
    /// Frame of the last exchange of modes, or the first frame.
    pub origin: B::Frame,
    /// Storage of the next frame.
    pub next: &'a mut B::Frame,
    pub branches: B::Branches,
    pub guard: &'a mut Guard<B::Scalar, B::Inputs, B::PathEnclosures>,
}

impl<B: Blocks> Way<'_, B> {
    /// Advances to the end. `failure` is that of a single step.
    ///
    /// # Errors
    /// Returns a [`Failure`] if the end cannot be reached; see [`in_steps`].
    pub fn go(&mut self, failure: Failure<B::Scalar>) -> Result<(), Failure<B::Scalar>> {
        let [from, end] = self.ends;
        if self.is_without_length() && self.is_changed() {
            return self.change();
        }
        if from == end {
            // The last frame belongs to its own parameters only.
            return match self.start {
                Start::LastFrame => Ok(()),
                Start::Estimate => Err(failure),
            };
        }
        let may_cross = self.blocks.is_guarded() && self.blocks.may_cross();
        if may_cross {
            self.pass_ends();
        }
        let mut failure = match self.steps_to(end) {
            Ok(()) => return Ok(()),
            Err(broken) => broken.failure,
        };
        for _ in 0..CROSSINGS {
            if !may_cross || self.cross(&failure).is_err() {
                break;
            }
            match self.steps_to(end) {
                Ok(()) => return Ok(()),
                Err(broken) => failure = broken.failure,
            }
        }
        if may_cross && self.is_undecided(&failure) {
            failure.kind = FailureKind::Undecided;
        }
        Err(failure)
    }

    /// True if time is too coarse to be divided between the ends.
    fn is_without_length(&self) -> bool {
        let [from, end] = self.ends;
        let middle = from + B::Scalar::HALF * (end - from);
        middle == from || middle == end
    }

    /// True if an input differs between the ends.
    fn is_changed(&self) -> bool {
        let [first, last] = self.inputs;
        (0..last.count()).any(|index| first.value(index) != last.value(index))
    }

    /// Advances to the end of a path without duration, in steps of the inputs.
    ///
    /// # Errors
    /// Returns a [`Failure`] at the time of the end if the end cannot be reached.
    fn change(&mut self) -> Result<(), Failure<B::Scalar>> {
        let [_, end] = self.ends;
        self.changed = Some(B::Scalar::ZERO);
        let steps = self.steps([B::Scalar::ZERO, B::Scalar::ONE]);
        steps.map_err(|broken| Failure {
            time: end,
            ..broken.failure
        })
    }

    /// Advances to a time.
    #[inline(never)]
    pub(crate) fn steps_to(&mut self, end: B::Scalar) -> Result<(), Broken<B::Scalar>> {
        let from = B::time(&self.reached);
        if from == end {
            return Ok(());
        }
        self.steps([from, end])
    }

    /// Advances in as many steps as needed: from time to time, or from part to part of a change.
    fn steps(&mut self, [from, end]: [B::Scalar; 2]) -> Result<(), Broken<B::Scalar>> {
        let budget = self.settings.substeps;
        in_steps(from, end, budget, |place| self.step_to(place)).map(|_| ())
    }

    /// Advances to a time, or to a part of a change of the inputs, which is then the time of a failure.
    fn step_to(&mut self, place: B::Scalar) -> Result<(), Failure<B::Scalar>> {
        let changed = self.part_changed();
        let (t, before, inputs) = match changed {
            None => (
                place,
                self.inputs_at(B::time(&self.reached), None),
                self.inputs_at(place, None),
            ),
            Some(reached) => {
                let [from, end] = self.ends;
                let t = if place < B::Scalar::ONE { from } else { end };
                (t, self.changed_inputs(reached), self.changed_inputs(place))
            }
        };
        let step = self.step(t, &before, &inputs);
        if changed.is_some() {
            step.map_err(|failure| Failure {
                time: place,
                ..failure
            })?;
            self.changed = Some(place);
            return Ok(());
        }
        step
    }

    /// Completed part of the inputs' change. `None` without inputs, which the compiler then sees.
    fn part_changed(&self) -> Option<B::Scalar> {
        let [_, last] = self.inputs;
        match last.count() {
            0 => None,
            _ => self.changed,
        }
    }

    /// Signals at a part of their change.
    fn changed_inputs(&self, part: B::Scalar) -> B::Inputs {
        let [first, last] = self.inputs;
        match part < B::Scalar::ONE {
            true => between(first, last, |first, last| {
                first.straight_towards(last, part)
            }),
            false => last.clone(),
        }
    }

    fn step(
        &mut self,
        t: B::Scalar,
        before: &B::Inputs,
        inputs: &B::Inputs,
    ) -> Result<(), Failure<B::Scalar>> {
        let conditions = Conditions {
            t,
            start: self.start,
            parameters: self.parameters,
            inputs,
            settings: self.settings,
        };
        solve(
            self.blocks,
            self.next,
            &self.reached,
            &mut self.branches,
            &conditions,
        )?;
        let pair = Pair {
            at: self.next,
            last: &self.reached,
            before,
            conditions: &conditions,
        };
        // Frames between the ends are not returned to the caller.
        let may_be_weak = self.may_be_weak || t != self.ends[1] || self.changed.is_some();
        self.guard.admit(self.blocks, pair, may_be_weak)?;
        self.start = Start::LastFrame;
        core::mem::swap(self.next, &mut self.reached);
        Ok(())
    }

    /// Solves the frame at a time in these modes, from one nearby; no path leads there. Signals are those of the path,
    /// or continue from one of its ends.
    #[inline(never)]
    pub(crate) fn solved_at(
        &self,
        t: B::Scalar,
        about: Option<B::Scalar>,
        near: &B::Frame,
        branches: &B::Branches,
    ) -> Result<B::Frame, Failure<B::Scalar>> {
        let inputs = self.inputs_at(t, about);
        let conditions = Conditions {
            t,
            start: Start::Estimate,
            parameters: self.parameters,
            inputs: &inputs,
            settings: self.settings,
        };
        let (mut at, mut branches) = (near.clone(), branches.clone());
        solve(self.blocks, &mut at, near, &mut branches, &conditions)?;
        Ok(at)
    }

    /// Signals at a time on the path; beyond it, and about one of its ends, they continue from there.
    pub(crate) fn inputs_at(&self, t: B::Scalar, about: Option<B::Scalar>) -> B::Inputs {
        let ([from, end], [first, last]) = (self.ends, self.inputs);
        let part = (t - from) / (end - from);
        if about == Some(from) || part <= B::Scalar::ZERO && about.is_none() {
            gone_on(first, t - from)
        } else if about.is_some() || part >= B::Scalar::ONE {
            gone_on(last, t - end)
        } else {
            between(first, last, |first, last| {
                first.towards(last, end - from, part)
            })
        }
    }
}

/// Signals between these and `last`, each as `path` returns it.
fn between<T: Real, I: Values<Signal<T>>>(
    first: &I,
    last: &I,
    path: impl Fn(&Signal<T>, &Signal<T>) -> Signal<T>,
) -> I {
    let mut inputs = last.clone();
    for index in 0..inputs.count() {
        if let (Some(first), Some(last)) = (first.value(index), last.value(index)) {
            inputs.set(index, path(&first, &last));
        }
    }
    inputs
}

/// Signals after a time (s) with constant accelerations.
fn gone_on<T: Real, I: Values<Signal<T>>>(inputs: &I, time: T) -> I {
    let mut later = inputs.clone();
    if time != T::ZERO {
        for index in 0..inputs.count() {
            if let Some(signal) = inputs.value(index) {
                later.set(index, signal.after(time));
            }
        }
    }
    later
}
