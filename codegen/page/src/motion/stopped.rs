//! Ends a motion under forces where a measure reaches a limit with `stop`.

use linkwright_codegen::stages::model::Limit;
use linkwright_solver::number::time;
use linkwright_solver::{Interpreted, Simulation, View};

/// Number of parts of an interval between two visited times whose ends are examined.
const PARTS: u32 = 8;

/// Limits that end a motion.
#[derive(Clone, Debug)]
pub(super) struct Stops {
    limits: Vec<Limit>,
    /// Number of reported columns before the measures.
    first: usize,
}

/// End of a motion at a limit.
pub(super) struct Stopped {
    /// Mechanism at the last time within the limit.
    pub simulation: Simulation,
    /// Sentence for the user.
    pub message: String,
}

impl Stops {
    /// Returns the limits of a mechanism that end a motion; `None` if there are none.
    pub fn of(view: &Interpreted) -> Option<Stops> {
        let mechanism = &view.system().mechanism;
        let limits = mechanism.limits.iter().filter(|it| it.stops).cloned();
        let limits: Vec<Limit> = limits.collect();
        let columns = linkwright_solver::reported::names(view.pool(), view.system()).len();
        let first = columns - mechanism.measurements.len();
        (!limits.is_empty()).then_some(Stops { limits, first })
    }

    /// Returns the end of the motion between a mechanism and a later time; `None` if all limits hold, or if the motion cannot be solved.
    pub fn before(&self, start: &Simulation, t: f64) -> Option<Stopped> {
        let begin = start.frame().t();
        let mut held = start.clone();
        if let Some(limit) = self.broken(&held) {
            return Some(self.stopped(held, limit));
        }
        for part in 1..=PARTS {
            let share = f64::from(part) / f64::from(PARTS);
            let next = begin + share * (t - begin);
            let mut reached = held.clone();
            reached.advance(next).ok()?;
            if let Some(limit) = self.broken(&reached) {
                return Some(self.bisected(held, next, limit));
            }
            held = reached;
        }
        None
    }

    fn bisected(&self, start: Simulation, end: f64, first: usize) -> Stopped {
        let (mut low, mut high, mut limit) = (start.frame().t(), end, first);
        let mut last = start.clone();
        loop {
            let middle = low + 0.5 * (high - low);
            if middle == low || middle == high {
                return self.stopped(last, limit);
            }
            let mut reached = start.clone();
            if reached.advance(middle).is_err() {
                return self.stopped(last, limit);
            }
            match self.broken(&reached) {
                Some(broken) => (high, limit) = (middle, broken),
                None => (low, last) = (middle, reached),
            }
        }
    }

    /// Returns the first limit that a frame breaks.
    fn broken(&self, simulation: &Simulation) -> Option<usize> {
        let reported = simulation.view().reported(simulation.frame())?;
        self.limits.iter().position(|limit| {
            let value = reported.get(self.first + limit.measurement);
            value.is_some_and(|value| limit.margin(*value) < 0.0)
        })
    }

    fn stopped(&self, simulation: Simulation, limit: usize) -> Stopped {
        let mechanism = &simulation.view().system().mechanism;
        let limit = &self.limits[limit];
        let units = mechanism.units.of_tables();
        let t = time(simulation.frame().t());
        let name = &mechanism.measurements[limit.measurement].name;
        let message = format!(
            "the motion ends at t = {t} s, where `{name}` reaches its limit: {}",
            limit.text(&units)
        );
        Stopped {
            simulation,
            message,
        }
    }
}
