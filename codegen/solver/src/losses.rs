//! Follows what friction takes along a motion: efficiencies, and where the load cannot drive the mechanism backwards.
//!
//! With the power P of all drivers, P₀ without friction and Pᵦ with the friction of the motion in reverse, drivers drive the load where
//! P₀ > 0, with the efficiency P₀/P. The load would give P₀ back in reverse, and the drivers would take Pᵦ of it: the mechanism locks itself
//! where that is negative. Where P₀ < 0, the load drives, and the drivers take −P of −P₀.

use linkwright_codegen::stages::pool::Pool;
use linkwright_codegen::stages::system::{ForceColumn, System};

/// Efficiency at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimedEfficiency {
    /// Time (s).
    pub t: f64,
    /// Part of the power that friction leaves.
    pub efficiency: f64,
}

/// Losses of a motion by friction.
#[derive(Clone, Debug, PartialEq)]
pub struct Losses {
    /// Indices of the powers of drivers among the columns of forces.
    powers: Vec<usize>,
    /// Indices of the powers without friction and in reverse.
    others: [usize; 2],
    /// Work (J) of the drivers with friction and without, while they drive the load.
    pub driving: [f64; 2],
    /// Work (J) that the load gives, with friction and without, while it drives.
    pub driven: [f64; 2],
    /// Lowest efficiency while drivers drive the load; `None` if they never do.
    pub lowest: Option<TimedEfficiency>,
    /// First and last time (s) of each interval in which the load cannot drive the mechanism.
    pub locked: Vec<[f64; 2]>,
    /// Beginning of an interval that has not ended.
    since: Option<f64>,
    last: Option<Powers>,
    /// Number of instants.
    count: usize,
}

/// Powers at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Powers {
    t: f64,
    with_friction: f64,
    frictionless: f64,
    backward: f64,
}

impl Losses {
    /// Creates the losses before the first instant; `None` for a mechanism without friction.
    pub fn of(pool: &Pool, system: &System) -> Option<Losses> {
        if system.mechanism.forces.frictions.is_empty() {
            return None;
        }
        let columns = system.force_columns(&mut pool.draft());
        let place = |wanted: ForceColumn| columns.iter().position(|it| *it == wanted);
        let powers = columns.iter().enumerate();
        let powers = powers.filter(|(_, it)| matches!(it, ForceColumn::Power(_)));
        let others = [ForceColumn::FrictionlessPower, ForceColumn::BackwardPower];
        let [frictionless, backward] = others.map(place);
        Some(Losses {
            powers: powers.map(|(place, _)| place).collect(),
            others: [frictionless?, backward?],
            driving: [0.0; 2],
            driven: [0.0; 2],
            lowest: None,
            locked: Vec::new(),
            since: None,
            last: None,
            count: 0,
        })
    }

    /// Adds the next instant with its columns of forces.
    pub fn see(&mut self, t: f64, columns: &[f64]) {
        let value = |place: &usize| columns.get(*place).copied().unwrap_or(f64::NAN);
        let now = Powers {
            t,
            with_friction: self.powers.iter().map(value).sum(),
            frictionless: value(&self.others[0]),
            backward: value(&self.others[1]),
        };
        if !(now.with_friction + now.frictionless + now.backward).is_finite() {
            // Nothing is known until the next instant with forces.
            self.locked = self.locked();
            (self.since, self.last) = (None, None);
            return;
        }
        self.count += 1;
        if now.frictionless > 0.0 {
            let efficiency = now.frictionless / now.with_friction;
            if self.lowest.is_none_or(|it| efficiency < it.efficiency) {
                self.lowest = Some(TimedEfficiency { t, efficiency });
            }
        }
        let before = self.last;
        let locks = now.margin() < 0.0;
        match (before, locks, self.since) {
            (None, true, _) => self.since = Some(t),
            (Some(before), true, None) => self.since = Some(before.crossing(&now)),
            (Some(before), false, Some(since)) => {
                self.locked.push([since, before.crossing(&now)]);
                self.since = None;
            }
            _ => {}
        }
        if let Some(before) = before {
            let (driving, driven) = (before.work(&now, 1.0), before.work(&now, -1.0));
            for place in 0..2 {
                self.driving[place] += driving[place];
                self.driven[place] += driven[place];
            }
        }
        self.last = Some(now);
    }

    /// True before the first instant.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Returns the intervals in which the load cannot drive the mechanism, the last of them up to the last instant.
    pub fn locked(&self) -> Vec<[f64; 2]> {
        let mut locked = self.locked.clone();
        locked.extend(
            self.since
                .zip(self.last)
                .map(|(since, last)| [since, last.t]),
        );
        locked
    }
}

impl Powers {
    /// Power that is left for a drive by the load: negative where friction takes more than the load gives.
    fn margin(&self) -> f64 {
        match self.frictionless > 0.0 {
            true => self.backward,
            false => -self.with_friction,
        }
    }

    /// Returns the time at which the margin of two instants is zero, if it is linear between them.
    fn crossing(&self, next: &Powers) -> f64 {
        let [first, last] = [self, next].map(Powers::margin);
        self.t + (next.t - self.t) * first / (first - last)
    }

    /// Returns the work until the next instant with friction and without, while the power without friction has a sign. Powers are linear
    /// between instants.
    fn work(&self, next: &Powers, sign: f64) -> [f64; 2] {
        let [first, last] = [self, next].map(|it| sign * it.frictionless);
        let (from, to) = match (first > 0.0, last > 0.0) {
            (true, true) => (0.0, 1.0),
            (true, false) => (0.0, first / (first - last)),
            (false, true) => (first / (first - last), 1.0),
            (false, false) => return [0.0; 2],
        };
        let mean = 0.5 * (from + to);
        let duration = (to - from) * (next.t - self.t);
        let at = |first: f64, last: f64| sign * duration * (first + mean * (last - first));
        [
            at(self.with_friction, next.with_friction),
            at(self.frictionless, next.frictionless),
        ]
    }
}
