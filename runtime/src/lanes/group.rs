//! Moves the mechanisms of all lanes from frame to frame.
//!
//! All lanes are solved together. A lane whose blocks fail, or whose path is not verified yet, is solved again by its own [`Shell`], which
//! finds the failure or advances in several steps. The other lanes keep their results.

use super::values::{LaneValues, Zero};
use super::vectorized::vectorized;
use super::{Lanes, Mask};
use crate::blocks::Blocks;
use crate::failure::Failure;
use crate::math::Real;
use crate::shell::Shell;

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

/// Equations that are solved for N mechanisms at once. Generated code implements this trait.
#[doc(hidden)]
pub trait InLanes<const N: usize>: Blocks {
    /// Frames of N mechanisms.
    type Frames: LaneValues<Self::Frame>;
    /// Signs of their assembly modes.
    #[doc(hidden)]
    type Signs: LaneValues<Self::Branches>;
    /// Their parameters.
    #[doc(hidden)]
    type ParameterLanes: LaneValues<Self::Parameters>;
    /// Their inputs.
    #[doc(hidden)]
    type InputLanes: LaneValues<Self::Inputs>;

    /// Solves all blocks; returns the lanes that fail. Their frames are arbitrary then.
    #[doc(hidden)]
    fn solve_lanes(
        at: &mut Self::Frames,
        last: &Self::Frames,
        signs: &Self::Signs,
        conditions: &Conditions<'_, Lanes<Self::Scalar, N>, Self::ParameterLanes, Self::InputLanes>,
    ) -> Mask<N>;
}

/// N mechanisms that move in step.
///
/// Each lane is a mechanism with its own parameters, modes, inputs and times. Its frames have the bits of a [`Shell`] of its own.
#[derive(Clone)]
pub struct Group<B: InLanes<N>, const N: usize> {
    shells: [Shell<B>; N],
    /// Last frames, and the older ones that the next ones replace.
    frames: [B::Frames; 2],
    second_is_last: bool,
    signs: B::Signs,
    parameters: B::ParameterLanes,
    inputs: B::InputLanes,
    /// Times of the last frames (s).
    times: [B::Scalar; N],
    /// Middles and half lengths of the windows of time in which paths are verified (s).
    windows: [Lanes<B::Scalar, N>; 2],
    /// Lanes whose shells hold an older frame than `frames`.
    behind: Mask<N>,
    /// Lanes that do not move.
    resting: Mask<N>,
    failures: [Option<Failure<B::Scalar>>; N],
}

impl<B: InLanes<N>, const N: usize> Group<B, N> {
    /// Returns the group of N assembled mechanisms, which continue from their last frames.
    pub fn new(shells: [Shell<B>; N]) -> Self {
        let mut group = Self {
            shells,
            frames: [B::Frames::ZERO; 2],
            second_is_last: false,
            signs: B::Signs::ZERO,
            parameters: B::ParameterLanes::ZERO,
            inputs: B::InputLanes::ZERO,
            times: [B::Scalar::ZERO; N],
            windows: [Lanes::splat(B::Scalar::ZERO); 2],
            behind: Mask::NONE,
            resting: Mask::NONE,
            failures: [None; N],
        };
        for lane in 0..N {
            group.enter(lane);
        }
        group
    }

    /// Moves all mechanisms, each to its own time (s) with its own inputs. Returns the lanes that fail; their last frames stay as they are,
    /// and [`Group::failure`] returns the reason.
    #[inline]
    pub fn advance(&mut self, times: &[B::Scalar; N], inputs: &[B::Inputs; N]) -> Mask<N> {
        let has_inputs = size_of::<B::Inputs>() != 0;
        if has_inputs {
            for (lane, inputs) in inputs.iter().enumerate() {
                self.inputs.set_lane(lane, inputs);
            }
        }
        let [first, second] = &mut self.frames;
        let (last, at) = match self.second_is_last {
            true => (&*second, first),
            false => (&*first, second),
        };
        let conditions = Conditions {
            t: Lanes(*times),
            parameters: &self.parameters,
            inputs: &self.inputs,
        };
        let (signs, [middles, lengths]) = (&self.signs, &self.windows);
        let [unsolved, mut alone] = vectorized(
            #[inline(always)]
            || {
                let unsolved = B::solve_lanes(at, last, signs, &conditions);
                let is_inside =
                    |lane: usize| (times[lane] - middles.0[lane]).abs() <= lengths.0[lane];
                [unsolved, unsolved | !Mask::of(is_inside)]
            },
        );
        if has_inputs {
            let times = self.times.iter().zip(times);
            let lanes = self.shells.iter_mut().zip(inputs).zip(times);
            for (lane, ((shell, inputs), (&last, &t))) in lanes.enumerate() {
                if !alone.has(lane) && !shell.continues([last, t], inputs) {
                    alone |= Mask::one(lane);
                }
            }
        }
        alone = alone & !self.resting;
        self.behind |= !(alone | self.resting);
        self.times = *times;
        let failed = match alone.is_empty() {
            true => self.resting,
            false => self.resting | self.advance_alone([alone, unsolved], times, inputs),
        };
        self.second_is_last = !self.second_is_last;
        failed
    }

