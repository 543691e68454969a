//! Follows the poses of one degree of freedom, and brackets the zeros of the force along them.
//!
//! The curve of poses is followed by its length, so that dead centers of the free coordinate do not matter.

use std::f64::consts::TAU;

use nalgebra::DVector;

use super::statics::{PoseForces, StaticEquations};

/// Longest step along the curve, scaled.
const STEP: f64 = 0.05;

/// Shortest step, as a part of the longest.
const SHORTEST: f64 = 1e-5;

/// Smallest cosine of the turn of the tangent in a step.
const STRAIGHT: f64 = 0.98;

/// Largest number of steps along a curve.
const MAX_STEPS: usize = 20_000;

/// Distance from the start up to which a free length is followed, in characteristic lengths.
const REACH: f64 = 20.0;

/// Scaled distance within which a pose is that of the start.
const CLOSED: f64 = 1e-7;

/// Halvings of a bracket.
const HALVINGS: usize = 100;

/// Place on a curve.
#[derive(Clone, Debug)]
pub(super) struct Sample {
    pub unknowns: Vec<f64>,
    /// Unit vector along the curve, scaled.
    pub tangent: DVector<f64>,
    /// Force along it (J).
    force: f64,
    /// Negative slope of the force (J).
    stiffness: f64,
    /// True if the force is rounding.
    pub is_quiet: bool,
}

/// End of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CurveEnd {
    /// The curve returns to its start.
    Closed,
    /// The free coordinate is a full turn, or far, from the start.
    Window,
    /// No pose continues: the constraints lose rank.
    Singular,
}

/// Curve of poses.
#[derive(Clone, Debug)]
pub(super) struct Curve {
    pub samples: Vec<Sample>,
    pub ends: [CurveEnd; 2],
    /// Whole turns of all unknowns around a closed curve (SI units); `None` for an open one.
    period: Option<Vec<f64>>,
}

impl Sample {
    fn of(equations: &StaticEquations, pose: &PoseForces, ahead: Option<&DVector<f64>>) -> Sample {
        let column = pose.basis.column(0).into_owned();
        let is_back = ahead.is_some_and(|it| it.dot(&column) < 0.0);
        let sign = if is_back { -1.0 } else { 1.0 };
        let stiffness = pose.stiffness(equations);
        let force = sign * pose.force[0];
        Sample {
            unknowns: pose.unknowns.clone(),
            is_quiet: force.abs() <= pose.rounding(&column, &stiffness),
            tangent: sign * column,
            force,
            stiffness: stiffness.reduced[(0, 0)],
        }
    }

    /// Returns the sample at a distance along the tangent.
    fn moved(&self, equations: &StaticEquations, distance: f64) -> Option<Sample> {
        let estimate = equations.stepped(&self.unknowns, &(&self.tangent * distance));
        let pose = equations.closed(estimate.clone())?;
        let correction = equations.difference(&pose.unknowns, &estimate).norm();
        let next = Sample::of(equations, &pose, Some(&self.tangent));
        let is_near =
            correction <= distance.abs() + CLOSED && next.tangent.dot(&self.tangent) >= STRAIGHT;
        is_near.then_some(next)
    }

    fn backwards(&self) -> Sample {
        Sample {
            tangent: -&self.tangent,
            force: -self.force,
            ..self.clone()
        }
    }
}

impl Curve {
    /// Follows the curve through a pose both ways, at most a full turn of a free angle from `origin`. `see` is called at each step.
    pub fn through(
        equations: &StaticEquations,
        start: &PoseForces,
        origin: &[f64],
        see: &mut dyn FnMut(),
    ) -> Curve {
        let first = Sample::of(equations, start, None);
        let (forward, end) = followed(equations, start, &first, origin, see);
        let mut samples = vec![first.clone()];
        samples.extend(forward);
        if end == CurveEnd::Closed {
            return Curve::closed(equations, samples);
        }
        let (back, other) = followed(equations, start, &first.backwards(), origin, see);
        let back = back.iter().rev().map(Sample::backwards);
        if other == CurveEnd::Closed {
            return Curve::closed(equations, back.chain([first]).collect());
        }
        Curve {
            samples: back.chain(samples).collect(),
            ends: [other, end],
            period: None,
        }
    }

    /// Creates a closed curve, whose last sample is at the first one or just behind it.
    fn closed(equations: &StaticEquations, samples: Vec<Sample>) -> Curve {
        let ends = samples.first().zip(samples.last());
        let period = ends.map(|(first, last)| {
            let turns = last.unknowns.iter().zip(&first.unknowns).enumerate();
            let turns = turns.map(|(place, (to, from))| match equations.is_angle(place) {
                true => TAU * ((to - from) / TAU).round(),
                false => 0.0,
            });
            turns.collect()
        });
        Curve {
            samples,
            ends: [CurveEnd::Closed; 2],
            period,
        }
    }

    /// Returns unknowns on the curve with the free coordinate less than half a period from that of the start.
    pub fn unwound(&self, mut unknowns: Vec<f64>, start: &[f64]) -> Vec<f64> {
        let period = self.period.as_deref().unwrap_or_default();
        let Some(&turn) = period.last().filter(|it| **it != 0.0) else {
            return unknowns;
        };
        // The free coordinate is the last unknown.
        let last = unknowns.len() - 1;
        let away = (unknowns[last] - start[last]) / turn.abs();
        let count = (away - 0.5 * (1.0 + CLOSED)).ceil() * turn.signum();
        for (value, turn) in unknowns.iter_mut().zip(period) {
            *value -= count * turn;
        }
        unknowns
    }

