//! Moves the mechanisms of all lanes from frame to frame.
//!
//! All lanes are solved together. A lane whose blocks fail, or whose path is not verified yet, is solved again by its own [`Shell`], which
//! finds the failure or advances in several steps. The other lanes keep their results.

use super::values::{LaneValues, ReadLanes};
use super::vectorized::vectorized;
use super::windows::Windows;
use super::{Lanes, Mask};
use crate::blocks::Blocks;
use crate::failure::Failure;
use crate::math::Real;
use crate::shell::{Shell, input_outside};
use crate::time_window::TimeWindow;

/// Data with which one instant of N mechanisms is solved.
#[derive(Clone, Copy, Debug)]
pub struct Conditions<'a, T, P, I> {
    /// Times (s).
    pub t: T,
    /// Parameters of the mechanisms.
    pub parameters: &'a P,
    /// Signals at these times.
    pub inputs: &'a I,
}

/// Equations that are solved for N mechanisms at once. Generated code and the interpreter implement this trait.
#[doc(hidden)]
pub trait InLanes<const N: usize>: Blocks {
    /// Frames of N mechanisms.
    type Frames: ReadLanes<Self::Frame> + Clone;
    /// Signs of their assembly modes.
    type Signs: LaneValues<Self::Branches>;
    /// Their parameters.
    type ParameterLanes: LaneValues<Self::Parameters>;
    /// Their inputs.
    type InputLanes: LaneValues<Self::Inputs>;

    /// Returns frames, signs, parameters and inputs of no mechanism.
    fn lanes(
        &self,
    ) -> (
        Self::Frames,
        Self::Signs,
        Self::ParameterLanes,
        Self::InputLanes,
    );

    /// Solves all blocks; returns the lanes that fail. Their frames are arbitrary then.
    fn solve_lanes(
        &self,
        at: &mut Self::Frames,
        last: &Self::Frames,
        signs: &Self::Signs,
        conditions: &Conditions<'_, Lanes<Self::Scalar, N>, Self::ParameterLanes, Self::InputLanes>,
    ) -> Mask<N>;

    /// Verifies by closed forms in sequence that windows of time about two frames hold one path; returns the lanes whose windows do. No lane
    /// is verified so if its mechanism has inputs, or other blocks than closed forms.
    #[inline]
    fn verify_lanes(
        &self,
        _at: &mut Self::Frames,
        _last: &Self::Frames,
        _window: &TimeWindow<Lanes<Self::Scalar, N>>,
        _parameters: &Self::ParameterLanes,
    ) -> Mask<N> {
        Mask::NONE
    }
}

/// N mechanisms that move in step.
///
/// Each lane is a mechanism with its own parameters, modes, inputs and times. Its frames have the bits of a [`Shell`] of its own.
#[derive(Clone)]
pub struct Group<B: InLanes<N>, const N: usize> {
    blocks: B,
    /// True if mechanisms have inputs.
    has_inputs: bool,
    /// Mechanism of each lane; `None` for an empty lane.
    shells: [Option<Shell<B>>; N],
    /// Last frames, and the older ones that the next ones replace.
    frames: [B::Frames; 2],
    second_is_last: bool,
    signs: B::Signs,
    parameters: B::ParameterLanes,
    inputs: B::InputLanes,
    /// Times of the last frames (s).
    times: [B::Scalar; N],
    windows: Windows<B::Scalar, N>,
    /// Lanes whose shells hold an older frame than `frames`.
    behind: Mask<N>,
    failures: [Option<Failure<B::Scalar>>; N],
}

impl<B: InLanes<N>, const N: usize> Group<B, N> {
    /// Returns a group of N empty lanes for mechanisms with these equations.
    pub fn new(blocks: B) -> Self {
        let (frames, signs, parameters, inputs) = blocks.lanes();
        Self {
            has_inputs: blocks.input_name(0).is_some(),
            blocks,
            shells: [const { None }; N],
            frames: [frames.clone(), frames],
            second_is_last: false,
            signs,
            parameters,
            inputs,
            times: [B::Scalar::ZERO; N],
            windows: Windows::new(),
            behind: Mask::NONE,
            failures: [None; N],
        }
    }

