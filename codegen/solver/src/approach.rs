//! Finds the closest approach of each subsystem to a singular pose along a motion, and its time.
//!
//! The rates of the measures are known. A minimum between two instants lies where the rate changes its sign, or where the measure
//! itself does. Bisection locates it to the last digit of t that the solver resolves. Only the lowest few candidates are kept.

use linkwright::Shell;

use crate::instant::Instant;
use crate::measures::{MeasuredPart, Measures, Sample};
use crate::supplied::{InputLaws, Modes};
use crate::view::View;

/// Largest number of candidates per subsystem that wait for refinement: higher ones need none if lower ones were refined.
const WAITING: usize = 64;

/// Difference below which two measures count as the same minimum, reached again.
pub(crate) const MEASURE_TOLERANCE: f64 = 1e-9;

/// Closest approach of one subsystem to a singular pose.
#[derive(Clone, Debug)]
pub struct Approach {
    /// Subsystem.
    pub part: MeasuredPart,
    /// Smallest magnitude of the measure: 0 is singular, 1 is the largest possible distance.
    pub measure: f64,
    /// Magnitude before it was divided by the largest of the motion; differs from `measure` only for relative measures.
    pub size: f64,
    /// First instant of this magnitude.
    pub instant: Instant,
    /// Number of times of this magnitude, up to `MEASURE_TOLERANCE`.
    pub times: usize,
    /// True if it is an end of the motion, beyond which the measure might fall further.
    pub at_end: bool,
    /// True if the measure changes its sign there: the motion passes straight through a singular pose.
    pub crosses: bool,
}

/// Observer of the instants of a motion in their order.
#[derive(Clone, Debug)]
pub struct Watch {
    measures: Measures,
    laws: InputLaws,
    watched: Vec<Watched>,
    last: Option<(Instant, Modes, Vec<Sample>)>,
}

/// Candidates of a subsystem.
#[derive(Clone, Debug)]
struct Watched {
    part: MeasuredPart,
    largest: f64,
    /// Upper bound of the smallest magnitude.
    bound: f64,
    /// Candidates for a minimum or a zero, in no order.
    brackets: Vec<Bracket>,
    /// Magnitudes at the ends and at refined minima, with their times.
    sizes: Vec<[f64; 2]>,
    /// First of the smallest of these, up to `MEASURE_TOLERANCE`, and any that is lower.
    first: Option<Low>,
    /// True if the measure changes its sign at any of them.
    crosses: bool,
}

/// Interval between two instants that may contain a minimum or a zero of the measure.
#[derive(Clone, Debug)]
struct Bracket {
    /// Value where the tangents at both ends meet: a lower bound of a convex measure.
    least: f64,
    near: Instant,
    /// Modes at the beginning.
    modes: Modes,
    far: f64,
    crosses: bool,
}

/// Instant with the magnitude of the measure.
#[derive(Clone, Debug)]
struct Low {
    size: f64,
    instant: Instant,
    at_end: bool,
    crosses: bool,
}

impl Watch {
    /// Creates an observer before the first instant.
    pub fn new(measures: Measures, laws: InputLaws) -> Watch {
        let watched = measures.parts().iter().map(|part| Watched {
            part: part.clone(),
            largest: 0.0,
            bound: f64::INFINITY,
            brackets: Vec::new(),
            sizes: Vec::new(),
            first: None,
            crosses: false,
        });
        Watch {
            watched: watched.collect(),
            measures,
            laws,
            last: None,
        }
    }

    /// Observes the next instant; returns the magnitude of each subsystem's measure.
    pub fn see<V: View>(&mut self, shell: &Shell<V>) -> Vec<f64> {
        let (instant, modes) = (shell.frame(), shell.branches());
        let samples = self.measures.at(instant);
        let mut waiting = false;
        for (place, watched) in self.watched.iter_mut().enumerate() {
            let [value, _] = samples[place];
            watched.largest = watched.largest.max(value.abs());
            watched.bound = watched.bound.min(value.abs());
            match &self.last {
                None => watched.note(Low::end(value, instant)),
                Some((near, modes, before)) => {
                    let measures = [before[place], samples[place]];
                    watched.bracket([near, instant], modes, measures)
                }
            }
            waiting |= watched.brackets.len() >= WAITING;
        }
        if waiting {
            self.refine_all(shell);
        }
        let sizes = samples.iter().map(|[value, _]| value.abs()).collect();
        match &mut self.last {
            Some((last, before, measured)) => {
                last.clone_from(instant);
                before.clone_from(modes);
                *measured = samples;
            }
            last => *last = Some((instant.clone(), modes.clone(), samples)),
        }
        sizes
    }

    /// Returns the closest approach of every subsystem; `shell` may be in any state.
    pub fn finish<V: View>(mut self, shell: &Shell<V>) -> Vec<Approach> {
        if let Some((instant, _, samples)) = self.last.take() {
            for (watched, [value, _]) in self.watched.iter_mut().zip(samples) {
                watched.note(Low::end(value, &instant));
            }
        }
        self.refine_all(shell);
        let watched = self.watched.into_iter();
        watched.filter_map(Watched::approach).collect()
    }

