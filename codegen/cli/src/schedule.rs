//! *From, to, step, or single instants → the times to visit.*
//!
//! Times on the way are `start + k · step` with a whole number k, so that rounding does not accumulate. Afterwards every
//! leg moves away from the start strictly monotonically, and every instant that was asked for is on a leg exactly.
//! The module does not know what is solved at these times.

/// How many times may be visited at most.
pub const LARGEST: usize = 10_000_000;

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
    /// Later times, ascending.
    pub forward: Vec<Visit>,
    /// Earlier times, descending.
    pub backward: Vec<Visit>,
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
        let forward = leg(from, to, step, &[])?;
        Ok(Schedule {
            start: Visit {
                t: from,
                wanted: true,
            },
            forward,
            backward: Vec::new(),
        })
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
        let earlier: Vec<f64> = instants
            .iter()
            .copied()
            .filter(|t| *t < from)
            .rev()
            .collect();
        let leg_to = |wanted: &[f64], step| match wanted.last() {
            Some(end) => leg(from, *end, step, wanted),
            None => Ok(Vec::new()),
        };
        Ok(Schedule {
            start: Visit {
                t: from,
                wanted: instants.contains(&from),
            },
            forward: leg_to(&later, step)?,
            backward: leg_to(&earlier, -step)?,
        })
    }

    /// How many times are visited.
    pub fn visits(&self) -> usize {
        1 + self.forward.len() + self.backward.len()
    }

    /// How many times are part of the result.
    pub fn wanted(&self) -> usize {
        let legs = self.forward.iter().chain(&self.backward);
        usize::from(self.start.wanted) + legs.filter(|visit| visit.wanted).count()
    }
}

/// The times after `from` up to `end`; every step is wanted, unless only the times in `wanted` are. These are ordered
/// like the leg and end with `end`.
fn leg(from: f64, end: f64, step: f64, wanted: &[f64]) -> Result<Vec<Visit>, String> {
    if !(step.is_finite() && step != 0.0) {
        return Err(format!("a step of {} s leads nowhere", step.abs()));
    }
    let steps = (end - from) / step;
    let rounded = steps.round();
    let whole = (steps - rounded).abs() <= ROUNDING * rounded.max(1.0);
    let count = if whole { rounded } else { steps.floor() };
    if count >= LARGEST as f64 {
        return Err(format!(
            "{} steps are too many (at most {LARGEST}): use a larger `--step`",
            crate::number::scientific(count, 1)
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
    let count = count as usize;
    let grid = (1..=count).map(|k| match k == count && whole {
        true => end,
        false => from + k as f64 * step,
    });
    if wanted.is_empty() {
        return Ok(grid.map(|t| Visit { t, wanted: true }).collect());
    }
    let mut visits = Vec::with_capacity(count + wanted.len());
    let mut pending = wanted.iter().copied().peekable();
    let before = |one: f64, other: f64| if step > 0.0 { one < other } else { one > other };
    for t in grid {
        while let Some(instant) = pending.next_if(|instant| before(*instant, t)) {
            visits.push(Visit {
                t: instant,
                wanted: true,
            });
        }
        let wanted = pending.next_if_eq(&t).is_some();
        visits.push(Visit { t, wanted });
    }
    visits.extend(pending.map(|t| Visit { t, wanted: true }));
    Ok(visits)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn times(visits: &[Visit]) -> Vec<f64> {
        visits.iter().map(|visit| visit.t).collect()
    }

    #[test]
    fn a_range_ends_exactly() {
        let schedule = Schedule::range(0.0, 5.0, 0.01).expect("a good range");
        assert_eq!(schedule.visits(), 501);
        assert_eq!(schedule.forward[499].t, 5.0);
        assert_eq!(schedule.forward[2].t, 0.03);
        let schedule = Schedule::range(0.1, 0.7, 0.2).expect("a good range");
        assert_eq!(schedule.forward.last().map(|visit| visit.t), Some(0.7));
    }

    #[test]
    fn a_range_does_not_pass_its_end() {
        let schedule = Schedule::range(0.0, 1.0, 0.3).expect("a good range");
        assert_eq!(schedule.forward.len(), 3);
        let schedule = Schedule::range(2.0, 2.0, 0.3).expect("a good range");
        assert_eq!(schedule.visits(), 1);
        let schedule = Schedule::range(2.0, 2.1, 0.3).expect("a good range");
        assert_eq!(schedule.visits(), 1);
    }

    #[test]
    fn instants_are_reached_by_steps_in_both_directions() {
        let schedule = Schedule::instants(0.0, &[0.25, -0.15, 0.2, 0.25], 0.1).expect("good");
        assert_eq!(times(&schedule.forward), [0.1, 0.2, 0.25]);
        assert_eq!(times(&schedule.backward), [-0.1, -0.15]);
        assert_eq!(schedule.wanted(), 3);
        assert!(!schedule.start.wanted);
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
