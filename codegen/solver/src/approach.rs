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

/// How many places are refined for each part, the lowest first.
const REFINED: usize = 64;

/// Measures that differ by less are the same one, come back to.
pub const SAME: f64 = 1e-9;

/// The closest approach of one part to a singular pose.
#[derive(Clone, Debug)]
pub struct Approach {
    /// The part.
    pub part: MeasuredPart,
    /// The smallest size of the measure: 0 is singular, 1 is as far from it as can be.
    pub measure: f64,
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
    ends: Vec<Low>,
    /// By the size of the measure, the lowest first.
    brackets: Vec<Bracket>,
}

/// A place between two instants at which the measure is lowest or zero.
#[derive(Clone, Debug)]
struct Bracket {
    low: f64,
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
            ends: Vec::new(),
            brackets: Vec::new(),
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
        for (place, watched) in self.watched.iter_mut().enumerate() {
            let [value, _] = samples[place];
            watched.largest = watched.largest.max(value.abs());
            match &self.last {
                None => watched.ends.push(Low::end(value, instant)),
                Some((near, modes, before)) => {
                    let measures = [before[place], samples[place]];
                    watched.bracket([near, instant], modes, measures)
                }
            }
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
                watched.ends.push(Low::end(value, &instant));
            }
        }
        let watched = std::mem::take(&mut self.watched);
        let found = watched.into_iter().enumerate();
        let found = found.filter_map(|(place, watched)| self.approach(place, watched, shell));
        found.collect()
    }

    fn approach<V: View>(
        &self,
        place: usize,
        watched: Watched,
        shell: &Shell<V>,
    ) -> Option<Approach> {
        let Watched {
            part,
            largest,
            ends: mut lowest,
            brackets,
        } = watched;
        let refined = brackets
            .iter()
            .map(|bracket| self.refine(place, bracket, shell));
        lowest.extend(refined);
        let unit = if part.is_relative && largest > 0.0 {
            largest
        } else {
            1.0
        };
        let sizes = lowest.iter().map(|it| it.size);
        let smallest = sizes.min_by(f64::total_cmp)?;
        lowest.retain(|it| it.size <= smallest + SAME * unit);
        lowest.sort_by(|a, b| a.instant.t().total_cmp(&b.instant.t()));
        // An end that is a stationary value too counts once.
        lowest.dedup_by(|a, b| (a.instant.t() - b.instant.t()).abs() <= SAME);
        let times = lowest.len();
        let crosses = lowest.iter().any(|it| it.crosses);
        let first = lowest.into_iter().next()?;
        Some(Approach {
            part,
            measure: smallest / unit,
            instant: first.instant,
            times,
            at_end: first.at_end,
            crosses,
        })
    }

    /// The last time in a bracket before the measure is stationary or zero, as closely as times can be told apart.
    fn refine<V: View>(&self, place: usize, bracket: &Bracket, shell: &Shell<V>) -> Low {
        let sample = |instant: &Instant| self.measures.at(instant)[place];
        let sign = sample(&bracket.near)[0].signum();
        let is_before = |instant: &Instant| {
            let [value, rate] = sample(instant);
            match bracket.crosses {
                true => value * sign > 0.0,
                false => rate * value.signum() < 0.0,
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
        let size = sample(&near)[0].abs();
        if bracket.crosses {
            // Nearer than the modes can be told apart the measure goes to zero at its rate.
            let [value, rate] = sample(&near);
            let left = -value / rate;
            if left.abs() <= (bracket.far - bracket.near.t()).abs() {
                near.values_mut()[0] += left;
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
    /// Remembers the place between two instants, if the measure is lowest or zero there and not above all that are remembered.
    fn bracket(&mut self, [near, far]: [&Instant; 2], modes: &Modes, [before, after]: [Sample; 2]) {
        let slope = |[value, rate]: Sample| rate * value.signum();
        let crosses = before[0] * after[0] < 0.0;
        if !(crosses || (slope(before) < 0.0 && slope(after) >= 0.0)) {
            return;
        }
        let low = if crosses {
            0.0
        } else {
            before[0].abs().min(after[0].abs())
        };
        let place = self.brackets.partition_point(|it| it.low <= low);
        if place < REFINED {
            self.brackets.truncate(REFINED - 1);
            let near = near.clone();
            self.brackets.insert(
                place,
                Bracket {
                    low,
                    near,
                    modes: modes.clone(),
                    far: far.t(),
                    crosses,
                },
            );
        }
    }
}
