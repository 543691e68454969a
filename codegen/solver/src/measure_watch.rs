//! Finds the extremes of measures along a motion, and the times at which limits are broken, also between the visited instants.
//!
//! An extreme lies about an instant whose value is beyond those of both neighbors. It is refined by golden sections, and the time at which
//! a limit is reached by bisection; each of their values is that of a solved pose.

use linkwright::Shell;
use linkwright_codegen::stages::model::Limit;

use crate::instant::Instant;
use crate::motors::MotorPeaks;
use crate::supplied::{InputLaws, Modes};
use crate::view::View;

/// Smallest and largest value of a measure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasureRange {
    /// Index into the mechanism's measurements.
    pub measurement: usize,
    /// Smallest value, in SI units.
    pub smallest: TimedValue,
    /// Largest value, in SI units.
    pub largest: TimedValue,
}

/// Value at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimedValue {
    /// Time (s).
    pub t: f64,
    /// Value, in SI units.
    pub value: f64,
}

/// Limit that a motion breaks.
#[derive(Clone, Debug, PartialEq)]
pub struct BrokenLimit {
    /// Index into the mechanism's limits.
    pub limit: usize,
    /// First and last time (s) of each interval in which the measure is beyond the limit.
    pub intervals: Vec<[f64; 2]>,
    /// Value that is farthest beyond the limit.
    pub worst: TimedValue,
}

/// Results of a motion.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeasureRanges {
    /// Extremes of all measures, in their order.
    pub ranges: Vec<MeasureRange>,
    /// Broken limits, in their order.
    pub broken: Vec<BrokenLimit>,
    /// Worst points of motors, in their order.
    pub motors: Vec<MotorPeaks>,
}

/// Observer of the instants of a motion in their order.
#[derive(Clone, Debug)]
pub struct MeasureWatch {
    limits: Vec<Limit>,
    laws: InputLaws,
    /// Number of reported columns that precede the measures.
    first: usize,
    ranges: Vec<MeasureRange>,
    broken: Vec<BrokenLimit>,
    motors: Vec<MotorPeaks>,
    /// Beginning of the interval in which a limit is broken now.
    since: Vec<Option<f64>>,
    /// Last two instants.
    last: Vec<Seen>,
}

/// Instant with its measures.
#[derive(Clone, Debug)]
struct Seen {
    instant: Instant,
    modes: Modes,
    values: Vec<f64>,
}

/// Ratio of golden sections.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Relative change below which a value counts as constant.
const CONSTANT: f64 = 1e-13;

impl MeasureWatch {
    /// Creates an observer before the first instant; `None` if nothing is measured.
    pub fn new<V: View>(view: &V) -> Option<MeasureWatch> {
        let mechanism = &view.system().mechanism;
        let count = mechanism.measurements.len();
        if count == 0 {
            return None;
        }
        let columns = crate::reported::names(view.pool(), view.system()).len();
        let [none_below, none_above] = [f64::INFINITY, f64::NEG_INFINITY];
        let none = |value| TimedValue { t: f64::NAN, value };
        let ranges = (0..count).map(|measurement| MeasureRange {
            measurement,
            smallest: none(none_below),
            largest: none(none_above),
        });
        let broken = (0..mechanism.limits.len()).map(|limit| BrokenLimit {
            limit,
            intervals: Vec::new(),
            worst: none(f64::NAN),
        });
        Some(MeasureWatch {
            limits: mechanism.limits.clone(),
            laws: view.input_laws(),
            first: columns - count,
            ranges: ranges.collect(),
            since: vec![None; mechanism.limits.len()],
            broken: broken.collect(),
            motors: MotorPeaks::of(mechanism),
            last: Vec::new(),
        })
    }

    /// Returns the observer for instants with inputs of these laws.
    pub(crate) fn along(mut self, laws: InputLaws) -> MeasureWatch {
        self.laws = laws;
        self
    }

