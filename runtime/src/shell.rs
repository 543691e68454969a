//! Moves a mechanism from frame to frame: assembly, motion, branches, parameters and inputs.
//!
//! A [`Shell`] keeps two frames, the last one and the one that the next solution is written to. Only a successful
//! solution replaces the last frame. A motion that one step cannot complete takes several, as
//! [`crate::substeps`] describes.

use crate::block::Start;
use crate::blocks::{Blocks, Conditions, Values};
use crate::clock::Clock;
use crate::closed_form::failed;
use crate::failure::{Failure, FailureKind, index};
use crate::guard::{Guard, Pair};
use crate::math::Real;
use crate::settings::Settings;
use crate::signal::Signal;
use crate::value_range::first_outside;
use crate::way::Way;

/// Mechanism in motion: its equations, its last frame, and the parameters, inputs and modes with which the next one is
/// solved.
///
/// A generated type has one inside, and the interpreter returns one. Its functions work without any names:
///
/// ```
/// use linkwright::{Mechanism, Settings, Shell, Values};
///
/// linkwright_macros::mechanism! {
///     mechanism crank {
///         point O = (0, 0);
///         body arm at O { O, A: (2, 0) }
///         revolute O(ground, arm);
///         drive phi(arm) = 3*t;
///     }
/// }
/// use crank::{Branches, Coordinates, Loops};
///
/// let estimate = Coordinates { phi_arm: 0.1, ..Coordinates::DESIGN };
/// let mut shell = Shell::assemble(Loops, &(), &estimate, Branches::DESIGN, 0.0, &(), Settings::default())?;
/// let frame = shell.advance(0.5, &())?;
/// assert_eq!(frame.q.phi_arm, 1.5);
/// # Ok::<(), linkwright::Failure>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shell<B: Blocks> {
    blocks: B,
    /// Last frame, and the older one that the next frame replaces.
    frames: [B::Frame; 2],
    second_is_last: bool,
    /// Kind of the last frame: after a change of parameters it is an estimate.
    start: Start,
    branches: B::Branches,
    parameters: B::Parameters,
    inputs: B::Inputs,
    settings: Settings<B::Scalar>,
    guard: Guard<B::Scalar, B::Inputs, B::PathEnclosures>,
    clock: Clock<B::Scalar>,
}

impl<B: Blocks> Shell<B> {
    /// Assembles the mechanism at time `t` (s) in these modes, with angles near those of `estimate`. A block of
    /// Newton-Raphson starts from the estimate, which may be poor.
    ///
    /// # Errors
    /// Returns a [`Failure`] if it cannot be assembled so.
    pub fn assemble(
        blocks: B,
        parameters: &B::Parameters,
        estimate: &B::Coordinates,
        mut branches: B::Branches,
        t: B::Scalar,
        inputs: &B::Inputs,
        settings: Settings<B::Scalar>,
    ) -> Result<Self, Failure<B::Scalar>> {
        allow(&blocks, parameters, t)?;
        accept(&blocks, inputs, t)?;
        let mut last = blocks.estimate(estimate, parameters, t);
        blocks.begin(&mut branches, &mut last);
        let mut at = last.clone();
        let conditions = Conditions {
            t,
            start: Start::Estimate,
            parameters,
            inputs,
            settings: &settings,
        };
        solve(&blocks, &mut at, &last, &mut branches, &conditions)?;
        Ok(Self {
            blocks,
            frames: [at, last],
            second_is_last: false,
            start: Start::LastFrame,
            branches,
            parameters: parameters.clone(),
            inputs: inputs.clone(),
            settings,
            guard: Guard::new(),
            clock: Clock::at(t),
        })
    }