    /// Moves some mechanisms by their shells, of which some are unsolved; returns those that fail.
    #[cold]
    #[inline(never)]
    fn advance_alone(
        &mut self,
        [alone, unsolved]: [Mask<N>; 2],
        times: &[B::Scalar; N],
        inputs: &[B::Inputs; N],
    ) -> Mask<N> {
        let [first, second] = &mut self.frames;
        let (last, at) = match self.second_is_last {
            true => (&*second, first),
            false => (&*first, second),
        };
        let mut failed = Mask::NONE;
        let lanes = self
            .shells
            .iter_mut()
            .zip(&mut self.failures)
            .zip(&mut self.times);
        let conditions = times.iter().zip(inputs);
        for (lane, (((shell, failure), time), (&t, inputs))) in lanes.zip(conditions).enumerate() {
            if !alone.has(lane) {
                continue;
            }
            if self.behind.has(lane) {
                shell.overwrite(|frame| last.get_lane(lane, frame));
            }
            let moved = match unsolved.has(lane) {
                true => shell.advance(t, inputs).map(|_| false),
                false => shell.admit(t, inputs, |frame| at.get_lane(lane, frame)),
            };
            *failure = moved.err();
            if failure.is_some() {
                failed |= Mask::one(lane);
            }
            *time = B::time(shell.frame());
            if moved != Ok(true) {
                at.set_lane(lane, shell.frame());
            }
            self.signs.set_lane(lane, shell.branches());
            set_window(&mut self.windows, lane, shell);
        }
        self.behind = self.behind & !alone;
        failed
    }

    /// Last frames of all lanes; arbitrary for lanes that rest.
    #[inline]
    pub fn frames(&self) -> &B::Frames {
        let [first, second] = &self.frames;
        match self.second_is_last {
            true => second,
            false => first,
        }
    }

    /// Reason why a lane failed last; `None` if it did not, or beyond the last lane.
    pub fn failure(&self, lane: usize) -> Option<Failure<B::Scalar>> {
        *self.failures.get(lane)?
    }

    /// Mechanism of a lane with its last frame; `None` beyond the last lane.
    pub fn shell(&self, lane: usize) -> Option<Shell<B>>
    where
        B: Clone,
    {
        let mut shell = self.shells.get(lane)?.clone();
        if self.behind.has(lane) {
            shell.overwrite(|frame| self.frames().get_lane(lane, frame));
        }
        Some(shell)
    }

    /// Replaces the mechanism of a lane, which continues from its last frame; does nothing beyond the last lane.
    pub fn replace(&mut self, lane: usize, shell: Shell<B>) {
        if let Some(place) = self.shells.get_mut(lane) {
            *place = shell;
            self.enter(lane);
        }
    }

    /// Leaves the mechanism of a lane where it is until it is replaced, so that it costs nothing. It counts as failed then.
    pub fn rest(&mut self, lane: usize) {
        let [first, second] = &self.frames;
        let last = match self.second_is_last {
            true => second,
            false => first,
        };
        if let Some(shell) = self.shells.get_mut(lane) {
            if self.behind.has(lane) {
                shell.overwrite(|frame| last.get_lane(lane, frame));
            }
            self.behind = self.behind & !Mask::one(lane);
            self.resting |= Mask::one(lane);
        }
    }

    /// Takes values of a lane from its shell.
    fn enter(&mut self, lane: usize) {
        let Some(shell) = self.shells.get(lane) else {
            return;
        };
        for frames in &mut self.frames {
            frames.set_lane(lane, shell.frame());
        }
        self.signs.set_lane(lane, shell.branches());
        self.parameters.set_lane(lane, shell.parameters());
        set_window(&mut self.windows, lane, shell);
        self.times[lane] = B::time(shell.frame());
        self.failures[lane] = None;
        self.behind = self.behind & !Mask::one(lane);
        self.resting = self.resting & !Mask::one(lane);
    }
}

/// Takes the window of a lane from its shell. Nothing is inside a window of negative length.
fn set_window<B: Blocks, const N: usize>(
    windows: &mut [Lanes<B::Scalar, N>; 2],
    lane: usize,
    shell: &Shell<B>,
) {
    let none = [B::Scalar::ZERO, -B::Scalar::ONE];
    let [middle, length] = shell.verified().unwrap_or(none);
    windows[0].set(lane, middle);
    windows[1].set(lane, length);
}
