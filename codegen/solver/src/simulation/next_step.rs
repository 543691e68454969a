//! *A motion at a frame* → *its next step, or its way over a singular pose*.
//!
//! A step ends before the pose in which constraints are expected to lose rank, so that none is jumped over unseen; it counts once the energy
//! is in balance at its end.

use super::crossing::Crossing;
use super::right_side::RightSide;
use super::solved::Solved;
use super::{RETREAT, Segment, Simulation, Stop};
use crate::trajectory::END;

/// How much of the time to a pose in which constraints are expected to lose rank a step takes at most.
const APPROACH: f64 = 0.6;

/// How far Φ_q is from losing rank where a crossing is tried, in cubic roots of a rounding error in tolerances, and its bounds.
const NEAR: f64 = 6.0;
const NEAREST: [f64; 2] = [0.01, 0.3];

/// To which part Φ_q must come closer before a crossing is tried again.
const CLOSER: f64 = 0.3;

/// How close to losing rank Φ_q may be at all: the null space has no digits there.
const LOST: f64 = 1e-7;

/// The stretch of a chart's coordinate from which on another chart is better.
const STRETCHED: f64 = 1.05;

impl Simulation {
    /// Takes a step, or crosses a singular pose, from the frame that was reached.
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

    /// How close to losing rank Φ_q is where its null space has as many digits as the tolerances ask for.
    fn near(&self) -> f64 {
        let near = NEAR * (f64::EPSILON / self.options.tolerances.relative).cbrt();
        near.clamp(NEAREST[0], NEAREST[1])
    }

    /// Crosses a singular pose that is expected in the middle of the next so many seconds; whether there is a smooth way through.
    fn cross(&mut self, length: f64) -> Result<bool, Stop> {
        let (work, power) = (
            self.state[self.state.len() - 1],
            self.slope[self.slope.len() - 1],
        );
        let tolerances = self.options.tolerances;
        let right_side = &mut self.right_side;
        let found = Crossing::attempt(right_side, &self.reached, work, power, length, &tolerances);
        let Some(crossing) = found else {
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

    /// Takes a step of at most this length.
    fn take_step(&mut self, longest: f64) -> Result<(), Stop> {
        let from = self.reached.t();
        let wanted = self.length;
        self.length = self.length.min(longest);
        let is_bounded = self.length < wanted;
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
            if to - from <= END * from.abs().max(1.0) && !is_last || to <= from {
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
                            self.length = self.length.max(wanted);
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

    /// Holds the rounding of the steps beside a pose in which constraints lose rank against the tolerances.
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

    /// Holds the energy of a frame against the work.
    fn weigh(&mut self, solved: &Solved, work: f64) -> Result<(), Stop> {
        let rates = self.right_side.level(&solved.instant, 1);
        let rate = rates.iter().fold(0.0, |size: f64, it| size.hypot(*it));
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
