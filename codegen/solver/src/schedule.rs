//! *From, to, step, or single instants* → *the times to visit*.
//!
//! Times on the way are `start + k · step` with a whole number k, so that rounding does not accumulate. Every leg moves away from the
//! start strictly monotonically, and every instant that was asked for is on a leg exactly. The module does not know what is solved
//! at these times.

/// How many times may be visited at most.
pub const LARGEST: usize = 10_000_000;

/// How many times lie at least between the ends of a range that is visited as a whole.
pub const BETWEEN: usize = 64;

/// The relative deviation from a whole number of steps that is put down to rounding.
const ROUNDING: f64 = 1e-9;

/// A time to visit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Visit {
    /// The time (s).
    pub t: f64,
    /// Whether it is part of the result, or only on the way.
    pub wanted: bool,
}

/// The times to visit, each leg beginning at the start.
#[derive(Clone, Debug, PartialEq)]
pub struct Schedule {
    /// Where the mechanism is assembled.
    pub start: Visit,
    /// Earlier times, descending.
    pub backward: Leg,
    /// Later times, ascending.
    pub forward: Leg,
}

/// Times in one direction.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Leg {
    from: f64,
    step: f64,
    /// How many steps there are.
    count: usize,
    /// Where the last step ends, if that is known exactly.
    end: Option<f64>,
    /// The times that are wanted, in their order; `None` where every step is.
    instants: Option<Vec<f64>>,
}

impl Schedule {
    /// Every step from `from` to `to`. The last time is the last whole step that is not beyond `to`; it is `to` exactly if
    /// `to` is a whole number of steps away, up to rounding.
    ///
    /// # Errors
    /// A sentence that says which number cannot be used.
    pub fn range(from: f64, to: f64, step: f64) -> Result<Schedule, String> {
        if to < from {
            return Err(format!(
                "`--to {to}` lies before `--from {from}`; only `--at` goes back in time"
            ));
        }
        Ok(Schedule {
            start: Visit {
                t: from,
                wanted: true,
            },
            backward: Leg::default(),
            forward: Leg::new(from, to, step, None)?,
        })
    }

    /// Both ends of a range and steps between them, of which the last one may be shorter. There are at least [`BETWEEN`] times
    /// between the ends, where they can be told apart.
    ///
    /// # Errors
    /// A sentence that says which number cannot be used.
    pub fn whole(from: f64, to: f64, step: f64) -> Result<Schedule, String> {
        let usable = step.is_finite() && step != 0.0;
        // Twice what can be told apart, so that a short last step is no copy of the end.
        let least = 4.0 * from.abs().max(to.abs()) * f64::EPSILON;
        let longest = ((to - from) / (BETWEEN + 1) as f64).max(least);
        let step = match usable && to > from {
            true => step.min(longest),
            false => step,
        };
        let mut schedule = Schedule::range(from, to, step)?;
        let leg = &mut schedule.forward;
        if to > from && leg.end.is_none() {
            leg.count += 1;
            leg.end = Some(to);
        }
        Ok(schedule)
    }

    /// Only the times `instants`, reached by steps from `from`; they may lie before it.
    ///
    /// # Errors
    /// A sentence that says which number cannot be used.
    pub fn instants(from: f64, instants: &[f64], step: f64) -> Result<Schedule, String> {
        let mut instants = instants.to_vec();
        instants.sort_by(f64::total_cmp);
        instants.dedup();
        let later: Vec<f64> = instants.iter().copied().filter(|t| *t > from).collect();
        let earlier = instants.iter().copied().filter(|t| *t < from);
        let earlier: Vec<f64> = earlier.rev().collect();
        let leg_to = |wanted: Vec<f64>, step| match wanted.last() {
            Some(&end) => Leg::new(from, end, step, Some(wanted)),
            None => Ok(Leg::default()),
        };
        Ok(Schedule {
            start: Visit {
                t: from,
                wanted: instants.contains(&from),
            },
            backward: leg_to(earlier, -step)?,
            forward: leg_to(later, step)?,
        })
    }

    /// How many times are visited at most.
    pub fn visits(&self) -> usize {
        1 + self.forward.length() + self.backward.length()
    }

    /// How many times are part of the result.
    pub fn wanted(&self) -> usize {
        usize::from(self.start.wanted) + self.forward.wanted() + self.backward.wanted()
    }
}

impl Leg {
    fn new(from: f64, end: f64, step: f64, instants: Option<Vec<f64>>) -> Result<Leg, String> {
        if !(step.is_finite() && step != 0.0) {
            return Err(format!("a step of {} s leads nowhere", step.abs()));
        }
        let steps = (end - from) / step;
        let rounded = steps.round();
        let whole = (steps - rounded).abs() <= ROUNDING * rounded.max(1.0);
        let count = if whole { rounded } else { steps.floor() };
        if count >= LARGEST as f64 {
            return Err(format!(
                "{count:.1e} steps are too many (at most {LARGEST}): use a larger `--step`"
            ));
        }
        // Below the resolution of `f64` at these times, times would repeat.
        let resolution = from.abs().max(end.abs()) * f64::EPSILON;
        if count > 0.0 && step.abs() <= 2.0 * resolution {
            return Err(format!(
                "a step of {} s cannot be told apart from rounding at t = {end} s",
                step.abs()
            ));
        }
        Ok(Leg {
            from,
            step,
            count: count as usize,
            end: whole.then_some(end),
            instants,
        })
    }

