//! *What `advance` has made of a schedule, and where the smooth path goes* → *an outcome of every step*.

use linkwright::Signal;
use linkwright_solver::textbook::TextbookEquations;
use linkwright_solver::{InputSignals, Numbers};
use nalgebra::DVector;

use super::course::{Course, quintic, straight};
use super::stepping::{Given, SMALLER, Schedule, Stepped, Target};
use super::tally::Outcome;
use super::trace::{End, Trace, Tracer};

/// The part of its scale by which a coordinate may be off the path, and the same for what rounding makes of a Jacobian with a
/// smallest pivot of 1; at most.
pub struct Tolerance {
    /// Everywhere.
    pub least: f64,
    /// Divided by the smallest pivot.
    pub rounding: f64,
    /// At most.
    pub most: f64,
}

/// For f64.
pub const DOUBLE: Tolerance = Tolerance {
    least: 1e-6,
    rounding: 1e-11,
    most: 1e-3,
};

/// For f32.
pub const SINGLE: Tolerance = Tolerance {
    least: 2e-3,
    rounding: 1e-4,
    most: 0.05,
};

/// The longest steps of the tracker, in shortest periods and in the length of a step.
const LONGEST: [f64; 2] = [1.0 / 160.0, 1.0 / 8.0];

/// Longest step of the tracker where time stands still, as a part of the whole way.
const STANDING: f64 = 1.0 / 64.0;

/// How near to an end nothing is judged, in steps and in shortest periods.
const NEAR_END: f64 = 1e-5;

/// How far the tracker's polynomials may be from the equations, in scales.
const NEAR_POSE: f64 = 1e-4;

/// By how much a failure may miss the time of an end, in steps.
const MISSED_END: f64 = 1.0 / 64.0;

/// What is true of a course.
pub struct Truth<'a> {
    /// The course.
    pub course: &'a Course,
    /// Its equations.
    pub equations: &'a TextbookEquations,
    /// The scales of the coordinates.
    pub scales: &'a [f64],
}

/// A path with the inputs along it. Where time stands still, the part of the way takes the place of time.
struct Leg {
    trace: Trace,
    /// The times and the inputs at its ends.
    ends: [(f64, Vec<Given>); 2],
}

impl Leg {
    fn is_standing(&self) -> bool {
        self.ends[0].0 == self.ends[1].0
    }

    fn inputs_at(&self, t: f64) -> Vec<Given> {
        let [(from, first), (to, last)] = &self.ends;
        let h = to - from;
        let both = first.iter().zip(last);
        match self.is_standing() {
            true => both.map(|(a, b)| straight(*a, *b, t)).collect(),
            false => both
                .map(|(a, b)| quintic(*a, *b, h, (t - from) / h))
                .collect(),
        }
    }

    /// The inputs with their derivatives by what takes the place of time.
    fn driven_at(&self, t: f64) -> Vec<Given> {
        if !self.is_standing() {
            return self.inputs_at(t);
        }
        let [(_, first), (_, last)] = &self.ends;
        let both = first.iter().zip(last);
        both.map(|(a, b)| [straight(*a, *b, t)[0], b[0] - a[0], 0.0])
            .collect()
    }
}

