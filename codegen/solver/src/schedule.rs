//! Plans the times to visit from a range and a step, or from single instants.
//!
//! Intermediate times are `start + k · step` with a whole number k, so that rounding does not accumulate. Every leg moves away from the
//! start strictly monotonically, and every requested instant is on a leg exactly.

/// Largest number of visited times.
pub(crate) const MAX_VISITS: usize = 10_000_000;

/// Smallest number of times between the ends of a range that is visited as a whole.
pub(crate) const MIN_INNER_TIMES: usize = 64;

/// Relative deviation from a whole number of steps that is put down to rounding.
const ROUNDING: f64 = 1e-9;

/// Time to visit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Visit {
    /// Time (s).
    pub t: f64,
    /// True if the time is part of the result, false if it is only visited on the path to another.
    pub wanted: bool,
}

/// Times to visit; each leg begins at the start.
#[derive(Clone, Debug, PartialEq)]
pub struct Schedule {
    /// Time of the assembly.
    #[doc(hidden)]
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
    /// Number of steps.
    count: usize,
    /// Exact end of the last step; `None` if only the steps determine it.
    end: Option<f64>,
    /// Requested times in their order; `None` if every step is requested.
    instants: Option<Vec<f64>>,
}

impl Schedule {
    /// Plans every step from `from` to `to` (s).
    ///
    /// The last time is the last whole step that is not beyond `to`; it is `to` exactly if `to` is a whole number of steps away, up to
    /// rounding.
    ///
    /// # Errors
    /// A sentence with the number that cannot be used.
    pub fn range(from: f64, to: f64, step: f64) -> Result<Schedule, String> {
        if to < from {
            return Err(format!(
                "the end, t = {to} s, lies before the start, t = {from} s"
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

    /// Plans both ends of a range (s) and steps between them, of which the last one may be shorter. There are at least `MIN_INNER_TIMES` times
    /// between the ends, if `f64` can tell them apart.
    ///
    /// # Errors
    /// A sentence with the number that cannot be used.
    pub fn whole(from: f64, to: f64, step: f64) -> Result<Schedule, String> {
        let usable = step.is_finite() && step != 0.0;
        // Twice the resolution, so that a short last step does not repeat the end.
        let least = 4.0 * from.abs().max(to.abs()) * f64::EPSILON;
        let longest = ((to - from) / (MIN_INNER_TIMES + 1) as f64).max(least);
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

    /// Plans the times `instants` (s), reached by steps from `from`; they may be earlier.
    ///
    /// # Errors
    /// A sentence with the number that cannot be used.
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

    /// Largest number of visited times.
    pub fn visits(&self) -> usize {
        1 + self.forward.length() + self.backward.length()
    }

    /// Number of times that are part of the result.
    pub fn wanted(&self) -> usize {
        usize::from(self.start.wanted) + self.forward.wanted() + self.backward.wanted()
    }
}

impl Leg {
    fn new(from: f64, end: f64, step: f64, instants: Option<Vec<f64>>) -> Result<Leg, String> {
        if !(step.is_finite() && step != 0.0) {
            return Err(format!("a step of {} s does not advance", step.abs()));
        }
        let steps = (end - from) / step;
        let rounded = steps.round();
        let whole = (steps - rounded).abs() <= ROUNDING * rounded.max(1.0);
        let count = if whole { rounded } else { steps.floor() };
        if count >= MAX_VISITS as f64 {
            return Err(format!(
                "{count:.1e} steps are too many (at most {MAX_VISITS}): take longer ones"
            ));
        }
        // Below the resolution of `f64`, times would repeat.
        let resolution = from.abs().max(end.abs()) * f64::EPSILON;
        if count > 0.0 && step.abs() <= 2.0 * resolution {
            return Err(format!(
                "a step of {} s cannot be distinguished from rounding at t = {end} s",
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

    /// Largest number of times.
    pub fn length(&self) -> usize {
        self.count + self.instants.as_ref().map_or(0, Vec::len)
    }

    /// Number of times that are part of the result.
    pub fn wanted(&self) -> usize {
        self.instants.as_ref().map_or(self.count, Vec::len)
    }

    /// Returns the times in their order.
    #[doc(hidden)]
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
        let are_requested: Vec<bool> = schedule.forward.visits().map(|it| it.wanted).collect();
        assert_eq!(are_requested, [false, true, true]);
        let schedule = Schedule::instants(0.0, &[0.0], 0.1).expect("good");
        assert_eq!((schedule.visits(), schedule.wanted()), (1, 1));
    }

    #[test]
    fn rejects_unusable_numbers() {
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