    /// How many times there are at most.
    pub fn length(&self) -> usize {
        self.count + self.instants.as_ref().map_or(0, Vec::len)
    }

    /// How many of them are part of the result.
    pub fn wanted(&self) -> usize {
        self.instants.as_ref().map_or(self.count, Vec::len)
    }

    /// The times in their order.
    pub fn visits(&self) -> impl Iterator<Item = Visit> + '_ {
        let grid = (1..=self.count).map(|k| match self.end {
            Some(end) if k == self.count => end,
            _ => self.from + k as f64 * self.step,
        });
        let mut grid = grid.peekable();
        let mut instants = self.instants.iter().flatten().copied().peekable();
        let forward = self.step > 0.0;
        std::iter::from_fn(move || {
            let every = self.instants.is_none();
            match (grid.peek().copied(), instants.peek().copied()) {
                (Some(t), Some(instant)) if t == instant => {
                    grid.next();
                    instants.next().map(|t| Visit { t, wanted: true })
                }
                (Some(t), Some(instant)) if (instant < t) == forward => {
                    instants.next().map(|t| Visit { t, wanted: true })
                }
                (Some(_), _) => grid.next().map(|t| Visit { t, wanted: every }),
                (None, _) => instants.next().map(|t| Visit { t, wanted: true }),
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn times(leg: &Leg) -> Vec<f64> {
        leg.visits().map(|visit| visit.t).collect()
    }

    #[test]
    fn a_range_ends_exactly() {
        let schedule = Schedule::range(0.0, 5.0, 0.01).expect("a good range");
        assert_eq!(schedule.visits(), 501);
        let forward = times(&schedule.forward);
        assert_eq!((forward[499], forward[2]), (5.0, 0.03));
        let schedule = Schedule::range(0.1, 0.7, 0.2).expect("a good range");
        assert_eq!(times(&schedule.forward).last(), Some(&0.7));
    }

    #[test]
    fn a_range_does_not_pass_its_end() {
        for (from, to, visits) in [(0.0, 1.0, 4), (2.0, 2.0, 1), (2.0, 2.1, 1)] {
            let schedule = Schedule::range(from, to, 0.3).expect("a good range");
            assert_eq!(schedule.visits(), visits);
            assert_eq!(schedule.forward.visits().count(), visits - 1);
        }
    }

    #[test]
    fn a_whole_range_has_both_ends_and_enough_between() {
        for (from, to, step, visits) in [
            (0.0, 0.008, 0.01, 66),
            (0.0, 5.0, 0.01, 501),
            (0.0, 0.25, 0.03, 66),
            (0.0, 1.0, 0.003, 335),
            (2.0, 2.0, 0.01, 1),
            (1.0, 1.0_f64.next_up(), 0.01, 2),
        ] {
            let schedule = Schedule::whole(from, to, step).expect("a good range");
            assert_eq!(schedule.visits(), visits, "{from} to {to}");
            let all = [vec![from], times(&schedule.forward)].concat();
            assert_eq!(all.last(), Some(&to));
            assert!(all.windows(2).all(|it| it[0] < it[1]), "{all:?}");
        }
        assert!(Schedule::whole(0.0, 1.0, 0.0).is_err());
        assert!(Schedule::whole(0.0, 1.0, f64::NAN).is_err());
        assert!(Schedule::whole(1.0, 0.0, 0.1).is_err());
    }

    #[test]
    fn instants_are_reached_by_steps_in_both_directions() {
        let schedule = Schedule::instants(0.0, &[0.25, -0.15, 0.2, 0.25], 0.1).expect("good");
        assert_eq!(times(&schedule.forward), [0.1, 0.2, 0.25]);
        assert_eq!(times(&schedule.backward), [-0.1, -0.15]);
        assert_eq!(schedule.wanted(), 3);
        assert!(!schedule.start.wanted);
        let wanted: Vec<bool> = schedule.forward.visits().map(|it| it.wanted).collect();
        assert_eq!(wanted, [false, true, true]);
        let schedule = Schedule::instants(0.0, &[0.0], 0.1).expect("good");
        assert_eq!((schedule.visits(), schedule.wanted()), (1, 1));
    }

    #[test]
    fn what_cannot_be_visited_is_refused() {
        for (from, to, step) in [
            (0.0, -1.0, 0.1),
            (0.0, 1.0, 0.0),
            (0.0, 1.0, f64::NAN),
            (0.0, 1.0, 1e-9),
            (1e16, 1e16 + 4.0, 0.5),
        ] {
            assert!(
                Schedule::range(from, to, step).is_err(),
                "{from} {to} {step}"
            );
        }
    }
}