    /// Moves the mechanism to time `t` (s), starting from the last frame, which a failure leaves as it is.
    ///
    /// If that is not possible in one step, it takes at most [`Settings::substeps`] attempts, of all blocks each. In
    /// between, the inputs follow the polynomial of the fifth degree that has values, rates and accelerations of both
    /// ends. If time does not pass, or by no more than one rounding, values, rates and accelerations change linearly to
    /// the new ones, at one time: a changed input is a step of its own.
    ///
    /// # Errors
    /// Returns a [`Failure`] if the equations cannot be solved from there. Its time is the end of the motion, or the
    /// last time that could be followed. An input that is not finite is
    /// [`FailureKind::NotFinite`] at the time `t`, with the input's index, and one outside of its range
    /// [`FailureKind::OutsideRange`]. A length that inputs make not positive is [`FailureKind::NotPositive`] at that time.
    #[inline]
    pub fn advance(
        &mut self,
        t: B::Scalar,
        inputs: &B::Inputs,
    ) -> Result<&B::Frame, Failure<B::Scalar>> {
        accept(&self.blocks, inputs, t)?;
        let [first, second] = &mut self.frames;
        let (last, at) = match self.second_is_last {
            true => (&*second, first),
            false => (&*first, second),
        };
        let conditions = Conditions {
            t,
            start: self.start,
            parameters: &self.parameters,
            inputs,
            settings: &self.settings,
        };
        let solved =
            solve(&self.blocks, at, last, &mut self.branches, &conditions).and_then(|()| {
                let pair = Pair {
                    at,
                    last,
                    before: &self.inputs,
                    conditions: &conditions,
                };
                self.guard.admit(&self.blocks, pair, false)
            });
        if let Err(failure) = solved {
            self.advance_in_steps(failure, t, inputs)?;
        }
        self.inputs = inputs.clone();
        self.start = Start::LastFrame;
        self.second_is_last = !self.second_is_last;
        Ok(self.frame())
    }

    /// Moves the mechanism to a frame that is solved elsewhere, with the bits that [`Blocks::solve`] would find in these
    /// conditions. `write` overwrites an older frame with it. Returns true if the path leads to that frame in one step.
    ///
    /// # Errors
    /// Returns those of [`Shell::advance`], of the path to the frame.
    #[inline]
    pub(crate) fn admit(
        &mut self,
        t: B::Scalar,
        inputs: &B::Inputs,
        write: impl FnOnce(&mut B::Frame),
    ) -> Result<bool, Failure<B::Scalar>> {
        let [first, second] = &mut self.frames;
        let (last, at) = match self.second_is_last {
            true => (&*second, first),
            false => (&*first, second),
        };
        write(at);
        let conditions = Conditions {
            t,
            start: self.start,
            parameters: &self.parameters,
            inputs,
            settings: &self.settings,
        };
        let pair = Pair {
            at,
            last,
            before: &self.inputs,
            conditions: &conditions,
        };
        let admitted = self.guard.admit(&self.blocks, pair, false);
        let is_one_step = admitted.is_ok();
        if let Err(failure) = admitted {
            self.advance_in_steps(failure, t, inputs)?;
        }
        self.inputs.clone_from(inputs);
        self.start = Start::LastFrame;
        self.second_is_last = !self.second_is_last;
        Ok(is_one_step)
    }

    /// Moves the mechanism to time `t` (s) in several steps, after one has ended with `failure`, or locates the end of
    /// the motion. The new frame replaces the older one.
    #[cold]
    fn advance_in_steps(
        &mut self,
        failure: Failure<B::Scalar>,
        t: B::Scalar,
        inputs: &B::Inputs,
    ) -> Result<(), Failure<B::Scalar>> {
        // No path leads to inputs that are not allowed.
        let is_driven_so =
            inputs.count() > 0 && matches!(failure.kind, FailureKind::NotPositive { .. });
        if failure.input.is_some() || is_driven_so || self.settings.substeps <= 1 {
            return Err(failure);
        }
        // The steps depend on the last frame alone, not on the windows that have led there: these differ between lanes.
        self.guard.restart();
        let [first, second] = &mut self.frames;
        let (last, at) = match self.second_is_last {
            true => (&*second, first),
            false => (&*first, second),
        };
        let mut way = Way {
            blocks: &self.blocks,
            parameters: &self.parameters,
            settings: &self.settings,
            ends: [B::time(last), t],
            inputs: [&self.inputs, inputs],
            changed: None,
            may_be_weak: false,
            start: self.start,
            reached: last.clone(),
            origin: last.clone(),
            next: at,
            branches: self.branches.clone(),
            guard: &mut self.guard,
        };
        way.go(failure)?;
        self.branches = way.branches;
        *way.next = way.reached;
        Ok(())
    }

    /// Frame at time `t` (s) in the current modes, whether or not a path leads there: an entry of a table, for example.
    /// The mechanism stays in its pose. Angles are near those of the last frame, from which Newton-Raphson starts.
    ///
    /// # Errors
    /// Returns a [`Failure`] if it cannot be assembled so at that time.
    pub fn frame_at(
        &self,
        t: B::Scalar,
        inputs: &B::Inputs,
    ) -> Result<B::Frame, Failure<B::Scalar>> {
        self.solved_at(t, inputs, &mut self.branches.clone())
    }