    /// Returns the limit that is broken first with the time from which it is, in the direction of time; `None` if all hold so far.
    pub(crate) fn first_broken(&self) -> Option<(usize, f64)> {
        let pairs = self.since.iter().zip(&self.broken).enumerate();
        let times = pairs.flat_map(|(limit, (since, broken))| {
            let ended = broken.intervals.iter().map(|it| it[0]);
            since.iter().copied().chain(ended).map(move |t| (limit, t))
        });
        times.min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Observes the next instant.
    pub fn see<V: View>(&mut self, shell: &Shell<V>) {
        let Some(values) = self.measured(shell) else {
            return;
        };
        let now = Seen {
            instant: shell.frame().clone(),
            modes: shell.branches().clone(),
            values,
        };
        self.note_all(&now);
        if let [before, middle] = &self.last[..] {
            let three = [before.clone(), middle.clone(), now.clone()];
            for measure in 0..self.ranges.len() {
                self.extreme(measure, &three, shell);
            }
        }
        let previous = self.last.last().cloned();
        for limit in 0..self.limits.len() {
            self.limit(limit, previous.as_ref(), &now, shell);
        }
        if self.last.len() == 2 {
            self.last.remove(0);
        }
        self.last.push(now);
    }

    /// Returns the results of all instants.
    pub fn finish(mut self) -> MeasureRanges {
        if let Some(end) = self.last.last() {
            let t = end.instant.t();
            for (since, broken) in self.since.iter().zip(&mut self.broken) {
                broken.intervals.extend(since.map(|since| [since, t]));
            }
        }
        for broken in &mut self.broken {
            broken.intervals.sort_by(|a, b| a[0].total_cmp(&b[0]));
        }
        self.broken.retain(|it| !it.intervals.is_empty());
        // A motion without instants has no extremes.
        self.ranges.retain(|it| it.smallest.t.is_finite());
        MeasureRanges {
            ranges: self.ranges,
            broken: self.broken,
            motors: self.motors,
        }
    }

    fn measured<V: View>(&self, shell: &Shell<V>) -> Option<Vec<f64>> {
        let mut values = shell.blocks().reported(shell.frame())?;
        Some(values.split_off(self.first))
    }

    fn note_all(&mut self, seen: &Seen) {
        let t = seen.instant.t();
        for measure in 0..self.ranges.len() {
            self.note(measure, t, seen.values[measure]);
        }
        self.note_motors(t, &seen.values);
    }

    /// Records the values of all measures for motors.
    fn note_motors(&mut self, t: f64, values: &[f64]) {
        self.motors.iter_mut().for_each(|it| it.see(t, values));
    }

    /// Records a value of a measure.
    fn note(&mut self, measure: usize, t: f64, value: f64) {
        let range = &mut self.ranges[measure];
        if value < range.smallest.value {
            range.smallest = TimedValue { t, value };
        }
        if value > range.largest.value {
            range.largest = TimedValue { t, value };
        }
        let limits = self.limits.iter().zip(&mut self.broken);
        for (limit, broken) in limits.filter(|(limit, _)| limit.measurement == measure) {
            let margin = limit.margin(value);
            let is_first = broken.worst.value.is_nan();
            if margin < 0.0 && (is_first || margin < limit.margin(broken.worst.value)) {
                broken.worst = TimedValue { t, value };
            }
        }
    }

    /// Refines an extreme about the second of three instants, if it may be the largest or smallest of all, or break a limit.
    fn extreme<V: View>(
        &mut self,
        measure: usize,
        [before, middle, after]: &[Seen; 3],
        shell: &Shell<V>,
    ) {
        let values = [before, middle, after].map(|it| it.values[measure]);
        let [rise, fall] = [values[1] - values[0], values[1] - values[2]];
        let change = rise.abs().max(fall.abs());
        let is_extreme = rise * fall >= 0.0 && change > CONSTANT * values[1].abs();
        if !is_extreme {
            return;
        }
        let sign = if rise + fall > 0.0 { 1.0 } else { -1.0 };
        let range = &self.ranges[measure];
        let best = match sign > 0.0 {
            true => range.largest.value,
            false => range.smallest.value,
        };
        // The vertex of the parabola through the three values is at most one eighth of their changes beyond the second one.
        let reach = values[1] + sign * change;
        let limits = self.limits.iter().enumerate();
        let mut limits = limits.filter(|(_, limit)| limit.measurement == measure);
        // A measure has at most one limit.
        let limit = limits.next().map(|(place, limit)| (place, limit.clone()));
        let breaks = |value: f64| {
            let limit = limit.as_ref();
            limit.is_some_and(|(_, limit)| limit.margin(value) < 0.0)
        };
        let may_break = breaks(reach) && !breaks(values[1]);
        if (reach - best) * sign < 0.0 && !may_break {
            return;
        }
        let (t, value) = self.golden(measure, sign, before, after.instant.t(), shell);
        self.note(measure, t, value);
        if self
            .motors
            .iter()
            .any(|it| it.measurements.contains(&measure))
            && let Some(values) = self.at(t, before, shell)
        {
            self.note_motors(t, &values);
        }
        if !breaks(value) || values.into_iter().any(breaks) {
            return;
        }
        if let Some((place, _)) = limit {
            let first = self.bisected(place, before, [before.instant.t(), t], shell);
            let last = self.bisected(place, before, [after.instant.t(), t], shell);
            self.broken[place].intervals.push([first, last]);
        }
    }

    /// Returns time and value of the extreme of a measure between two instants.
    fn golden<V: View>(
        &self,
        measure: usize,
        sign: f64,
        from: &Seen,
        to: f64,
        shell: &Shell<V>,
    ) -> (f64, f64) {
        let value = |t: f64| match self.at(t, from, shell) {
            Some(values) => sign * values[measure],
            None => f64::NEG_INFINITY,
        };
        let (mut low, mut high) = (from.instant.t(), to);
        let mut inner = [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
        let mut values = inner.map(value);
        // The value is flat where it is largest: half of the digits of the time determine it.
        while (high - low).abs() > f64::EPSILON.sqrt() * high.abs().max(low.abs()) * 0.1 {
            let width = (high - low).abs();
            match values[0] >= values[1] {
                true => {
                    high = inner[1];
                    inner = [high - GOLDEN * (high - low), inner[0]];
                    values = [value(inner[0]), values[0]];
                }
                false => {
                    low = inner[0];
                    inner = [inner[1], low + GOLDEN * (high - low)];
                    values = [values[1], value(inner[1])];
                }
            }
            if (high - low).abs() >= width {
                break;
            }
        }
        match values[0] >= values[1] {
            true => (inner[0], sign * values[0]),
            false => (inner[1], sign * values[1]),
        }
    }

    /// Records where a limit begins or ends to be broken between two instants.
    fn limit<V: View>(
        &mut self,
        limit: usize,
        before: Option<&Seen>,
        now: &Seen,
        shell: &Shell<V>,
    ) {
        let limited = &self.limits[limit];
        let is_broken = |seen: &Seen| limited.margin(seen.values[limited.measurement]) < 0.0;
        let t = now.instant.t();
        match (before, is_broken(now), self.since[limit]) {
            (None, true, _) => self.since[limit] = Some(t),
            (Some(before), true, None) => {
                let crossing = self.bisected(limit, before, [before.instant.t(), t], shell);
                self.since[limit] = Some(crossing);
            }
            (Some(before), false, Some(since)) => {
                let crossing = self.bisected(limit, before, [t, before.instant.t()], shell);
                self.broken[limit].intervals.push([since, crossing]);
                self.since[limit] = None;
            }
            _ => {}
        }
    }

    /// Returns the first time at which a limit is broken on the way from the first time, at which it holds, to the second one.
    fn bisected<V: View>(
        &self,
        limit: usize,
        from: &Seen,
        [mut holds, mut breaks]: [f64; 2],
        shell: &Shell<V>,
    ) -> f64 {
        let limited = &self.limits[limit];
        loop {
            let middle = holds + 0.5 * (breaks - holds);
            if middle == holds || middle == breaks {
                return breaks;
            }
            let values = self.at(middle, from, shell);
            let margin = values.map_or(f64::NAN, |it| limited.margin(it[limited.measurement]));
            match margin < 0.0 {
                true => breaks = middle,
                false => holds = middle,
            }
        }
    }

    /// Returns the measures at a time, reached from an instant; `None` if the pose cannot be solved.
    fn at<V: View>(&self, t: f64, from: &Seen, shell: &Shell<V>) -> Option<Vec<f64>> {
        let mut shell = shell.clone();
        let start = from.instant.t();
        shell.resume(&from.instant, &from.modes, &self.laws.at(start));
        if t != start {
            shell.advance(t, &self.laws.at(t)).ok()?;
        }
        self.measured(&shell)
    }
}
