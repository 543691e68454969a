//! Path guard: verifies that frames continue one smooth path.
//!
//! The blocks verify a whole [`TimeWindow`] about two frames. Closed forms cost a part of a frame, all equations
//! together some frames. A [`Guard`] therefore looks ahead of the frames as far as it can. A frame in such a window, as
//! nearly all are for short steps, only has to lie in its enclosures.

use crate::block::Start;
use crate::blocks::{Blocks, Conditions, Values};
use crate::closed_form::failed;
use crate::failure::{Failure, FailureKind};
use crate::math::Real;
use crate::signal::Signal;
use crate::time_window::TimeWindow;

/// Number of steps of the first look-ahead.
pub(crate) const FIRST_STEPS: f64 = 16.0;

/// Number of steps of the look-ahead at most.
const MOST_STEPS: f64 = 1024.0;

/// Number of steps below which the guard does not look ahead.
pub(crate) const LEAST_STEPS: f64 = 2.0;

/// Factor of the look-ahead after a success.
const GROWTH: f64 = 1.125;

/// Factor of the look-ahead after a failure.
pub(crate) const SHRINKING: f64 = 0.625;

/// Rounding that must not make a frame singular: links that enclose less than some 6e-4 rad leave accelerations few
/// digits.
pub(crate) const WEAK: f64 = 1.0 / (1u32 << 26) as f64;

/// Multiple of that rounding for frames beyond which a window is sought.
const LOOK_AHEAD_FACTOR: f64 = 64.0;

/// State of the path's verification.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Guard<T, I, U> {
    window: Option<Window<T, I, U>>,
    /// Number of steps of the next look-ahead.
    steps: T,
    /// Number of steps of the next look-ahead by closed forms alone.
    steps_of_closed_forms: T,
}

/// Window of time in which all frames found lie on one path.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Window<T, I, U> {
    window: TimeWindow<T>,
    /// Time of the second frame (s).
    t: T,
    /// Inputs of both frames.
    inputs: [I; 2],
    enclosures: U,
}

/// Two frames with the conditions of their solution.
pub struct Pair<'a, B: Blocks> {
    /// Second frame.
    pub at: &'a B::Frame,
    /// First frame.
    pub last: &'a B::Frame,
    /// Inputs of the first frame.
    pub before: &'a B::Inputs,
    /// Conditions with which the second frame was solved.
    pub conditions: &'a Conditions<'a, B::Scalar, B::Parameters, B::Inputs>,
}

impl<T: Real, I: Values<Signal<T>>, U: Clone> Guard<T, I, U> {
    /// Returns a guard without a verified window.
    pub fn new() -> Self {
        Self {
            window: None,
            steps: T::from_f64(FIRST_STEPS),
            steps_of_closed_forms: T::from_f64(FIRST_STEPS),
        }
    }

    /// Forgets the path: the next frame begins another one.
    pub fn forget(&mut self) {
        self.window = None;
    }

    /// Forgets the path and how far the guard has looked ahead; some frames pass before it does so again.
    pub(crate) fn restart(&mut self) {
        self.window = None;
        self.steps = T::ONE;
        self.steps_of_closed_forms = T::ONE;
    }

    /// Middle and half length (s) of the verified window; `None` if there is none.
    pub(crate) fn verified(&self) -> Option<[T; 2]> {
        let window = self.window.as_ref()?;
        Some([window.t, window.window.time])
    }

    /// True if inputs that change between two times stay in the verified window.
    #[inline]
    pub(crate) fn continues(&self, inputs: [&I; 2], times: [T; 2]) -> bool {
        let window = self.window.as_ref();
        window.is_some_and(|window| window.holds_signals(inputs, times))
    }

    /// Requires that a frame lies on the path of the last one; the first frame of a path does. A nearly singular frame
    /// is refused unless it `may_be_weak`.
    ///
    /// # Errors
    /// Returns [`FailureKind::StepTooLarge`] with the block if that cannot be verified.
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

