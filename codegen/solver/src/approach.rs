//! *The instants of a motion, one after another* → *how close each part comes to a singular pose, and when*.
//!
//! The rates of the measures are known, so that a smallest value between two instants is found where the rate changes its sign, or
//! where the measure itself does, by bisection to the last digit of t that the solver can tell apart, and not where values happen to
//! have been sampled. Only the lowest few places are remembered. The module does not know names.

use linkwright::Shell;

use crate::instant::Instant;
use crate::measures::{MeasuredPart, Measures, Sample};
use crate::supplied::{InputLaws, Modes};
use crate::view::View;

/// How many places of each part wait to be refined: those that turn out higher than others need not be.
const WAITING: usize = 64;

/// Measures that differ by less are the same one, come back to.
pub const SAME: f64 = 1e-9;

/// The closest approach of one part to a singular pose.
#[derive(Clone, Debug)]
pub struct Approach {
    /// The part.
    pub part: MeasuredPart,
    /// The smallest size of the measure: 0 is singular, 1 is as far from it as can be.
    pub measure: f64,
    /// The same before it was divided by the largest, where only its course says how large it can be.
    pub size: f64,
    /// The instant at which it is first so small.
    pub instant: Instant,
    /// How often it is, up to [`SAME`].
    pub times: usize,
    /// Whether it is an end of the motion, where it might become smaller still beyond.
    pub at_end: bool,
    /// Whether the measure changes its sign there: the motion passes straight through a singular pose.
    pub crosses: bool,
}

/// Sees the instants of a motion in their order.
#[derive(Clone, Debug)]
pub struct Watch {
    measures: Measures,
    laws: InputLaws,
    watched: Vec<Watched>,
    last: Option<(Instant, Modes, Vec<Sample>)>,
}

/// What is remembered of a part.
#[derive(Clone, Debug)]
struct Watched {
    part: MeasuredPart,
    largest: f64,
    /// A size of the measure than which the lowest is no higher.
    bound: f64,
    /// Where it is lowest or zero, in no order.
    brackets: Vec<Bracket>,
    /// The size of the measure at the ends and at the places that were refined, and when.
    sizes: Vec<[f64; 2]>,
    /// The first of the lowest of these, up to [`SAME`], and any that is lower than it.
    first: Option<Low>,
    /// Whether the measure changes its sign at any of them.
    crosses: bool,
}

/// A place between two instants at which the measure is lowest or zero.
#[derive(Clone, Debug)]
struct Bracket {
    /// Where the tangents at both ends meet: no lower is a measure that is curved upwards.
    least: f64,
    near: Instant,
    /// The modes before it.
    modes: Modes,
    far: f64,
    crosses: bool,
}

/// An instant with the size of the measure.
#[derive(Clone, Debug)]
struct Low {
    size: f64,
    instant: Instant,
    at_end: bool,
    crosses: bool,
}

impl Watch {
    /// Nothing has been seen yet.
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

    /// Sees where a mechanism is next; gives the size of the measure of each part.
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

    /// The closest approach of every part; `shell` is any state of the mechanism.
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

    /// Refines whatever may be as low as the lowest, and forgets the rest.
    fn refine_all<V: View>(&mut self, shell: &Shell<V>) {
        let mut all = std::mem::take(&mut self.watched);
        for (place, watched) in all.iter_mut().enumerate() {
            let brackets = std::mem::take(&mut watched.brackets);
            for bracket in &brackets {
                if bracket.least <= watched.bound + SAME * watched.unit() {
                    watched.note(self.refine(place, bracket, shell));
                }
            }
        }
        self.watched = all;
    }

    /// The last time in a bracket before the measure is stationary or zero, as closely as times can be told apart.
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
            // Nearer than the modes can be told apart the measure goes to zero at its rate.
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
    /// What sizes are compared with.
    fn unit(&self) -> f64 {
        match self.part.is_relative && self.largest > 0.0 {
            true => self.largest,
            false => 1.0,
        }
    }

    /// Remembers the place between two instants, if the measure is lowest or zero there.
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
        // Written so that what is curved downwards, or is no number, is refined.
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

    /// Takes an end, or a place that was refined.
    fn note(&mut self, low: Low) {
        let (size, t) = (low.size, low.instant.t());
        let same = SAME * self.unit();
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

    /// The closest approach of all that was noted.
    fn approach(self) -> Option<Approach> {
        let unit = self.unit();
        let sizes = self.sizes.iter().map(|&[_, size]| size);
        let smallest = sizes.min_by(f64::total_cmp)?;
        let lowest = self.sizes.iter();
        let lowest = lowest.filter(|[_, size]| *size <= smallest + SAME * unit);
        let mut times: Vec<f64> = lowest.map(|&[t, _]| t).collect();
        times.sort_by(f64::total_cmp);
        // An end that is a stationary value too counts once.
        times.dedup_by(|a, b| (*a - *b).abs() <= SAME);
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
