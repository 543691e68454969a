//! Follows a mechanism along a line of drive values to the first event.
//!
//! The time of the shell is the length along the line. Steps become shorter towards singular poses, so that a change point is not passed
//! unseen. An end is enclosed by bisection to the last digit that the solver resolves.

use linkwright::{Failure, Shell};

use crate::instant::Instant;
use crate::interpreted::Interpreted;
use crate::measure_watch::MeasureWatch;
use crate::measures::{Measures, Sample};
use crate::supplied::{InputLaws, Modes};
use crate::view::View;

/// Part of the distance to a zero of a measure, along its tangent, that a step may cover.
const TOWARDS_ZERO: f64 = 0.5;

/// Shortest step for the sake of measures, as a part of the longest.
const SHORTEST: f64 = 1.0 / 64.0;

/// Number of places that are kept.
const MAX_PLACES: usize = 160;

/// Pose on the line.
#[derive(Clone, Debug)]
pub(crate) struct Place {
    /// Instant; its time is the length along the line.
    pub instant: Instant,
    pub modes: Modes,
}

/// TravelEvent that ends a line.
#[derive(Clone, Copy, Debug)]
pub(crate) enum TravelEvent {
    /// No pose continues.
    Failed(Failure),
    /// A measure of singularity, an index into the measured parts, changes its sign.
    Crossed(usize),
    /// A limit, an index into the mechanism's limits, is broken.
    Limit(usize),
    /// The requested length is reached.
    Complete,
}

/// End of a line.
#[derive(Clone, Debug)]
pub(crate) struct LineEnd {
    /// Last places, the farthest last; never empty.
    pub places: Vec<Place>,
    /// Length of the event: the smallest one beyond it, or that of a change point.
    pub outside: f64,
    pub event: TravelEvent,
}

/// Line of drive values from a pose.
pub(crate) struct DriveLine<'a> {
    pub laws: &'a InputLaws,
    pub measures: &'a Measures,
    /// Length of the longest step.
    pub step: f64,
    /// Length to which an event is enclosed; 0 for the last digit.
    pub precision: f64,
}

/// Position of a mechanism on a line.
struct Walk<'a> {
    line: &'a DriveLine<'a>,
    shell: Shell<Interpreted>,
    samples: Vec<Sample>,
    watch: Option<MeasureWatch>,
    places: Vec<Place>,
}

impl DriveLine<'_> {
    /// Follows the line from the last frame of a shell to the length `end`; `see` receives every length that is reached.
    pub fn follow(&self, shell: Shell<Interpreted>, end: f64, mut see: impl FnMut(f64)) -> LineEnd {
        let is_limited = !shell.blocks().system().mechanism.limits.is_empty();
        let watch = match is_limited {
            true => MeasureWatch::new(shell.blocks()),
            false => None,
        };
        let mut walk = Walk {
            samples: self.measures.at(shell.frame()),
            watch: watch.map(|it| it.along(self.laws.clone())),
            places: vec![Place::of(&shell)],
            shell,
            line: self,
        };
        if let Some(watch) = &mut walk.watch {
            watch.see(&walk.shell);
            if let Some((limit, at)) = watch.first_broken() {
                return walk.ended(at, TravelEvent::Limit(limit));
            }
        }
        // Length at which no pose was found, with the failure.
        let mut beyond: Option<(f64, Failure)> = None;
        // Distance before a failure at which the next pose is tried; bisection if the last digit matters.
        let mut back = match self.precision > 0.0 {
            true => 0.125 * self.precision,
            false => f64::INFINITY,
        };
        loop {
            let at = walk.shell.frame().t();
            if at >= end {
                return walk.ended(end, TravelEvent::Complete);
            }
            let next = match &beyond {
                // A failure with its time has located the end as closely as steps reach it.
                Some((beyond, _)) => (at + 0.5 * (beyond - at)).max(beyond - back),
                None => (at + walk.step()).min(end),
            };
            if let Some((outside, failure)) = beyond
                && (next <= at || next >= outside || outside - at <= self.precision)
            {
                return walk.ended(outside, TravelEvent::Failed(failure));
            }
            match walk.to(next) {
                Ok(None) => see(next),
                Ok(Some((outside, event))) => return walk.ended(outside, event),
                Err(failure) if next <= at => {
                    return walk.ended(next, TravelEvent::Failed(failure));
                }
                Err(failure) => {
                    let located = failure.time + 0.5 * self.precision;
                    let is_located = self.precision > 0.0 && failure.time > at;
                    let outside = if is_located { located.min(next) } else { next };
                    beyond = Some((outside, failure));
                    back = if is_located {
                        8.0 * back.min(end)
                    } else {
                        back
                    };
                }
            }
        }
    }

    /// Returns the mechanism at a length, reached from a place without an event; `None` if an event comes first.
    pub fn reached(
        &self,
        place: &Place,
        t: f64,
        shell: &Shell<Interpreted>,
    ) -> Option<Shell<Interpreted>> {
        let mut shell = self.resumed(place, shell);
        if t != place.instant.t() {
            shell.advance(t, &self.laws.at(t)).ok()?;
        }
        let samples = self.measures.at(&place.instant);
        let is_same = crossed(&samples, &self.measures.at(shell.frame())).is_none()
            && *shell.branches() == place.modes;
        (is_same && broken(&shell).is_none()).then_some(shell)
    }

    /// Returns the mechanism at a length, reached from a place on whatever path; `None` if it cannot be reached.
    pub fn passed(
        &self,
        place: &Place,
        t: f64,
        shell: &Shell<Interpreted>,
    ) -> Option<Shell<Interpreted>> {
        let mut shell = self.resumed(place, shell);
        shell.advance(t, &self.laws.at(t)).ok()?;
        Some(shell)
    }

    /// Returns the mechanism in a place.
    pub fn resumed(&self, place: &Place, shell: &Shell<Interpreted>) -> Shell<Interpreted> {
        let mut shell = shell.clone();
        shell.resume(
            &place.instant,
            &place.modes,
            &self.laws.at(place.instant.t()),
        );
        shell
    }
}