    /// Verifies the path between two frames and beyond: first by closed forms in sequence, which costs little, then by
    /// all equations together.
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
        // Near a singular pose, frames beyond may be nearer to it.
        let is_far = !blocks.is_closed() || weak(blocks, pair, WEAK * LOOK_AHEAD_FACTOR).is_none();
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

/// First block that closed forms show to be nearly singular in a frame; `None` if there is none.
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

/// First block that such a rounding might make singular in the second of two frames; `None` if there is none.
fn weak<B: Blocks>(blocks: &B, pair: &Pair<'_, B>, rounding: f64) -> Option<u16> {
    let pair = Pair {
        last: pair.at,
        before: pair.conditions.inputs,
        ..*pair
    };
    let window = TimeWindow::between(B::Scalar::ZERO).at_least(rounding);
    verify_nonsingular(blocks, &pair, &window).err()
}

/// Calls [`Blocks::verify_nonsingular`]; not inlined, because there are many calls and they are rare.
#[inline(never)]
fn verify_nonsingular<B: Blocks>(
    blocks: &B,
    pair: &Pair<'_, B>,
    window: &TimeWindow<B::Scalar>,
) -> Result<(), u16> {
    blocks.verify_nonsingular(pair, window)
}

/// Widest verified window about two frames, of at most so many steps; `None` if no window beyond the frames can be
/// verified. Afterwards `steps` is the number to begin with next.
fn farthest<T: Real>(
    steps: &mut T,
    step: T,
    mut shows: impl FnMut(&TimeWindow<T>) -> bool,
) -> Option<TimeWindow<T>> {
    let least = T::from_f64(LEAST_STEPS);
    let mut tried = *steps;
    while tried >= least && step.abs() > T::ZERO {
        let window = TimeWindow::around(step, tried);
        if shows(&window) {
            *steps = further(tried);
            return Some(window);
        }
        tried *= T::from_f64(SHRINKING);
    }
    // After a look-ahead that failed altogether, some frames pass before the next attempt.
    let is_pausing = *steps < least;
    *steps = match is_pausing {
        true => tried * T::from_f64(GROWTH),
        false => tried,
    };
    None
}

/// Number of steps of the look-ahead after one that succeeded.
pub(crate) fn further<T: Real>(steps: T) -> T {
    let [further, most] = [steps * T::from_f64(GROWTH), T::from_f64(MOST_STEPS)];
    if further < most { further } else { most }
}

impl<T: Real, I: Values<Signal<T>>, U: Clone> Default for Guard<T, I, U> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Real, I: Values<Signal<T>>, U> Window<T, I, U> {
    /// Returns the window about these frames.
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

    /// True if a frame and the path to it are in the window.
    #[inline]
    fn holds<B>(&self, blocks: &B, pair: &Pair<'_, B>) -> bool
    where
        B: Blocks<Scalar = T, Inputs = I, PathEnclosures = U>,
    {
        let since = pair.conditions.t - self.t;
        since.abs() <= self.window.time
            && self.holds_signals(
                [pair.before, pair.conditions.inputs],
                [B::time(pair.last), pair.conditions.t],
            )
            && blocks.is_within(pair.at, &self.enclosures, since / self.window.step)
    }

    #[inline]
    fn holds_signals(&self, [last, next]: [&I; 2], [before, t]: [T; 2]) -> bool {
        let count = last.count();
        if count == 0 {
            return true;
        }
        let (h, since) = (t - before, t - self.t);
        let signal = |inputs: &I, index| inputs.value(index).unwrap_or(Signal::constant(T::ZERO));
        let [before, now] = &self.inputs;
        (0..count).all(|index| {
            let line = [&signal(before, index), &signal(now, index)];
            let way = [&signal(last, index), &signal(next, index)];
            self.window.holds_signal(line, way, h, since)
        })
    }
}