    /// True if a pose is on the curve, up to full turns.
    pub fn passes(&self, equations: &StaticEquations, pose: &PoseForces) -> bool {
        let mut samples = self.samples.iter();
        samples.any(|it| {
            let away = equations.turned_difference(&pose.unknowns, &it.unknowns);
            if away.norm() > 2.0 * STEP {
                return false;
            }
            let beside = it.moved(equations, away.dot(&it.tangent));
            beside.is_some_and(|it| {
                let away = equations.turned_difference(&pose.unknowns, &it.unknowns);
                let across = &away - &it.tangent * away.dot(&it.tangent);
                across.norm() <= 0.1 * STEP * STEP
            })
        })
    }

    /// True if the force is rounding everywhere.
    pub fn is_quiet(&self) -> bool {
        self.samples.iter().all(|it| it.is_quiet)
    }

    /// Returns poses without force, to the precision of bisection.
    pub fn zeros(&self, equations: &StaticEquations) -> Vec<Vec<f64>> {
        let mut zeros = Vec::new();
        for pair in self.samples.windows(2) {
            let [one, other] = [&pair[0], &pair[1]];
            if one.is_quiet || other.is_quiet {
                let quiet = if one.is_quiet { one } else { other };
                zeros.push(quiet.unknowns.clone());
            }
            let length = equations
                .difference(&other.unknowns, &one.unknowns)
                .dot(&one.tangent);
            if one.force * other.force < 0.0 {
                zeros.push(bisected(equations, one, [0.0, length], |it| it.force));
                continue;
            }
            // A force that has an extremum towards zero may touch zero there, or cross it twice.
            let is_valley = one.force * one.stiffness > 0.0 && other.force * other.stiffness < 0.0;
            if !is_valley {
                continue;
            }
            let low = bisected(equations, one, [0.0, length], |it| it.stiffness);
            let middle = equations.difference(&low, &one.unknowns).dot(&one.tangent);
            let Some(lowest) = one.moved(equations, middle) else {
                continue;
            };
            if lowest.is_quiet {
                zeros.push(lowest.unknowns);
            } else if lowest.force * one.force < 0.0 {
                for side in [[0.0, middle], [middle, length]] {
                    zeros.push(bisected(equations, one, side, |it| it.force));
                }
            }
        }
        zeros
    }
}

/// Follows the curve along the tangent of a sample.
fn followed(
    equations: &StaticEquations,
    start: &PoseForces,
    first: &Sample,
    origin: &[f64],
    see: &mut dyn FnMut(),
) -> (Vec<Sample>, CurveEnd) {
    let mut samples: Vec<Sample> = Vec::new();
    let (mut length, mut walked) = (STEP, 0.0);
    while samples.len() < MAX_STEPS {
        let last = samples.last().unwrap_or(first);
        let Some(next) = last.moved(equations, length) else {
            length *= 0.5;
            if length < SHORTEST * STEP {
                return (samples, CurveEnd::Singular);
            }
            continue;
        };
        walked += length;
        see();
        let is_away = walked > 3.0 * STEP;
        let is_closed = is_away && is_at(equations, start, &next, length);
        let is_outside = is_outside(equations, &next.unknowns, origin);
        samples.push(next);
        if is_closed {
            return (samples, CurveEnd::Closed);
        }
        if is_outside {
            return (samples, CurveEnd::Window);
        }
        length = (2.0 * length).min(STEP);
    }
    (samples, CurveEnd::Window)
}

/// True if the start is within the last step, with the same loads.
fn is_at(equations: &StaticEquations, start: &PoseForces, last: &Sample, length: f64) -> bool {
    let away = equations.turned_difference(&start.unknowns, &last.unknowns);
    let along = away.dot(&last.tangent);
    if away.norm() > 2.0 * length || along > 0.0 {
        return false;
    }
    let estimate = equations.stepped(&last.unknowns, &(&last.tangent * along));
    let Some(mut pose) = equations.closed(estimate) else {
        return false;
    };
    for _ in 0..3 {
        let away = equations.turned_difference(&start.unknowns, &pose.unknowns);
        match equations.moved(&pose, &pose.basis.tr_mul(&away)) {
            Some(moved) => pose = moved,
            None => return false,
        }
    }
    equations.is_same(start, &pose, CLOSED)
}

/// True if a free coordinate is more than a full turn, or far, from the origin.
pub(super) fn is_outside(equations: &StaticEquations, unknowns: &[f64], origin: &[f64]) -> bool {
    let away = equations.difference(unknowns, origin);
    let free = equations.count() - equations.motion.free_count()..equations.count();
    free.into_iter().any(|place| {
        let limit = if equations.is_angle(place) {
            TAU
        } else {
            REACH
        };
        away[place].abs() > limit * (1.0 + CLOSED)
    })
}

/// Halves a bracket between distances along the tangent of a sample, between which a value changes its sign.
fn bisected(
    equations: &StaticEquations,
    from: &Sample,
    [mut low, mut high]: [f64; 2],
    value: impl Fn(&Sample) -> f64,
) -> Vec<f64> {
    let at = |distance: f64| from.moved(equations, distance);
    let before = at(low).map_or(value(from), |it| value(&it));
    let mut best = from.unknowns.clone();
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        let Some(sample) = at(middle) else { break };
        best.clone_from(&sample.unknowns);
        match value(&sample) {
            0.0 => break,
            it if it * before > 0.0 => low = middle,
            _ => high = middle,
        }
        if high - low <= f64::EPSILON * STEP {
            break;
        }
    }
    best
}
