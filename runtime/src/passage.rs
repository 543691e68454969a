//! Continues a path through change points near its ends, or where it has broken.
//!
//! Only nearly singular frames are interpolated instead of solved; the frames before and beyond them are verified to
//! lie on the path like any other frame.

use crate::block::Start;
use crate::blocks::{Blocks, Conditions};
use crate::continuation::BLOCKS;
use crate::crossing::{Crossing, Meeting, SHORTER};
use crate::failure::{Failure, FailureKind};
use crate::guard::weak_block;
use crate::math::Real;
use crate::way::Way;

/// Least distance of the first times about a change point, relative to the path so far.
const FIRST_STEP: f64 = 1.0 / 16.0;

/// Square of the distance of modes, relative to that elsewhere, below which the mode of the motion is undecided.
const UNDECIDED: f64 = 1.0 / (1u32 << 20) as f64;

/// Obstacle to passing a change point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Barred {
    /// No modes meet there.
    NoMeeting,
    /// Modes meet there, but no path to the change point or through it can be verified.
    NoPath,
}

impl<B: Blocks> Way<'_, B> {
    /// Passes change points so near to the start or the end of the path that equations are nearly singular there.
    #[inline(never)]
    pub(crate) fn pass_ends(&mut self) {
        // The other mode of Newton-Raphson takes too long to be sought in each step that is divided.
        let is_iterated = self.blocks.is_iterated();
        if is_iterated || !self.blocks.holds_coordinates() || self.start == Start::Estimate {
            return;
        }
        let [from, end] = self.ends;
        let step = B::Scalar::from_f64(SHORTER) * (end - from);
        let is_closed = self.blocks.is_closed();
        let weak = match is_closed {
            true => self.weak_block(&self.reached, from),
            false => self.near_modes(from),
        };
        let mut passage = weak.map(|block| self.pass(from, block, step, true));
        if B::time(&self.reached) == end {
            return;
        }
        let block = match self.solved_at(end, None, &self.reached, &self.branches) {
            Ok(frame) if is_closed => self.weak_block(&frame, end),
            Ok(_) => self.near_modes(end),
            Err(failure) => Some(failure.block),
        };
        if let Some(block) = block {
            passage = Some(self.pass(end, block, step, true));
        }
        self.may_be_weak = passage == Some(Err(Barred::NoMeeting));
    }

    /// Passes the change point of a block at which the path has broken, if there is one.
    pub(crate) fn cross(&mut self, failure: &Failure<B::Scalar>) -> Result<(), Barred> {
        // At a change point, links may be apart by rounding.
        let may_meet = matches!(
            failure.kind,
            FailureKind::StepTooLarge
                | FailureKind::Singular { .. }
                | FailureKind::WrongBranch
                | FailureKind::OutOfReach { .. }
        );
        if !may_meet || self.start == Start::Estimate {
            return Err(Barred::NoMeeting);
        }
        let [from, near] = [&self.origin, &self.reached].map(B::time);
        let first = B::Scalar::from_f64(FIRST_STEP) * (near - from).abs();
        let step = (failure.time - near).abs().max(first);
        // A later block may refuse the step that an earlier one, whose modes meet, leads astray.
        let nearest = match self.blocks.is_iterated() {
            true => None,
            false => self.nearest_modes(near),
        };
        let block = nearest.map_or(failure.block, |(block, _)| block);
        self.pass(near, block, step, false)
    }

    /// True if modes of a block are far nearer to each other at the break than elsewhere, though the motion continues.
    #[inline(never)]
    pub(crate) fn is_undecided(&self, failure: &Failure<B::Scalar>) -> bool {
        let is_doubtful = matches!(
            failure.kind,
            FailureKind::StepTooLarge | FailureKind::Singular { .. } | FailureKind::WrongBranch
        );
        let near = B::time(&self.reached);
        let way = near - B::time(&self.origin);
        // A motion that turns back at a dead point has been followed to it, as far as rounding permits.
        let beyond = failure.time + B::Scalar::EPSILON.sqrt().sqrt() * way;
        if !is_doubtful
            || self.blocks.is_iterated()
            || self.start == Start::Estimate
            || self
                .solved_at(beyond, None, &self.reached, &self.branches)
                .is_err()
        {
            return false;
        }
        let [from, end] = self.ends;
        self.nearest_modes(near).is_some_and(|(block, square)| {
            let crossing = self.crossing(block);
            let whole = crossing.largest_distance(&self.reached, near, end - from);
            whole.is_some_and(|whole| square <= B::Scalar::from_f64(UNDECIDED) * whole)
        })
    }

    /// Block with the nearest modes at the time `t` (s), and the square of their distance.
    #[inline(never)]
    fn nearest_modes(&self, t: B::Scalar) -> Option<(u16, B::Scalar)> {
        let mut nearest: Option<(u16, B::Scalar)> = None;
        for block in 0..BLOCKS {
            if let Some(square) = self.crossing(block).distance(block, t, &self.reached)
                && nearest.is_none_or(|(_, least)| square < least)
            {
                nearest = Some((block, square));
            }
        }
        nearest
    }

    /// Block that cannot be solved at the time `t` (s), or whose modes are far nearer to each other than elsewhere on
    /// the path; `None` if there is none.
    #[inline(never)]
    fn near_modes(&self, t: B::Scalar) -> Option<u16> {
        if let Err(failure) = self.solved_at(t, None, &self.reached, &self.branches) {
            return Some(failure.block);
        }
        let (block, square) = self.nearest_modes(t)?;
        let [from, end] = self.ends;
        let elsewhere = from + B::Scalar::from_f64(SHORTER) * (end - from);
        let whole = self
            .crossing(block)
            .distance(block, elsewhere, &self.reached)?;
        (square <= B::Scalar::EPSILON.sqrt().sqrt() * whole).then_some(block)
    }

    /// Returns the modes of a block with the signals of the path.
    fn crossing(&self, block: u16) -> Crossing<'_, '_, B> {
        Crossing {
            way: self,
            block,
            direction: B::Scalar::ONE,
            about: None,
        }
    }

    /// Passes a change point near a time, or advances to the end if that is near it. The search begins at times of the
    /// distance `step` (s) before it; a change point at an end may lie on both sides of it.
    #[inline(never)]
    fn pass(
        &mut self,
        place: B::Scalar,
        block: u16,
        step: B::Scalar,
        is_end: bool,
    ) -> Result<(), Barred> {
        let [from, end] = self.ends;
        let direction = if end < from {
            -B::Scalar::ONE
        } else {
            B::Scalar::ONE
        };
        // Signals continue from one instant as smoothly as possible.
        let about = is_end.then_some(place);
        let origin = B::time(&self.origin);
        let ahead = |time: B::Scalar| direction * (time - origin);
        let crossing = Crossing {
            way: &*self,
            block,
            direction,
            about,
        };
        let near = match is_end {
            true => &self.origin,
            false => &self.reached,
        };
        let whole = crossing.largest_distance(near, place, end - from);
        let meeting = whole.and_then(|whole| crossing.meeting(near, place, step.abs(), whole));
        let Some(meeting) = meeting else {
            return Err(Barred::NoMeeting);
        };
        let meeting = crossing.narrowed(near, meeting);
        let Meeting { time, width, .. } = meeting;
        let from_place = direction * (time - place);
        let is_here = -from_place <= width
            && match is_end {
                true => from_place <= width,
                false => direction * (time - end) <= width,
            };
        let [before, beyond] = [time - direction * width, time + direction * width];
        if !is_here || ahead(beyond) < B::Scalar::ZERO {
            return Err(Barred::NoMeeting);
        }
        let is_outside = ahead(before) > B::Scalar::ZERO;
        // A frame beside the change point may lie before it or beyond it, as its rates tell.
        let sides = match is_outside {
            true => crossing.sides(near, &meeting, true),
            false => crossing.sides_through(&self.origin, &meeting),
        };
        let sides = sides.ok_or(Barred::NoPath)?;
        // The path may have come nearer than the modes can be told apart: the last frame before the change point must
        // lie on it.
        self.reached = self.origin.clone();
        self.guard.forget();
        if is_outside {
            self.steps_to(before).map_err(|_| Barred::NoPath)?;
        }
        // Angles continue without a jump from the last frame; a solution from farther away may be off by whole turns.
        let lands = direction * (end - beyond) < B::Scalar::ZERO;
        let is_before = lands && direction * (end - time) < B::Scalar::ZERO;
        let modes = match is_before {
            true => &sides.before,
            false => &sides.beyond,
        };
        let frame = if lands && self.blocks.holds_coordinates() {
            let crossing = Crossing {
                way: &*self,
                block,
                direction,
                about: Some(end),
            };
            crossing.interpolated(&self.reached, &meeting, &sides, end)
        } else {
            let t = if lands { end } else { beyond };
            self.solved_at(t, None, &self.reached, modes).ok()
        };
        let frame = frame.ok_or(Barred::NoPath)?;
        self.branches = modes.clone();
        self.reached = frame.clone();
        self.origin = frame;
        self.guard.forget();
        Ok(())
    }

    /// First block that closed forms show to be nearly singular in a frame; `None` if there is none.
    #[inline(never)]
    fn weak_block(&self, frame: &B::Frame, t: B::Scalar) -> Option<u16> {
        let inputs = self.inputs_at(t, None);
        let conditions = Conditions {
            t,
            start: Start::LastFrame,
            parameters: self.parameters,
            inputs: &inputs,
            settings: self.settings,
        };
        weak_block(self.blocks, frame, &conditions)
    }
}
