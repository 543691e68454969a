//! Bounds signals and unknowns in a window of time about two frames.
//!
//! Every value is bounded by its deviation from the chord through both frames.

use crate::math::Real;
use crate::signal::Signal;

/// Window of time about two frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeWindow<T = f64> {
    /// Time from the first frame to the second one (s).
    pub step: T,
    /// Largest distance of a time in the window from the second frame (s).
    pub time: T,
    /// Same distance in steps: 1 if the window ends with the frames.
    pub steps: T,
    /// Remainder of linear interpolation over the window, for a second derivative of 1 and a change of 1.
    pub remainder: T,
    /// 1 if the window extends beyond the frames, and as far before them; otherwise 0.
    pub beyond: T,
    /// Bound on the rounding of values in frames over the window, relative to their magnitude.
    pub rounding: T,
}

impl<T: Real> TimeWindow<T> {
    /// Returns the window from one frame to the next one, `h` (s) later: ½ x (1 − x) is at most ⅛ there.
    pub fn between(h: T) -> Self {
        Self {
            step: h,
            time: h.abs(),
            steps: T::ONE,
            remainder: T::from_f64(0.125),
            beyond: T::ZERO,
            rounding: rounding(T::ONE),
        }
    }

    /// Returns the window of `steps` (at least 1) steps of `h` (s) on both sides of the second frame: ½ x (x + 1) is
    /// largest at its end.
    pub fn around(h: T, steps: T) -> Self {
        Self {
            step: h,
            time: h.abs() * steps,
            steps,
            remainder: T::HALF + T::HALF / steps,
            beyond: T::ONE,
            rounding: rounding(steps),
        }
    }

    /// Returns this window with at least the given rounding.
    #[must_use]
    pub fn at_least(self, rounding: f64) -> Self {
        Self {
            rounding: self.rounding.max(T::from_f64(rounding)),
            ..self
        }
    }

    /// Returns bounds on a signal's change from its second value and on its deviation from the chord, on the path of
    /// [`Signal::towards`]. Beyond the frames, [`TimeWindow::holds_signal`] limits the deviation. If no time passes,
    /// the signal follows the chord.
    pub fn signal(&self, before: &Signal<T>, now: &Signal<T>) -> [T; 2] {
        let moved = (now.value - before.value).abs();
        let remainder = match self.step == T::ZERO {
            true => T::ZERO,
            false => remainder_of_signal(self.step, before, now),
        };
        let deviation = remainder + self.beyond * self.allowance(moved);
        [self.steps * moved + deviation, deviation]
    }

    /// True if a signal that goes from `last` to `next` in the time `h` (s) stays as near to the chord from `before` to
    /// `now` as [`TimeWindow::signal`] assumes. The chord ends `since` (s) before `next`.
    pub fn holds_signal(
        &self,
        [before, now]: [&Signal<T>; 2],
        [last, next]: [&Signal<T>; 2],
        h: T,
        since: T,
    ) -> bool {
        let moved = now.value - before.value;
        let line = |since: T| now.value + moved * (since / self.step);
        let off = |signal: &Signal<T>, since: T| (signal.value - line(since)).abs();
        let allowance = T::HALF * self.allowance(moved.abs());
        off(last, since - h) <= allowance
            && off(next, since) <= allowance
            && remainder_of_signal(h, last, next) <= allowance
    }

    /// Deviation from the chord that a signal with this change in one step may have beyond the frames.
    fn allowance(&self, moved: T) -> T {
        T::from_f64(0.25) * self.steps * moved
    }
}

/// Bound on the rounding of values in frames and of their differences multiplied by `steps`.
fn rounding<T: Real>(steps: T) -> T {
    T::EPSILON * (T::from_f64(LEFT_BY_ROUNDING) + T::from_f64(OF_DIFFERENCES) * steps)
}

/// Bound on the deviation of a signal from the chord between two values that are `h` (s) apart.
///
/// In the polynomial of the fifth degree, the factors of the rates and accelerations at the ends are at most 0.2 and
/// 0.018 in magnitude.
fn remainder_of_signal<T: Real>(h: T, before: &Signal<T>, now: &Signal<T>) -> T {
    let moved = now.value - before.value;
    let rate = |it: &Signal<T>| (it.rate * h - moved).abs();
    let acceleration = |it: &Signal<T>| (it.acceleration * h * h).abs();
    T::from_f64(0.2) * (rate(before) + rate(now))
        + T::from_f64(0.018) * (acceleration(before) + acceleration(now))
}

/// Chord through the values of two frames, with a bound on the deviation from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathEnclosure<T = f64> {
    /// Value in the second frame.
    pub value: T,
    /// Change in one step.
    pub moved: T,
    /// Bound on the deviation from the chord.
    pub deviation: T,
}

impl<T: Real> PathEnclosure<T> {
    /// Enclosure of a value that does not move.
    pub const ZERO: Self = Self {
        value: T::ZERO,
        moved: T::ZERO,
        deviation: T::ZERO,
    };

    /// Returns the enclosure about a value.
    pub fn new(now: T, before: T, deviation: T) -> Self {
        Self {
            value: now,
            moved: now - before,
            deviation,
        }
    }

    /// True if a value is in the enclosure so many steps after the second frame, up to rounding.
    pub fn holds(&self, value: T, steps: T) -> bool {
        let rounding = T::from_f64(ROUNDING) * T::EPSILON * (T::ONE + value.abs());
        (value - self.value - self.moved * steps).abs() <= self.deviation + rounding
    }
}

/// Multiple of ε by which a value of Newton-Raphson may be off.
const ROUNDING: f64 = 65536.0;

/// Multiple of ε by which a solved equation may be off zero: a few roundings of angles of some turns.
pub(crate) const LEFT_BY_ROUNDING: f64 = 64.0;

/// Multiple of ε by which the difference of two values may be off, relative to their magnitude.
const OF_DIFFERENCES: f64 = 32.0;

/// Blames a block if a value is negative or NaN.
///
/// # Errors
/// Returns the block.
#[inline]
pub fn required<T: Real>(value: T, block: u16) -> Result<(), u16> {
    match value >= T::ZERO {
        true => Ok(()),
        false => Err(block),
    }
}