impl Walk<'_> {
    /// Returns the length of the next step: towards zero of a measure, only a part of the distance.
    fn step(&self) -> f64 {
        let longest = self.line.step;
        let distances = self
            .samples
            .iter()
            .map(|[value, rate]| match value * rate < 0.0 {
                true => TOWARDS_ZERO * (value / rate).abs(),
                false => longest,
            });
        distances.fold(longest, f64::min).max(SHORTEST * longest)
    }

    /// Moves to a length. Returns an event on the way with a length beyond it; the walk then ends before it.
    fn to(&mut self, t: f64) -> Result<Option<(f64, TravelEvent)>, Failure> {
        let before = Place::of(&self.shell);
        self.shell.advance(t, &self.line.laws.at(t))?;
        let samples = self.line.measures.at(self.shell.frame());
        let passed = crossed(&self.samples, &samples).or_else(|| {
            let is_same = *self.shell.branches() == before.modes;
            (!is_same).then(|| smallest(&self.samples))
        });
        let crossing = passed.map(|part| (part, self.enclosed(part, &before, t)));
        let limit = self.watch.as_mut().and_then(|watch| {
            watch.see(&self.shell);
            watch.first_broken()
        });
        let event = match (crossing, limit) {
            (Some((part, at)), Some((_, broken))) if at <= broken => {
                Some((at, TravelEvent::Crossed(part)))
            }
            (_, Some((limit, broken))) => Some((broken, TravelEvent::Limit(limit))),
            (Some((part, at)), None) => Some((at, TravelEvent::Crossed(part))),
            (None, None) => None,
        };
        if event.is_none() {
            self.samples = samples;
            if self.places.len() >= MAX_PLACES {
                self.places.drain(..MAX_PLACES / 2);
            }
            self.places.push(Place::of(&self.shell));
        }
        Ok(event)
    }

    /// Returns the length at which a measure passes through zero, between a place and a length beyond.
    ///
    /// Bisection comes as close to the zero as the solver resolves poses. The measure is linear from there to the nearest pose beyond.
    fn enclosed(&mut self, part: usize, from: &Place, beyond: f64) -> f64 {
        let mut inside = from.clone();
        let mut outside = beyond;
        loop {
            let at = inside.instant.t();
            let middle = at + 0.5 * (outside - at);
            if middle <= at || middle >= outside || outside - at <= self.line.precision {
                break;
            }
            match self.line.reached(&inside, middle, &self.shell) {
                Some(shell) => {
                    inside = Place::of(&shell);
                    self.places.push(inside.clone());
                }
                None => outside = middle,
            }
        }
        let at = inside.instant.t();
        let near = self.line.measures.at(&inside.instant)[part][0];
        let mut gap = (f64::EPSILON * at.abs().max(self.line.step)).max(self.line.precision);
        while at + gap < beyond {
            let far = self.line.passed(&inside, at + gap, &self.shell);
            let far = far.map(|shell| self.line.measures.at(shell.frame())[part][0]);
            if let Some(far) = far.filter(|far| far * near < 0.0) {
                return (at + gap * near / (near - far)).clamp(at, at + gap);
            }
            gap *= 2.0;
        }
        outside
    }

    /// Returns the end of the line. The last place is next to the event.
    fn ended(mut self, outside: f64, event: TravelEvent) -> LineEnd {
        // A crossing is enclosed before a limit that comes first is known.
        self.places.retain(|it| it.instant.t() <= outside);
        LineEnd {
            places: self.places,
            outside,
            event,
        }
    }
}

impl Place {
    pub fn of(shell: &Shell<Interpreted>) -> Place {
        Place {
            instant: shell.frame().clone(),
            modes: shell.branches().clone(),
        }
    }
}

/// Returns the first part whose measure changes its sign.
pub(crate) fn crossed(before: &[Sample], after: &[Sample]) -> Option<usize> {
    let mut pairs = before.iter().zip(after);
    pairs.position(|([before, _], [after, _])| before * after < 0.0)
}

/// Returns the part with the smallest measure.
fn smallest(samples: &[Sample]) -> usize {
    let parts = samples.iter().enumerate();
    let least = parts.min_by(|(_, a), (_, b)| a[0].abs().total_cmp(&b[0].abs()));
    least.map_or(0, |(part, _)| part)
}

/// Returns a limit that a frame breaks.
pub(crate) fn broken(shell: &Shell<Interpreted>) -> Option<usize> {
    let limits = &shell.blocks().system().mechanism.limits;
    if limits.is_empty() {
        return None;
    }
    let values = View::reported(shell.blocks(), shell.frame())?;
    let count = shell.blocks().system().mechanism.measurements.len();
    let measures = &values[values.len() - count..];
    limits
        .iter()
        .position(|limit| limit.margin(measures[limit.measurement]) < 0.0)
}