impl Truth<'_> {
    /// Supplies inputs to the equations.
    fn supply(&self, given: &[Given]) {
        let signals = given.iter().map(|it| Signal::new(it[0], it[1], it[2]));
        self.equations
            .supply(&Numbers::default(), &InputSignals(signals.collect()));
    }

    fn tracer<'b>(&'b self, longest: f64, supply: &'b dyn Fn(f64)) -> Tracer<'b> {
        Tracer {
            equations: self.equations,
            scales: self.scales,
            longest,
            loops: self.course.loops,
            supply,
        }
    }

    /// The path of a law of t; `None` where it cannot be followed.
    pub fn whole(&self, start: &DVector<f64>) -> Option<Trace> {
        let [from, until] = self.course.span;
        let tracer = self.tracer(LONGEST[0] * self.course.period, &|_| {});
        tracer.trace(start, from, until)
    }

    fn leg(&self, start: &DVector<f64>, first: (f64, Vec<Given>), last: &Target) -> Option<Leg> {
        let from = first.0;
        let mut leg = Leg {
            trace: Trace::default(),
            ends: [first, (last.t, last.inputs.clone())],
        };
        let supply = |t: f64| self.supply(&leg.driven_at(t));
        leg.trace = match leg.is_standing() {
            true => self.tracer(STANDING, &supply).trace(start, 0.0, 1.0)?,
            false => {
                let way = (last.t - from).abs();
                let longest = (LONGEST[0] * self.course.period).min(LONGEST[1] * way);
                self.tracer(longest, &supply).trace(start, from, last.t)?
            }
        };
        Some(leg)
    }

    /// The path of inputs that stay where they are at the beginning: its pose is that of the assembly.
    pub fn still(&self, start: &DVector<f64>) -> Option<Trace> {
        let from = self.course.span[0];
        let given = self.course.given(from);
        let supply = |_| self.supply(&given);
        self.tracer(LONGEST[0] * self.course.period, &supply)
            .trace(start, from, from)
    }

    /// The pose of the equations that is near one.
    fn polished(&self, near: &DVector<f64>, t: f64, leg: Option<&Leg>) -> Option<DVector<f64>> {
        let supply = |t: f64| {
            if let Some(leg) = leg {
                self.supply(&leg.driven_at(t));
            }
        };
        let tracer = self.tracer(self.course.period, &supply);
        let polished = tracer.solved(near, t)?;
        (tracer.size(&(&polished - near)) < NEAR_POSE).then_some(polished)
    }

    /// The largest part of its scale by which a pose is off.
    fn off(&self, found: &[f64], exact: &DVector<f64>) -> (f64, usize) {
        let all = found.iter().zip(exact.iter()).zip(self.scales).enumerate();
        let mut worst = (0.0, 0);
        for (place, ((found, exact), scale)) in all {
            let off = (found - exact).abs() / scale;
            // Written so that NaN is worst.
            let is_less = off <= worst.0;
            if !is_less {
                worst = (off, place);
            }
        }
        worst
    }

    /// An outcome for every step, with the size of the step in shortest periods where it is the first of its target.
    pub fn judge(
        &self,
        path: &Trace,
        schedule: &Schedule,
        steps: &[Stepped],
        tolerance: &Tolerance,
        compared: &dyn Fn(&DVector<f64>) -> Option<DVector<f64>>,
    ) -> Vec<(Outcome, Option<f64>)> {
        let has_inputs = !self.course.inputs.is_empty();
        let mut last = (
            schedule.targets[0].t,
            schedule.targets[0].inputs.clone(),
            path.first().q.clone(),
        );
        let mut leg: Option<Leg> = None;
        let mut is_lost = false;
        let mut outcomes = Vec::new();
        for step in steps {
            let target = &schedule.targets[step.target];
            let is_whole = step.part == 0 && step.target > 0;
            let whole = target.t - last.0;
            let size =
                (is_whole && !self.course.is_standing).then(|| whole.abs() / self.course.period);
            if step.target == 0 {
                outcomes.push((Outcome::Unjudged, None));
                continue;
            }
            if has_inputs && step.part == 0 {
                leg = self.leg(&last.2, (last.0, last.1.clone()), target);
            }
            let is_standing = leg.as_ref().is_some_and(Leg::is_standing);
            let own = leg.as_ref().map(|leg| &leg.trace);
            let Some(trace) = (if has_inputs { own } else { Some(path) }) else {
                outcomes.push((Outcome::Unjudged, None));
                is_lost = true;
                continue;
            };
            let t = match (is_standing, step.part) {
                (false, _) => step.t,
                (true, 0) => 1.0,
                (true, part) => f64::from(part) / f64::from(SMALLER),
            };
            let exact = trace.at(t);
            let (beyond, late) = match trace.end {
                End::Open => (None, 0.0),
                End::Singular(end, latest) => (Some(end), (latest - end).abs()),
                End::Unknown(end) => (Some(end), 0.0),
            };
            let near = match is_standing {
                true => NEAR_END + late,
                false => NEAR_END * whole.abs().min(self.course.period) + late,
            };
            let is_near_end = beyond.is_some_and(|end| (t - end).abs() <= near);
            // Where rounding decides how it goes on, it is not known either.
            let is_decided = !self.course.is_blurred || trace.is_before_crossings(t);
            let is_unknown = !is_decided
                || exact.is_none()
                    && (self.course.is_blurred || matches!(trace.end, End::Unknown(_)));
            let outcome = match (&step.answer, exact) {
                (answer, exact) if is_lost || is_near_end || is_unknown => {
                    // Inputs go on from there, even where nothing is judged.
                    match (answer, exact, &leg) {
                        (Ok(_), Some((exact, _)), Some(leg)) if has_inputs => {
                            last = (step.t, leg.inputs_at(t), exact);
                        }
                        (Ok(_), None, _) => is_lost |= has_inputs,
                        _ => (),
                    }
                    Outcome::Unjudged
                }
                (Ok(found), Some((exact, pivot))) => {
                    let limit = (tolerance.least + tolerance.rounding / pivot).min(tolerance.most);
                    let (mut off, mut place) = match compared(&exact) {
                        None => self.off(found, &exact),
                        Some(points) => {
                            let parts = found.iter().zip(points.iter());
                            let off = parts.map(|(a, b)| (a - b).abs() / self.course.size);
                            (off.fold(0.0, |a: f64, b| if b <= a { a } else { b }), 0)
                        }
                    };
                    // Between two states of the tracker the law may have a kink.
                    let is_near = off <= limit;
                    if !is_near
                        && compared(&exact).is_none()
                        && let Some(polished) =
                            self.polished(&exact, t, leg.as_ref().filter(|_| has_inputs))
                    {
                        (off, place) = self.off(found, &polished);
                    }
                    if off <= limit {
                        let inputs = match &leg {
                            Some(leg) if has_inputs => leg.inputs_at(t),
                            _ => Vec::new(),
                        };
                        last = (step.t, inputs, exact);
                        Outcome::Correct
                    } else {
                        Outcome::Another(format!(
                            "coordinate {place} off by {off:.1e} of its scale, {} instead of {}, pivot {pivot:.1e}",
                            found.get(place).copied().unwrap_or(f64::NAN),
                            exact[place.min(exact.len() - 1)],
                        ))
                    }
                }
                (Ok(_), None) => {
                    Outcome::Beyond(format!("which is at t = {}", beyond.unwrap_or(f64::NAN)))
                }
                (Err((kind, _)), Some(_)) => Outcome::Refused(kind.clone()),
                (Err((_, time)), None) => {
                    let end = beyond.unwrap_or(f64::NAN);
                    let allowed = MISSED_END * (t - last.0).abs() + near;
                    Outcome::Ended {
                        is_named: match is_standing {
                            true => *time == step.t,
                            false => (time - end).abs() <= allowed,
                        },
                    }
                }
            };
            let is_wrong = matches!(outcome, Outcome::Another(_) | Outcome::Beyond(_));
            // What follows a wrong step begins elsewhere.
            is_lost |= is_wrong || !is_decided;
            if is_lost && !is_wrong {
                outcomes.push((Outcome::Unjudged, None));
                continue;
            }
            outcomes.push((outcome, size));
        }
        outcomes
    }
}