    /// Puts an assembled mechanism into a lane, where it continues from its last frame; does nothing beyond the last lane.
    pub fn put(&mut self, lane: usize, shell: Shell<B>) {
        for frames in &mut self.frames {
            frames.set_lane(lane, shell.frame());
        }
        self.signs.set_lane(lane, shell.branches());
        self.parameters.set_lane(lane, shell.parameters());
        self.windows.set(lane, shell.verified());
        self.behind = self.behind & !Mask::one(lane);
        if let Some(time) = self.times.get_mut(lane) {
            *time = B::time(shell.frame());
        }
        if let Some(failure) = self.failures.get_mut(lane) {
            *failure = None;
        }
        if let Some(place) = self.shells.get_mut(lane) {
            *place = Some(shell);
        }
    }

    /// Takes the mechanism with its last frame out of a lane; `None` for an empty lane, and beyond the last one.
    pub fn take(&mut self, lane: usize) -> Option<Shell<B>> {
        let mut shell = self.shells.get_mut(lane)?.take()?;
        if self.behind.has(lane) {
            shell.overwrite(|frame| last(&self.frames, self.second_is_last).get_lane(lane, frame));
        }
        Some(shell)
    }

    /// True if no lane has a mechanism.
    pub fn is_empty(&self) -> bool {
        self.shells.iter().all(Option::is_none)
    }

    /// Moves all mechanisms, each to its own time (s) with its own inputs. Returns the lanes that fail; their last frames stay as they are,
    /// and [`Group::failure`] returns the reason. Frames of empty lanes become arbitrary.
    #[inline]
    pub fn advance(&mut self, times: &[B::Scalar; N], inputs: &[&B::Inputs; N]) -> Mask<N> {
        let unsolved = self.solve(times, inputs);
        let shells = &self.shells;
        let present = Mask::of(|lane| shells[lane].is_some());
        let mut verified = self.windows.hold(times);
        let due = present & !(unsolved | verified);
        if !self.has_inputs && !due.is_empty() {
            self.extend_windows(times, due);
            verified = self.windows.hold(times);
        }
        let mut alone = present & (unsolved | !verified);
        if self.has_inputs {
            let times = self.times.iter().zip(times);
            let lanes = self.shells.iter_mut().zip(inputs).zip(times);
            for (lane, ((shell, inputs), (&last, &t))) in lanes.enumerate() {
                if let Some(shell) = shell
                    && !alone.has(lane)
                    && !shell.continues([last, t], inputs)
                {
                    alone |= Mask::one(lane);
                }
            }
        }
        self.behind |= !alone;
        self.times = *times;
        let failed = match alone.is_empty() {
            true => Mask::NONE,
            false => self.advance_alone([alone, unsolved], times, inputs),
        };
        self.second_is_last = !self.second_is_last;
        failed
    }

    /// Solves the frames at other times (s) with other inputs, whether or not paths lead there, as [`Shell::frame_at`] does for one
    /// mechanism: the mechanisms stay in their poses. Returns the lanes that fail, and the frames of the others.
    pub fn frames_at(
        &mut self,
        times: &[B::Scalar; N],
        inputs: &[&B::Inputs; N],
    ) -> (Mask<N>, &B::Frames) {
        let unsolved = self.solve(times, inputs);
        let (_, at) = both(&mut self.frames, self.second_is_last);
        let mut failed = Mask::NONE;
        for lane in unsolved.lanes() {
            let Some(shell) = &self.shells[lane] else {
                continue;
            };
            match shell.frame_at(times[lane], inputs[lane]) {
                Ok(frame) => at.set_lane(lane, &frame),
                Err(failure) => {
                    self.failures[lane] = Some(failure);
                    failed |= Mask::one(lane);
                }
            }
        }
        (failed, at)
    }

