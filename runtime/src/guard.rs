//! The frames of a mechanism, one after another → whether each lies on the smooth path of the last one.
//!
//! The blocks can show that for a whole [`Span`] of time about two frames, at the cost of about a frame. So a [`Guard`] looks beyond the
//! frames as far as it can, and every frame that lies in such a span, as nearly all do where steps are short, needs no more than to be
//! found there. The module does not know equations.

use crate::block::Start;
use crate::blocks::{Blocks, Conditions, Signals};
use crate::closed_form::failed;
use crate::failure::{Failure, FailureKind};
use crate::math::Real;
use crate::signal::Signal;
use crate::span::Span;

/// How many steps a guard looks ahead at first, at least and at most. It does not look ahead where it would be less.
const AHEAD: [f64; 3] = [16.0, 2.0, 1024.0];

/// By how much it looks farther after a success, and less far after a failure.
const GROWTH: f64 = 1.125;
const SHRINKING: f64 = 0.625;

/// What is known of the path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Guard<T, I, U> {
    window: Option<Window<T, I, U>>,
    /// How many steps it looks ahead next.
    stretch: T,
}

/// A span of time in which everything that is found lies on one path.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Window<T, I, U> {
    span: Span<T>,
    /// The time of the second frame (s).
    t: T,
    /// The inputs of both frames.
    inputs: [I; 2],
    tubes: U,
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
            stretch: T::from_f64(AHEAD[0]),
        }
    }

    /// Forgets the path: the next frame is the first one of another.
    pub fn forget(&mut self) {
        self.window = None;
    }

    /// Asks that a frame lies on the path of the last one. The first frame of a path lies on it.
    ///
    /// # Errors
    /// [`FailureKind::StepTooLarge`] where that cannot be shown, with the block.
    #[inline]
    pub fn admit<B>(&mut self, blocks: &B, pair: &Pair<'_, B>) -> Result<(), Failure<T>>
    where
        B: Blocks<Scalar = T, Inputs = I, Tubes = U>,
    {
        if !blocks.is_guarded() || pair.conditions.start == Start::Estimate {
            return Ok(());
        }
        match &self.window {
            Some(window) if window.holds(blocks, pair) => Ok(()),
            _ => self.look(blocks, pair),
        }
    }

    /// Looks at the path between two frames, and beyond.
    #[cold]
    fn look<B>(&mut self, blocks: &B, pair: &Pair<'_, B>) -> Result<(), Failure<T>>
    where
        B: Blocks<Scalar = T, Inputs = I, Tubes = U>,
    {
        let t = pair.conditions.t;
        let step = t - B::time(pair.last);
        let [_, least, most] = AHEAD.map(T::from_f64);
        self.window = None;
        let mut tubes = blocks.tubes();
        let mut stretch = self.stretch;
        while stretch >= least && step.abs() > T::ZERO {
            let span = Span::around(step, stretch);
            if blocks.keeps_to_path(pair, &span, &mut tubes).is_ok() {
                let inputs = [pair.before.clone(), pair.conditions.inputs.clone()];
                self.window = Some(Window {
                    span,
                    t,
                    inputs,
                    tubes,
                });
                let further = stretch * T::from_f64(GROWTH);
                self.stretch = if further < most { further } else { most };
                return Ok(());
            }
            stretch *= T::from_f64(SHRINKING);
        }
        // Where it could not look beyond the frames at all, some frames go by before it tries again.
        let is_pausing = self.stretch < least;
        self.stretch = match is_pausing {
            true => stretch * T::from_f64(GROWTH),
            false => stretch,
        };
        let between = Span::between(step);
        let kept = blocks.keeps_to_path(pair, &between, &mut tubes);
        kept.map_err(|block| failed(FailureKind::StepTooLarge, t, block))
    }
}

impl<T: Real, I: Signals<T>, U: Clone> Default for Guard<T, I, U> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Real, I: Signals<T>, U> Window<T, I, U> {
    /// Whether a frame is in it, and the way to it.
    #[inline]
    fn holds<B>(&self, blocks: &B, pair: &Pair<'_, B>) -> bool
    where
        B: Blocks<Scalar = T, Inputs = I, Tubes = U>,
    {
        let since = pair.conditions.t - self.t;
        since.abs() <= self.span.time
            && self.holds_signals(pair, since)
            && blocks.is_within(pair.at, &self.tubes, since / self.span.step)
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
            self.span.holds_signal(line, way, h, since)
        })
    }
}
