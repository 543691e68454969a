//! The frames of a mechanism, one after another → whether each lies on the smooth path of the last one.
//!
//! The blocks can show that for a whole [`TimeWindow`] of time about two frames, closed forms at the cost of a part of a frame, all
//! equations together at that of some frames. So a [`Guard`] looks beyond the frames as far as it can, and every frame that lies in
//! such a window, as nearly all do where steps are short, needs no more than to be found there. The module does not know equations.

use crate::block::Start;
use crate::blocks::{Blocks, Conditions, Signals};
use crate::closed_form::failed;
use crate::failure::{Failure, FailureKind};
use crate::math::Real;
use crate::signal::Signal;
use crate::time_window::TimeWindow;

/// How many steps a guard looks ahead at first, at least and at most. It does not look ahead where it would be less.
const AHEAD: [f64; 3] = [16.0, 2.0, 1024.0];

/// By how much it looks farther after a success, and less far after a failure.
const GROWTH: f64 = 1.125;
const SHRINKING: f64 = 0.625;

/// Rounding that must not make a frame singular: links that enclose less than some 6e-4 rad leave accelerations few digits.
const WEAK: f64 = 1.0 / (1u32 << 26) as f64;

/// Multiple of that for what is found beyond it.
const FAR: f64 = 64.0;

/// What is known of the path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Guard<T, I, U> {
    window: Option<Window<T, I, U>>,
    /// How many steps it looks ahead next.
    steps: T,
    /// The same of closed forms by themselves.
    steps_of_closed_forms: T,
}

/// A window of time in which everything that is found lies on one path.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Window<T, I, U> {
    window: TimeWindow<T>,
    /// The time of the second frame (s).
    t: T,
    /// The inputs of both frames.
    inputs: [I; 2],
    enclosures: U,
}

/// Two frames and what they were solved with.
pub struct Pair<'a, B: Blocks> {
    /// The second frame.
    pub at: &'a B::Frame,
    /// The first frame.
    pub last: &'a B::Frame,
    /// The inputs of the first frame.
    pub before: &'a B::Inputs,
    /// What the second one was solved with.
    pub conditions: &'a Conditions<'a, B::Scalar, B::Parameters, B::Inputs>,
}

impl<T: Real, I: Signals<T>, U: Clone> Guard<T, I, U> {
    /// Nothing is known.
    pub fn new() -> Self {
        Self {
            window: None,
            steps: T::from_f64(AHEAD[0]),
            steps_of_closed_forms: T::from_f64(AHEAD[0]),
        }
    }

    /// Forgets the path: the next frame is the first one of another.
    pub fn forget(&mut self) {
        self.window = None;
    }

    /// Asks that a frame lies on the path of the last one. The first frame of a path lies on it. A frame that is nearly singular is
    /// refused but where it `may_be_weak`.
    ///
    /// # Errors
    /// [`FailureKind::StepTooLarge`] where that cannot be shown, with the block.
    #[inline]
    pub fn admit<B>(
        &mut self,
        blocks: &B,
        pair: Pair<'_, B>,
        may_be_weak: bool,
    ) -> Result<(), Failure<T>>
    where
        B: Blocks<Scalar = T, Inputs = I, PathEnclosures = U>,
    {
        if !blocks.is_guarded() || pair.conditions.start == Start::Estimate {
            return Ok(());
        }
        match &self.window {
            Some(window) if window.holds(blocks, &pair) => Ok(()),
            _ => self.look(blocks, pair, may_be_weak),
        }
    }

    /// Looks at the path between two frames, and beyond: first at closed forms one after another, which takes little, then at all
    /// equations together.
    #[cold]
    fn look<B>(
        &mut self,
        blocks: &B,
        pair: Pair<'_, B>,
        may_be_weak: bool,
    ) -> Result<(), Failure<T>>
    where
        B: Blocks<Scalar = T, Inputs = I, PathEnclosures = U>,
    {
        let pair = &pair;
        let t = pair.conditions.t;
        let step = t - B::time(pair.last);
        self.window = None;
        let mut enclosures = blocks.enclosures();
        if blocks.is_closed() {
            let stays = |window: &TimeWindow<T>| {
                verify_nonsingular(blocks, pair, &window.at_least(WEAK)).is_ok()
            };
            if let Some(window) = farthest(&mut self.steps_of_closed_forms, step, stays) {
                self.window = Some(Window::new(pair, window, enclosures));
                return Ok(());
            }
            if stays(&TimeWindow::between(step)) {
                return Ok(());
            }
        }
        // Where it is not far from singular, what is found beyond the frames may be nearer.
        let is_far = !blocks.is_closed() || weak(blocks, pair, WEAK * FAR).is_none();
        if !is_far
            && !may_be_weak
            && let Some(block) = weak(blocks, pair, WEAK)
        {
            return Err(failed(FailureKind::StepTooLarge, t, block));
        }
        let keeps = |window: &TimeWindow<T>| {
            is_far && blocks.verify_path(pair, window, &mut enclosures).is_ok()
        };
        if let Some(window) = farthest(&mut self.steps, step, keeps) {
            self.window = Some(Window::new(pair, window, enclosures));
            return Ok(());
        }
        let kept = blocks.verify_path(pair, &TimeWindow::between(step), &mut enclosures);
        kept.map_err(|block| failed(FailureKind::StepTooLarge, t, block))
    }
}