    /// Refines all candidates that may be as low as the lowest, and discards the others.
    fn refine_all<V: View>(&mut self, shell: &Shell<V>) {
        let mut all = std::mem::take(&mut self.watched);
        for (place, watched) in all.iter_mut().enumerate() {
            let brackets = std::mem::take(&mut watched.brackets);
            for bracket in &brackets {
                if bracket.least <= watched.bound + MEASURE_TOLERANCE * watched.unit() {
                    watched.note(self.refine(place, bracket, shell));
                }
            }
        }
        self.watched = all;
    }

    /// Returns the last time in a bracket before the measure is stationary or zero, to the resolution of times.
    fn refine<V: View>(&self, place: usize, bracket: &Bracket, shell: &Shell<V>) -> Low {
        let sample = |instant: &Instant| self.measures.at(instant)[place];
        let sign = sample(&bracket.near)[0].signum();
        let direction = (bracket.far - bracket.near.t()).signum();
        let is_before = |instant: &Instant| {
            let [value, rate] = sample(instant);
            match bracket.crosses {
                true => value * sign > 0.0,
                false => rate * value.signum() * direction < 0.0,
            }
        };
        let (mut near, mut far) = (bracket.near.clone(), bracket.far);
        let mut modes = bracket.modes.clone();
        let mut shell = shell.clone();
        loop {
            let middle = near.t() + 0.5 * (far - near.t());
            if middle == near.t() || middle == far {
                break;
            }
            shell.resume(&near, &modes, &self.laws.at(near.t()));
            match shell.advance(middle, &self.laws.at(middle)) {
                Ok(reached) if is_before(reached) => {
                    near.clone_from(reached);
                    modes.clone_from(shell.branches());
                }
                _ => far = middle,
            }
        }
        let mut size = sample(&near)[0].abs();
        if bracket.crosses {
            // Where modes can no longer be told apart, the measure falls to zero at its rate.
            let [value, rate] = sample(&near);
            let left = -value / rate;
            if left.abs() <= (bracket.far - bracket.near.t()).abs() {
                near.values_mut()[0] += left;
                size = 0.0;
            }
        }
        Low {
            size,
            instant: near,
            at_end: false,
            crosses: bracket.crosses,
        }
    }
}

impl Low {
    fn end(value: f64, instant: &Instant) -> Low {
        Low {
            size: value.abs(),
            instant: instant.clone(),
            at_end: true,
            crosses: false,
        }
    }
}

impl Watched {
    /// Returns the unit of magnitudes.
    fn unit(&self) -> f64 {
        match self.part.is_relative && self.largest > 0.0 {
            true => self.largest,
            false => 1.0,
        }
    }

    /// Keeps the interval between two instants if the measure may have a minimum or a zero there.
    fn bracket(&mut self, [near, far]: [&Instant; 2], modes: &Modes, [before, after]: [Sample; 2]) {
        let h = far.t() - near.t();
        let slope = |[value, rate]: Sample| rate * value.signum() * h.signum();
        let crosses = before[0] * after[0] < 0.0;
        let [falling, rising] = [slope(before), slope(after)];
        if !(crosses || (falling < 0.0 && rising >= 0.0)) {
            return;
        }
        let [first, last] = [before[0].abs(), after[0].abs()];
        let after_first = (first - last + rising * h.abs()) / (rising - falling);
        // Negated so that concave measures and NaN are refined.
        let least = match !crosses && after_first >= 0.0 {
            true => first + falling * after_first,
            false => 0.0,
        };
        self.brackets.push(Bracket {
            least: least.min(first).min(last),
            near: near.clone(),
            modes: modes.clone(),
            far: far.t(),
            crosses,
        });
    }

    /// Records an end of the motion or a refined minimum.
    fn note(&mut self, low: Low) {
        let (size, t) = (low.size, low.instant.t());
        let same = MEASURE_TOLERANCE * self.unit();
        self.bound = self.bound.min(size);
        self.crosses |= low.crosses;
        self.sizes.push([t, size]);
        let is_first = self.first.as_ref().is_none_or(|first| {
            size < first.size - same || (size <= first.size + same && t < first.instant.t())
        });
        if is_first {
            self.first = Some(low);
        }
    }

    /// Returns the closest approach of all records; `None` without records.
    fn approach(self) -> Option<Approach> {
        let unit = self.unit();
        let sizes = self.sizes.iter().map(|&[_, size]| size);
        let smallest = sizes.min_by(f64::total_cmp)?;
        let lowest = self.sizes.iter();
        let lowest = lowest.filter(|[_, size]| *size <= smallest + MEASURE_TOLERANCE * unit);
        let mut times: Vec<f64> = lowest.map(|&[t, _]| t).collect();
        times.sort_by(f64::total_cmp);
        // An end that is also stationary counts once.
        times.dedup_by(|a, b| (*a - *b).abs() <= MEASURE_TOLERANCE);
        let first = self.first?;
        Some(Approach {
            part: self.part,
            measure: smallest / unit,
            size: smallest,
            instant: first.instant,
            times: times.len(),
            at_end: first.at_end,
            crosses: self.crosses,
        })
    }
}