    /// Solves the frame at time `t` (s) in these modes; blocks that determine their mode write it there.
    fn solved_at(
        &self,
        t: B::Scalar,
        inputs: &B::Inputs,
        branches: &mut B::Branches,
    ) -> Result<B::Frame, Failure<B::Scalar>> {
        accept(&self.blocks, inputs, t)?;
        let last = self.frame();
        let mut at = last.clone();
        let conditions = Conditions {
            t,
            start: Start::Estimate,
            parameters: &self.parameters,
            inputs,
            settings: &self.settings,
        };
        solve(&self.blocks, &mut at, last, branches, &conditions)?;
        Ok(at)
    }

    /// Moves the mechanism by the time `duration` (s) from the last frame, as [`Shell::advance`] does; a failure leaves
    /// that frame unchanged.
    ///
    /// The times of successive calls are a compensated sum. The time of the frame is the rounded sum, also if a single
    /// duration is less than half a rounding of it. A failure does not let time pass: the next duration includes it.
    ///
    /// # Errors
    /// Returns those of [`Shell::advance`].
    pub fn advance_by(
        &mut self,
        duration: B::Scalar,
        inputs: &B::Inputs,
    ) -> Result<&B::Frame, Failure<B::Scalar>> {
        let clock = self.clock.after(B::time(self.frame()), duration);
        self.advance(clock.t, inputs)?;
        self.clock = clock;
        Ok(self.frame())
    }

    /// Assembles the mechanism at time `t` (s) near the last frame and in its modes, whether or not a path leads there:
    /// after a gap in the signals, for example. Whole turns in between are not counted. A failure leaves the last frame
    /// unchanged.
    ///
    /// Returns the jump: the change of each coordinate in its unit, m or rad; `None` if frames do not hold all
    /// coordinates.
    ///
    /// # Errors
    /// Returns a [`Failure`] if the mechanism cannot be assembled so.
    pub fn recover(
        &mut self,
        t: B::Scalar,
        inputs: &B::Inputs,
    ) -> Result<Option<B::Coordinates>, Failure<B::Scalar>> {
        let mut branches = self.branches.clone();
        let at = self.solved_at(t, inputs, &mut branches)?;
        let jump = self.jump(&at);
        self.resume(&at, &branches, inputs);
        Ok(jump)
    }

    /// Change of every coordinate from the last frame to another one; `None` if frames do not hold all coordinates.
    fn jump(&self, at: &B::Frame) -> Option<B::Coordinates> {
        let mut jump = self.blocks.drawn_pose(&self.parameters);
        for index in 0..jump.count() {
            let value = |frame: &B::Frame| Some(self.blocks.coordinate(frame, index)?[0]);
            jump.set(index, value(at)? - value(self.frame())?);
        }
        Some(jump)
    }

    /// Last solved instant.
    #[inline]
    pub fn frame(&self) -> &B::Frame {
        let [first, second] = &self.frames;
        match self.second_is_last {
            true => second,
            false => first,
        }
    }

    /// Continues from another frame, solved in these modes with these inputs and the parameters of the shell.
    pub fn resume(&mut self, frame: &B::Frame, branches: &B::Branches, inputs: &B::Inputs) {
        let [first, second] = &mut self.frames;
        match self.second_is_last {
            true => second.clone_from(frame),
            false => first.clone_from(frame),
        }
        self.branches = branches.clone();
        self.inputs = inputs.clone();
        self.start = Start::LastFrame;
        self.guard.forget();
    }

    /// Overwrites the last frame with the bits of a solution with the current parameters, modes and inputs.
    pub(crate) fn overwrite(&mut self, write: impl FnOnce(&mut B::Frame)) {
        let [first, second] = &mut self.frames;
        match self.second_is_last {
            true => write(second),
            false => write(first),
        }
    }

    /// Middle and half length (s) of the window of time in which the path is verified as far as time decides; `None` if
    /// there is none.
    pub(crate) fn verified(&self) -> Option<[B::Scalar; 2]> {
        match self.blocks.is_guarded() {
            true => self.guard.verified(),
            // No time is further away.
            false => Some([B::Scalar::ZERO, B::Scalar::ONE / B::Scalar::MIN_POSITIVE]),
        }
    }

