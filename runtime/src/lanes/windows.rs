//! Windows of time in which the paths of all lanes are verified.
//!
//! A lane needs a first window from its own guard. Closed forms in sequence then extend the windows of all lanes together, as soon as the
//! first of them ends: verifying all lanes costs little more than verifying one. Windows only save verifications: the frames that they admit are
//! those that a mechanism alone admits, by windows of its own.

use super::{Lanes, Mask};
use crate::guard::{FIRST_STEPS, LEAST_STEPS, SHRINKING, WEAK, further};
use crate::math::Real;
use crate::time_window::TimeWindow;

/// Windows of N lanes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Windows<T, const N: usize> {
    /// Middles (s).
    middles: Lanes<T, N>,
    /// Half lengths (s); negative for a lane without a window.
    lengths: Lanes<T, N>,
    /// Numbers of steps of the next look-ahead.
    steps: Lanes<T, N>,
}

impl<T: Real, const N: usize> Windows<T, N> {
    /// Returns lanes without windows.
    pub fn new() -> Self {
        Self {
            middles: Lanes::splat(T::ZERO),
            lengths: Lanes::splat(-T::ONE),
            steps: Lanes::splat(T::from_f64(FIRST_STEPS)),
        }
    }

    /// Changes the window of a lane to one of this middle and half length (s), or to none.
    pub fn set(&mut self, lane: usize, window: Option<[T; 2]>) {
        let [middle, length] = window.unwrap_or([T::ZERO, -T::ONE]);
        self.middles.set(lane, middle);
        self.lengths.set(lane, length);
    }

    /// Returns the lanes whose windows hold a time (s) each.
    #[inline(always)]
    pub fn hold(&self, times: &[T; N]) -> Mask<N> {
        Mask::of(|lane| (times[lane] - self.middles.0[lane]).abs() <= self.lengths.0[lane])
    }

    /// Extends windows beyond the second of two times (s) of each lane, as far as `verify` verifies them. Lanes that are `due` try shorter
    /// windows after a failure; other lanes that have windows try once.
    #[inline(always)]
    pub fn extend(
        &mut self,
        [last, times]: [&[T; N]; 2],
        due: Mask<N>,
        mut verify: impl FnMut(&TimeWindow<Lanes<T, N>>) -> Mask<N>,
    ) {
        let least = T::from_f64(LEAST_STEPS);
        let moves = |lane: usize| {
            let has_window = self.lengths.0[lane] >= T::ZERO;
            has_window && (times[lane] - last[lane]).abs() > T::ZERO
        };
        let mut open = Mask::of(moves);
        let mut tried = self.steps;
        let mut due = due & open;
        for lane in due.lanes().filter(|&lane| tried.0[lane] < least) {
            // After a look-ahead that failed altogether, some frames pass before the next attempt.
            self.steps.0[lane] = further(tried.0[lane]);
        }
        due = due & Mask::of(|lane| tried.0[lane] >= least);
        while !due.is_empty() {
            let window = |lane: usize| {
                let steps = tried.0[lane].max(T::ONE);
                TimeWindow::around(times[lane] - last[lane], steps).at_least(WEAK)
            };
            let verified = verify(&in_lanes(window)) & open;
            for lane in verified.lanes() {
                self.middles.0[lane] = times[lane];
                self.lengths.0[lane] = window(lane).time;
                self.steps.0[lane] = further(tried.0[lane]);
            }
            due = due & !verified;
            for lane in due.lanes() {
                tried.0[lane] *= T::from_f64(SHRINKING);
                self.steps.0[lane] = tried.0[lane];
            }
            due = due & Mask::of(|lane| tried.0[lane] >= least);
            open = due;
        }
    }
}

/// Returns windows of all lanes.
#[inline(always)]
fn in_lanes<T: Real, const N: usize>(
    window: impl Fn(usize) -> TimeWindow<T>,
) -> TimeWindow<Lanes<T, N>> {
    let zero = Lanes::splat(T::ZERO);
    let mut lanes = TimeWindow {
        step: zero,
        time: zero,
        steps: zero,
        remainder: zero,
        beyond: zero,
        rounding: zero,
    };
    for lane in 0..N {
        let window = window(lane);
        lanes.step.0[lane] = window.step;
        lanes.time.0[lane] = window.time;
        lanes.steps.0[lane] = window.steps;
        lanes.remainder.0[lane] = window.remainder;
        lanes.beyond.0[lane] = window.beyond;
        lanes.rounding.0[lane] = window.rounding;
    }
    lanes
}
