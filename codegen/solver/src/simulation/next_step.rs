//! Takes the next step of a motion, or crosses a singular pose.
//!
//! A step ends before the pose in which constraints are expected to lose rank, so that none is skipped. A step counts if the energy at
//! its end balances.

use linkwright::math::Real;

use super::crossing::Crossing;
use super::right_side::RightSide;
use super::solved::Solved;
use super::{RETREAT, Segment, Simulation, Stop};
use crate::trajectory::END_PRECISION;

/// Largest part of the time to an expected loss of rank that one step takes.
const APPROACH: f64 = 0.6;

/// Distance from the loss of rank at which a crossing is tried, in cubic roots of a rounding error in tolerances, and its bounds.
const CROSSING_DISTANCE: f64 = 6.0;
const CROSSING_BOUNDS: [f64; 2] = [0.01, 0.3];

/// Factor by which the distance must fall before a crossing is tried again.
const CLOSER: f64 = 0.3;

/// Smallest distance of Φ_q from the loss of rank; below it the null space has no digits.
const LOST: f64 = 1e-7;

/// Stretch of a chart's coordinate beyond which another chart is better.
const STRETCHED: f64 = 1.05;

impl Simulation {
    /// Takes a step, or crosses a singular pose, from the reached frame.
    pub(super) fn go_on(&mut self) -> Result<(), Stop> {
        let t = self.reached.t();
        if let Some(Segment::Step(step)) = &self.segment {
            let (state, slope) = (step.end().to_vec(), step.end_rates().to_vec());
            let count = self.right_side.chart.dimension();
            let work = state[2 * count];
            let solved = self.right_side.solve(t, &state)?;
            self.right_side.evaluations -= 1;
            let is_other = self.right_side.chart.is_straight != self.method.is_implicit();
            match solved.stretch > STRETCHED || is_other {
                true => self.begin(&solved, work)?,
                false => {
                    (self.state, self.slope) = (state, slope);
                    let RightSide {
                        equations, chart, ..
                    } = &mut self.right_side;
                    chart.follow(equations, &solved);
                }
            }
        }
        let measure = self.right_side.chart.measure;
        let rate = self
            .right_side
            .chart
            .measure_rate(&self.right_side.equations);
        let mut longest = f64::INFINITY;
        if rate < 0.0 {
            let ahead = measure / -rate;
            longest = APPROACH * ahead;
            if measure <= self.near() && measure <= CLOSER * self.tried {
                if self.cross(2.0 * ahead)? {
                    return Ok(());
                }
                self.tried = measure;
            }
        } else if measure > self.near() {
            self.tried = f64::INFINITY;
        }
        if measure <= LOST {
            return Err(Stop::LosesRank { t });
        }
        self.take_step(longest)
    }

    /// Returns the distance from the loss of rank at which the null space has as many digits as the tolerances require.
    fn near(&self) -> f64 {
        let rounding = f64::EPSILON / self.options.tolerances.relative;
        let near = CROSSING_DISTANCE * Real::powf(rounding, 1.0 / 3.0);
        near.clamp(CROSSING_BOUNDS[0], CROSSING_BOUNDS[1])
    }

    /// Crosses a singular pose that is expected in the middle of the next `length` seconds; returns true if there is a smooth continuation.
    fn cross(&mut self, length: f64) -> Result<bool, Stop> {
        let (work, power) = (
            self.state[self.state.len() - 1],
            self.slope[self.slope.len() - 1],
        );
        let tolerances = self.options.tolerances;
        let right_side = &mut self.right_side;
        let attempt =
            Crossing::attempt(right_side, &self.reached, work, power, length, &tolerances);
        let Some(crossing) = attempt else {
            return Ok(false);
        };
        let (solved, work) = crossing.end(right_side)?;
        let passed = [crossing.from, crossing.to];
        self.begin(&solved, work)?;
        self.weigh(&solved, work)?;
        self.passed.push(passed);
        self.segment = Some(Segment::Crossing(Box::new(crossing)));
        self.reached = solved.instant;
        self.steps += 1;
        Ok(true)
    }

    /// Takes a step of at most this length (s).
    fn take_step(&mut self, longest: f64) -> Result<(), Stop> {
        let from = self.reached.t();
        let proposed = self.length;
        self.length = self.length.min(longest);
        let is_bounded = self.length < proposed;
        let mut held = false;
        let mut reason = None;
        let mut differences = None;
        loop {
            let is_last = from + self.length >= self.end;
            let to = if is_last {
                self.end
            } else {
                from + self.length
            };
            if to - from <= END_PRECISION * from.abs().max(1.0) && !is_last || to <= from {
                return Err(reason.unwrap_or(Stop::TooShort { t: from }));
            }
            let (tolerances, range) = (&self.options.tolerances, [from, to]);
            let tried = self.method.attempt(
                &mut self.right_side,
                range,
                [&self.state, &self.slope],
                &mut differences,
                tolerances,
            );
            let finished = tried.and_then(|mut step| {
                if step.error() <= 1.0 {
                    step.finish(&mut self.right_side)?;
                }
                Ok(step)
            });
            match finished {
                Ok(step) => {
                    let is_taken = step.error() <= 1.0;
                    self.length = step.next_length(held || !is_taken);
                    if is_taken {
                        if is_bounded {
                            self.length = self.length.max(proposed);
                        }
                        let state = step.end();
                        let solved = self.right_side.solve(to, state)?;
                        self.right_side.evaluations -= 1;
                        let work = state[state.len() - 1];
                        self.weigh(&solved, work)?;
                        self.bound_rounding(to - from, &solved)?;
                        self.steps += 1;
                        self.implicit += u64::from(self.method.is_implicit());
                        self.method
                            .see(&step, &mut self.right_side, differences.as_ref());
                        self.segment = Some(Segment::Step(Box::new(step)));
                        self.reached = solved.instant;
                        return Ok(());
                    }
                }
                Err(stop) => {
                    self.length = RETREAT * (to - from);
                    reason = Some(stop);
                }
            }
            self.rejected += 1;
            held = true;
        }
    }

    /// Compares the rounding of the steps beside a pose in which constraints lose rank with the tolerances.
    fn bound_rounding(&mut self, length: f64, solved: &Solved) -> Result<(), Stop> {
        let rates = self.right_side.level(&solved.instant, 1);
        let rate = rates.iter().fold(0.0_f64, |most, it| most.max(it.abs()));
        let ends = [self.right_side.chart.measure, solved.measure];
        let tolerances = &self.options.tolerances;
        match self.rounding.see(length, rate, ends, tolerances) {
            true => Ok(()),
            false => Err(Stop::Rounded {
                t: solved.instant.t(),
            }),
        }
    }

    /// Compares the energy of a frame with the work.
    fn weigh(&mut self, solved: &Solved, work: f64) -> Result<(), Stop> {
        let rates = self.right_side.level(&solved.instant, 1);
        let rate = rates.iter().fold(0.0, |size, it| Real::hypot(size, *it));
        match self
            .balance
            .see(solved.energies, work, rate, &self.options.tolerances)
        {
            true => Ok(()),
            false => Err(Stop::Unbalanced {
                t: solved.instant.t(),
                drift: self.balance.drift,
            }),
        }
    }
}