/// The first block that is nearly singular in a frame, as far as closed forms tell.
pub(crate) fn weak_block<B: Blocks>(
    blocks: &B,
    frame: &B::Frame,
    conditions: &Conditions<'_, B::Scalar, B::Parameters, B::Inputs>,
) -> Option<u16> {
    let pair = Pair {
        at: frame,
        last: frame,
        before: conditions.inputs,
        conditions,
    };
    weak(blocks, &pair, WEAK)
}

/// The first block that such a rounding might make singular in the second of two frames.
fn weak<B: Blocks>(blocks: &B, pair: &Pair<'_, B>, rounding: f64) -> Option<u16> {
    let pair = Pair {
        last: pair.at,
        before: pair.conditions.inputs,
        ..*pair
    };
    let window = TimeWindow::between(B::Scalar::ZERO).at_least(rounding);
    verify_nonsingular(blocks, &pair, &window).err()
}

/// See [`Blocks::verify_nonsingular`]: asked at many places, and seldom.
#[inline(never)]
fn verify_nonsingular<B: Blocks>(
    blocks: &B,
    pair: &Pair<'_, B>,
    window: &TimeWindow<B::Scalar>,
) -> Result<(), u16> {
    blocks.verify_nonsingular(pair, window)
}

/// The widest window about two frames, at most so many steps, of which something can be shown; `None` where no window beyond the frames
/// is one. Afterwards `steps` is how many steps to begin with next.
fn farthest<T: Real>(
    steps: &mut T,
    step: T,
    mut shows: impl FnMut(&TimeWindow<T>) -> bool,
) -> Option<TimeWindow<T>> {
    let [_, least, most] = AHEAD.map(T::from_f64);
    let mut tried = *steps;
    while tried >= least && step.abs() > T::ZERO {
        let window = TimeWindow::around(step, tried);
        if shows(&window) {
            let further = tried * T::from_f64(GROWTH);
            *steps = if further < most { further } else { most };
            return Some(window);
        }
        tried *= T::from_f64(SHRINKING);
    }
    // Where it could not look beyond the frames at all, some frames go by before it tries again.
    let is_pausing = *steps < least;
    *steps = match is_pausing {
        true => tried * T::from_f64(GROWTH),
        false => tried,
    };
    None
}

impl<T: Real, I: Signals<T>, U: Clone> Default for Guard<T, I, U> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Real, I: Signals<T>, U> Window<T, I, U> {
    /// The window about these frames.
    fn new<B>(pair: &Pair<'_, B>, window: TimeWindow<T>, enclosures: U) -> Self
    where
        B: Blocks<Scalar = T, Inputs = I, PathEnclosures = U>,
    {
        Self {
            window,
            t: pair.conditions.t,
            inputs: [pair.before.clone(), pair.conditions.inputs.clone()],
            enclosures,
        }
    }

    /// Whether a frame is in it, and the way to it.
    #[inline]
    fn holds<B>(&self, blocks: &B, pair: &Pair<'_, B>) -> bool
    where
        B: Blocks<Scalar = T, Inputs = I, PathEnclosures = U>,
    {
        let since = pair.conditions.t - self.t;
        since.abs() <= self.window.time
            && self.holds_signals(pair, since)
            && blocks.is_within(pair.at, &self.enclosures, since / self.window.step)
    }

    #[inline]
    fn holds_signals<B>(&self, pair: &Pair<'_, B>, since: T) -> bool
    where
        B: Blocks<Scalar = T, Inputs = I>,
    {
        let count = pair.before.count();
        if count == 0 {
            return true;
        }
        let h = pair.conditions.t - B::time(pair.last);
        let signal = |inputs: &I, index| inputs.signal(index).unwrap_or(Signal::constant(T::ZERO));
        let [before, now] = &self.inputs;
        (0..count).all(|index| {
            let line = [&signal(before, index), &signal(now, index)];
            let way = [
                &signal(pair.before, index),
                &signal(pair.conditions.inputs, index),
            ];
            self.window.holds_signal(line, way, h, since)
        })
    }
}
