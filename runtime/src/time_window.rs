//! Two frames → a [`TimeWindow`] of time that holds both, and how far signals and what is found go in it.
//!
//! Every value is bounded by its distance from a straight line through both frames. The module does not know equations.

use crate::math::Real;
use crate::signal::Signal;

/// A window of time about two frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeWindow<T = f64> {
    /// The time from the first frame to the second one, in s.
    pub step: T,
    /// How far the time goes from the second frame, in s.
    pub time: T,
    /// The same in steps: 1 where the window ends with the frames.
    pub steps: T,
    /// The remainder of linear interpolation over the window, for a second derivative of 1 and a way of 1.
    pub remainder: T,
    /// 1 where the window goes beyond the frames, and as far before them, or else 0.
    pub beyond: T,
    /// How far rounding leaves what frames hold from what it stands for over the window, as a part of its size.
    pub rounding: T,
}

impl<T: Real> TimeWindow<T> {
    /// From one frame to the next one, which is the time `h` (s) away: ½ x (1 − x) is at most ⅛ there.
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

    /// `steps` (at least 1) steps of `h` (s) before the second frame and after it: ½ x (x + 1) is largest at their end.
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

    /// The same window with at least this rounding.
    #[must_use]
    pub fn at_least(self, rounding: f64) -> Self {
        Self {
            rounding: self.rounding.max(T::from_f64(rounding)),
            ..self
        }
    }

    /// How far a signal goes from its second value, and from the straight line, on the way that [`Signal::towards`] describes; beyond
    /// the frames as far as [`TimeWindow::holds_signal`] lets it. Where no time passes, it goes straight.
    pub fn signal(&self, before: &Signal<T>, now: &Signal<T>) -> [T; 2] {
        let moved = (now.value - before.value).abs();
        let remainder = match self.step == T::ZERO {
            true => T::ZERO,
            false => remainder_of_signal(self.step, before, now),
        };
        let deviation = remainder + self.beyond * self.allowance(moved);
        [self.steps * moved + deviation, deviation]
    }

    /// Whether a signal that goes from `last` to `next` in the time `h` (s) stays as near to the straight line from `before` to `now`
    /// as [`TimeWindow::signal`] supposes; the line ends `since` (s) before `next`.
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

    /// How far a signal that moves so far in one step may be from the straight line beyond the frames.
    fn allowance(&self, moved: T) -> T {
        T::from_f64(0.25) * self.steps * moved
    }
}

/// How far rounding leaves what frames hold, and what differences of two of them lead to that are multiplied by `steps`.
fn rounding<T: Real>(steps: T) -> T {
    T::EPSILON * (T::from_f64(LEFT_BY_ROUNDING) + T::from_f64(OF_DIFFERENCES) * steps)
}

/// How far a signal is from a straight line between two values that are `h` (s) apart.
///
/// The functions that rates and accelerations at the ends are multiplied by in the polynomial of the fifth degree are at most
/// 0.2 and 0.018 in size.
fn remainder_of_signal<T: Real>(h: T, before: &Signal<T>, now: &Signal<T>) -> T {
    let moved = now.value - before.value;
    let rate = |it: &Signal<T>| (it.rate * h - moved).abs();
    let acceleration = |it: &Signal<T>| (it.acceleration * h * h).abs();
    T::from_f64(0.2) * (rate(before) + rate(now))
        + T::from_f64(0.018) * (acceleration(before) + acceleration(now))
}

/// A straight line through the values of two frames, and how far a value may be from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathEnclosure<T = f64> {
    /// The value in the second frame.
    pub value: T,
    /// How far it has moved in one step.
    pub moved: T,
    /// How far it may be from the line.
    pub deviation: T,
}

impl<T: Real> PathEnclosure<T> {
    /// The enclosure of what does not move.
    pub const STILL: Self = Self {
        value: T::ZERO,
        moved: T::ZERO,
        deviation: T::ZERO,
    };

    /// The enclosure about a value.
    pub fn new(now: T, before: T, deviation: T) -> Self {
        Self {
            value: now,
            moved: now - before,
            deviation,
        }
    }

    /// Whether a value is in the enclosure so many steps after the second frame, but for rounding.
    pub fn holds(&self, value: T, steps: T) -> bool {
        let rounding = T::from_f64(ROUNDING) * T::EPSILON * (T::ONE + value.abs());
        (value - self.value - self.moved * steps).abs() <= self.deviation + rounding
    }
}

/// The multiple of ε by which a value that Newton-Raphson finds may be off.
const ROUNDING: f64 = 65536.0;

/// The multiple of ε by which a solved equation may be off zero: a few roundings of angles of some turns.
pub(crate) const LEFT_BY_ROUNDING: f64 = 64.0;

/// The multiple of ε by which the difference of two values may be off, as a part of their size.
const OF_DIFFERENCES: f64 = 32.0;

/// Blames a block where a value is negative, or NaN.
///
/// # Errors
/// The block.
#[inline]
pub fn required<T: Real>(value: T, block: u16) -> Result<(), u16> {
    match value >= T::ZERO {
        true => Ok(()),
        false => Err(block),
    }
}