    /// True if the path between two times (s) to these inputs is in the verified window as far as inputs decide. They are
    /// the last ones then.
    #[inline]
    pub(crate) fn continues(&mut self, times: [B::Scalar; 2], inputs: &B::Inputs) -> bool {
        let continues = inputs.are_finite()
            && (!self.blocks.is_guarded() || self.guard.continues([&self.inputs, inputs], times));
        if continues {
            self.inputs.clone_from(inputs);
        }
        continues
    }

    /// Equations of the mechanism.
    pub fn blocks(&self) -> &B {
        &self.blocks
    }

    /// Returns the equations of a mechanism that is no longer needed.
    #[doc(hidden)]
    pub fn into_blocks(self) -> B {
        self.blocks
    }

    /// Assembly modes of the mechanism.
    pub fn branches(&self) -> &B::Branches {
        &self.branches
    }

    /// Parameters with which the next instant is solved.
    pub fn parameters(&self) -> &B::Parameters {
        &self.parameters
    }

    /// Changes the parameters. The last frame stays as it was solved; the next one is solved with these parameters, in
    /// the same modes, with angles near those of the last frame.
    ///
    /// # Errors
    /// Returns [`FailureKind::OutsideRange`], [`FailureKind::NotPositive`] or [`FailureKind::NotFinite`] for values that
    /// a description may not have; the parameters are then unchanged.
    pub fn set_parameters(&mut self, parameters: &B::Parameters) -> Result<(), Failure<B::Scalar>> {
        let t = B::time(self.frame());
        allow(&self.blocks, parameters, t)?;
        self.parameters = parameters.clone();
        self.start = Start::Estimate;
        self.guard.forget();
        Ok(())
    }
}

/// Refuses parameters that a description may not have.
fn allow<B: Blocks>(
    blocks: &B,
    parameters: &B::Parameters,
    t: B::Scalar,
) -> Result<(), Failure<B::Scalar>> {
    let values = (0..parameters.count()).map_while(|index| parameters.value(index));
    if let Some((place, value)) = first_outside(values, |index| blocks.parameter_range(index)) {
        return Err(failed(FailureKind::OutsideRange { value }, t, place));
    }
    if !parameters.are_finite() {
        return Err(failed(FailureKind::NotFinite, t, 0));
    }
    match blocks.not_positive(parameters) {
        Some((place, value)) => Err(failed(FailureKind::NotPositive { value }, t, place)),
        None => Ok(()),
    }
}

/// Refuses inputs outside of their ranges. Steps between two frames are exempt: their inputs are interpolated.
#[inline]
fn accept<B: Blocks>(
    blocks: &B,
    inputs: &B::Inputs,
    t: B::Scalar,
) -> Result<(), Failure<B::Scalar>> {
    match input_outside(blocks, inputs) {
        Some((place, value)) => Err(Failure {
            input: Some(place),
            ..failed(FailureKind::OutsideRange { value }, t, 0)
        }),
        None => Ok(()),
    }
}

/// Returns the index and the value of the first input outside of its range; `None` if all are in their ranges.
#[inline]
pub(crate) fn input_outside<B: Blocks>(blocks: &B, inputs: &B::Inputs) -> Option<(u16, B::Scalar)> {
    let values = (0..inputs.count()).map_while(|index| Some(inputs.value(index)?.value));
    first_outside(values, |index| blocks.input_range(index))
}

/// Solves all blocks if all numbers are finite.
#[inline]
pub(crate) fn solve<B: Blocks>(
    blocks: &B,
    at: &mut B::Frame,
    last: &B::Frame,
    branches: &mut B::Branches,
    conditions: &Conditions<'_, B::Scalar, B::Parameters, B::Inputs>,
) -> Result<(), Failure<B::Scalar>> {
    if !(conditions.parameters.are_finite() && conditions.inputs.are_finite()) {
        return Err(not_finite(conditions));
    }
    blocks.solve(at, last, branches, conditions)
}

/// Failure of an instant whose parameters or inputs are not finite: it names the first such input.
#[cold]
fn not_finite<T: Real, P, I: Values<Signal<T>>>(
    conditions: &Conditions<'_, T, P, I>,
) -> Failure<T> {
    let input = (0..conditions.inputs.count()).find(|&place| {
        conditions
            .inputs
            .value(place)
            .is_some_and(|signal| !signal.is_finite())
    });
    Failure {
        input: input.map(index),
        ..failed(FailureKind::NotFinite, conditions.t, 0)
    }
}