    /// Solves the next frames; returns the lanes without a solution, and those with inputs outside of their ranges.
    #[inline(always)]
    fn solve(&mut self, times: &[B::Scalar; N], inputs: &[&B::Inputs; N]) -> Mask<N> {
        let mut outside = Mask::NONE;
        if self.has_inputs {
            for (lane, inputs) in inputs.iter().enumerate() {
                self.inputs.set_lane(lane, inputs);
            }
            outside = Mask::of(|lane| input_outside(&self.blocks, inputs[lane]).is_some());
        }
        let (last, at) = both(&mut self.frames, self.second_is_last);
        let conditions = Conditions {
            t: Lanes(*times),
            parameters: &self.parameters,
            inputs: &self.inputs,
        };
        let (blocks, signs) = (&self.blocks, &self.signs);
        let unsolved = vectorized(
            #[inline(always)]
            || blocks.solve_lanes(at, last, signs, &conditions),
        );
        unsolved | outside
    }

    /// Extends the windows of the lanes that are due, and of others with them, beyond the next frames.
    #[inline(never)]
    fn extend_windows(&mut self, times: &[B::Scalar; N], due: Mask<N>) {
        let (last, at) = both(&mut self.frames, self.second_is_last);
        let (blocks, parameters, windows) = (&self.blocks, &self.parameters, &mut self.windows);
        let last_times = &self.times;
        vectorized(
            #[inline(always)]
            || {
                windows.extend(
                    [last_times, times],
                    due,
                    #[inline(always)]
                    |window| blocks.verify_lanes(at, last, window, parameters),
                );
            },
        );
    }

    /// Moves some mechanisms by their shells, of which some are unsolved; returns those that fail.
    #[cold]
    #[inline(never)]
    fn advance_alone(
        &mut self,
        [alone, unsolved]: [Mask<N>; 2],
        times: &[B::Scalar; N],
        inputs: &[&B::Inputs; N],
    ) -> Mask<N> {
        let (last, at) = both(&mut self.frames, self.second_is_last);
        let mut failed = Mask::NONE;
        let lanes = self.shells.iter_mut().zip(&mut self.failures);
        let conditions = times.iter().zip(inputs).zip(&mut self.times);
        for (lane, ((shell, failure), ((&t, inputs), time))) in lanes.zip(conditions).enumerate() {
            let Some(shell) = shell.as_mut().filter(|_| alone.has(lane)) else {
                continue;
            };
            if self.behind.has(lane) {
                shell.overwrite(|frame| last.get_lane(lane, frame));
            }
            let moved = match unsolved.has(lane) {
                true => shell.advance(t, inputs).map(|_| false),
                false => shell.admit(t, inputs, |frame| at.get_lane(lane, frame)),
            };
            if moved != Ok(true) {
                at.set_lane(lane, shell.frame());
                *time = B::time(shell.frame());
            }
            if moved.is_err() {
                failed |= Mask::one(lane);
            }
            *failure = moved.err();
            self.signs.set_lane(lane, shell.branches());
            self.windows.set(lane, shell.verified());
        }
        self.behind = self.behind & !alone;
        failed
    }

    /// Last frames of all lanes.
    #[inline]
    pub fn frames(&self) -> &B::Frames {
        last(&self.frames, self.second_is_last)
    }

    /// Reason why a lane failed last; `None` if it did not, or beyond the last lane.
    pub fn failure(&self, lane: usize) -> Option<Failure<B::Scalar>> {
        *self.failures.get(lane)?
    }
}

/// Returns the last frames.
#[inline(always)]
fn last<F>([first, second]: &[F; 2], second_is_last: bool) -> &F {
    match second_is_last {
        true => second,
        false => first,
    }
}

/// Returns the last frames, and the older ones.
#[inline(always)]
fn both<F>([first, second]: &mut [F; 2], second_is_last: bool) -> (&F, &mut F) {
    match second_is_last {
        true => (second, first),
        false => (first, second),
    }
}
