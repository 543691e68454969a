//! Smooth path from a pose over an interval of time, with the pose at any time of it and its end.
//!
//! A tracker with tiny steps on the dense textbook equations, which shares nothing with the runtime. It pivots
//! completely, and its steps are so short that the Taylor polynomial misses by less than `MISS` and the rates do not
//! jump. Where the Jacobian becomes singular at finite rates, it extrapolates from a distance at which everything is
//! well known: a smooth curve has one continuation. Where the rates grow without bound, the path ends, and the
//! smallest pivot gives the remaining time.

use linkwright::Equations;
use linkwright_solver::textbook::TextbookEquations;
use nalgebra::{DMatrix, DVector, Dyn, FullPivLU};

type Factors = FullPivLU<f64, Dyn, Dyn>;

/// Largest deviation of a coordinate from the Taylor polynomial, relative to its scale.
const MISS: f64 = 1e-4;

/// Largest deviation of a coordinate from Hermite's rule, relative to its scale.
const DEFECT: f64 = 1e-6;

/// Largest relative deviation of a rate from its own polynomial.
const JUMP: f64 = 0.03;

/// Largest motion of a coordinate at rest in the longest step, relative to its scale.
const REST_LIMIT: f64 = 1e-5;

/// Correction below which only rounding is left.
const SETTLED: f64 = 1e-10;

/// Fraction of the first smallest pivot that must be left: rounding then moves a pose by far less than its distance
/// from the singular one.
const REGULAR: f64 = 3e-6;

/// Largest number of halvings of the longest step.
const HALVINGS: i32 = 30;

/// Fraction of the distance to a singular pose before which the pose is not yet reached.
const CLEAR: f64 = 1e-6;

/// Largest number of states of a path, and additional ones for each longest step.
const STATES: [usize; 2] = [500, 100];

/// Growth of the rates at which a path ends.
const GROWN: f64 = 30.0;

/// Distances before and beyond a singular pose over which the path is extrapolated, in longest steps.
const LEAPS: [f64; 5] = [0.3, 0.1, 0.03, 0.01, 0.003];

/// Largest error of extrapolation, relative to the distance across a singular pose.
const MISSED_LEAP: f64 = 1e-5;

/// Fall of a smallest pivot after which its rate is taken: far above its rounding.
const FALLEN: f64 = 1.3;

/// Remainder of a path, in the times that the tangent of the smallest pivot gives: half of one at a fold, two where a
/// slide goes to infinity.
const TANGENTS: f64 = 4.0;

/// Continuation of a path.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum End {
    /// Beyond the last requested time.
    #[default]
    Open,
    /// It ends at a singular pose, after the first time and before the second (s).
    Singular(f64, f64),
    /// Unknown after this time (s).
    Unknown(f64),
}

/// A pose with its motion.
#[derive(Clone, Debug)]
pub struct State {
    /// Time (s).
    pub t: f64,
    /// The coordinates.
    pub q: DVector<f64>,
    qd: DVector<f64>,
    qdd: DVector<f64>,
    is_negative: bool,
    /// Smallest pivot of the scaled Jacobian.
    pub pivot: f64,
}

/// Followed path.
#[derive(Clone, Debug, Default)]
pub struct Trace {
    states: Vec<State>,
    /// Continuation of the path.
    pub end: End,
    /// Times at which the path passed a singular pose (s).
    pub crossings: Vec<f64>,
}

/// Equations to follow.
pub struct Tracer<'a> {
    /// The equations.
    pub equations: &'a TextbookEquations,
    /// Scales of the coordinates.
    pub scales: &'a [f64],
    /// Longest step (s), shorter than the time in which anything changes.
    pub longest: f64,
    /// Number of loops that become singular at once: each changes the sign of the determinant.
    pub loops: usize,
    /// Supplies the inputs at a time, if there are any.
    pub supply: &'a dyn Fn(f64),
}

impl Trace {
    /// First state.
    pub fn first(&self) -> &State {
        self.states.first().expect("never empty")
    }

    /// Last state.
    pub fn last(&self) -> &State {
        self.states.last().expect("never empty")
    }

    /// True if the path has not yet passed a singular pose.
    pub fn is_before_crossings(&self, t: f64) -> bool {
        let start = self.first().t;
        let first = self.crossings.first();
        first.is_none_or(|crossing| {
            (t - start).abs() < (crossing - start).abs() - CLEAR * (crossing - start).abs()
        })
    }

    /// Upper bound on the time until the smallest pivot is zero (s).
    fn remaining(&self) -> f64 {
        let last = self.last();
        let fallen = |state: &&State| state.pivot > FALLEN * last.pivot;
        let before = self.states.iter().rev().find(fallen);
        before.map_or(f64::INFINITY, |before| {
            let way = (last.t - before.t).abs();
            TANGENTS * last.pivot * way / (before.pivot - last.pivot)
        })
    }

    /// Pose at a time, and the smallest pivot nearby, which tells its accuracy; `None` beyond the end.
    pub fn at(&self, t: f64) -> Option<(DVector<f64>, f64)> {
        let forward = self.last().t >= self.first().t;
        let before = |state: &State| if forward { state.t < t } else { state.t > t };
        let next = self.states.partition_point(before);
        if next == self.states.len() {
            return None;
        }
        if next == 0 {
            return (self.first().t == t).then(|| (self.first().q.clone(), self.first().pivot));
        }
        let (a, b) = (&self.states[next - 1], &self.states[next]);
        Some((between(a, b, t), a.pivot.min(b.pivot)))
    }
}

/// Hermite's polynomial of the fifth degree.
fn between(a: &State, b: &State, t: f64) -> DVector<f64> {
    let h = b.t - a.t;
    let s = (t - a.t) / h;
    let (s2, s3) = (s * s, s * s * s);
    let (s4, s5) = (s2 * s2, s2 * s3);
    let start = 1.0 - 10.0 * s3 + 15.0 * s4 - 6.0 * s5;
    &a.q * start
        + &b.q * (1.0 - start)
        + &a.qd * (h * (s - 6.0 * s3 + 8.0 * s4 - 3.0 * s5))
        + &b.qd * (h * (-4.0 * s3 + 7.0 * s4 - 3.0 * s5))
        + &a.qdd * (h * h * (0.5 * s2 - 1.5 * s3 + 1.5 * s4 - 0.5 * s5))
        + &b.qdd * (h * h * (0.5 * s3 - s4 + 0.5 * s5))
}

impl Tracer<'_> {
    /// Follows the path from a pose near `start` to the time `to`; `None` if no pose is near or it is singular.
    pub fn trace(&self, start: &DVector<f64>, from: f64, to: f64) -> Option<Trace> {
        let first = self.state(self.solved(start, from)?, from)?;
        let mut trace = Trace {
            states: vec![first],
            end: End::Open,
            crossings: Vec::new(),
        };
        let sense = if to < from { -1.0 } else { 1.0 };
        let longest = self.longest.min((to - from).abs());
        let mut h = 0.25 * longest;
        let most = STATES[0] + STATES[1] * ((to - from).abs() / self.longest) as usize;
        let shortest = self.longest * 0.5_f64.powi(HALVINGS);
        while trace.last().t != to {
            let last = trace.last();
            let is_last = (to - last.t).abs() <= 1.001 * h;
            let target = if is_last { to } else { last.t + sense * h };
            // Nearer to a singular pose, rounding alone decides the pose.
            let least = REGULAR * trace.first().pivot;
            match self.step(last, target).filter(|next| next.pivot > least) {
                Some(next) => {
                    trace.states.push(next);
                    h = (1.5 * h).min(longest);
                }
                None => h *= 0.5,
            }
            if trace.states.len() > most {
                trace.end = End::Unknown(trace.last().t);
                return Some(trace);
            }
            if h < shortest.min(0.01 * longest) {
                let (stuck, pivot) = (trace.last().t, trace.last().pivot);
                let is_singular = pivot < 1e-4 * trace.first().pivot.max(1e-6);
                let Some(next) = self.leap(&trace, sense, to) else {
                    let grown = self.has_grown(&trace);
                    trace.end = if is_singular && grown {
                        End::Singular(stuck, stuck + sense * trace.remaining())
                    } else {
                        End::Unknown(stuck)
                    };
                    return Some(trace);
                };
                let way = (next.t - stuck).abs();
                trace.states.retain(|state| (stuck - state.t) * sense > way);
                trace.states.push(next);
                trace.crossings.push(stuck);
                h = 0.25 * way;
            }
        }
        Some(trace)
    }

    /// True if the rates at the end are much larger than those some distance before.
    fn has_grown(&self, trace: &Trace) -> bool {
        let last = trace.last();
        let way = 0.1 * self.longest;
        let before = trace
            .states
            .iter()
            .rev()
            .find(|it| (it.t - last.t).abs() > way);
        let before = before.unwrap_or(trace.first());
        self.size(&last.qd) > GROWN * self.size(&before.qd)
    }

    /// State beyond the end, at the distance at which extrapolation begins before it.
    fn leap(&self, trace: &Trace, sense: f64, to: f64) -> Option<State> {
        let last = trace.last();
        for part in LEAPS {
            let way = part * self.longest * sense;
            let target = last.t + way;
            if (to - target) * sense < 0.0 {
                continue;
            }
            let nodes: Vec<f64> = (1..=6).map(|k| last.t - f64::from(k) * way).collect();
            let poses: Option<Vec<_>> = nodes.iter().map(|t| Some(trace.at(*t)?.0)).collect();
            let Some(poses) = poses else { continue };
            let extrapolated = |t: f64| {
                let mut sum = DVector::zeros(last.q.len());
                for (i, pose) in poses.iter().enumerate() {
                    let others = nodes.iter().enumerate().filter(|(j, _)| *j != i);
                    let weight: f64 = others
                        .map(|(_, node)| (t - node) / (nodes[i] - node))
                        .product();
                    sum += pose * weight;
                }
                sum
            };
            // At a fold the path bends away from every polynomial.
            let rate = (extrapolated(target) - &poses[0]) / (2.0 * way);
            let moved = self.size(&rate) * way.abs();
            let bent = &extrapolated(last.t) - &last.q;
            if self.size(&bent) > 1e-3 * moved {
                continue;
            }
            let grown = &last.qd - &rate;
            if self.size(&grown) > 0.1 * self.size(&rate) {
                continue;
            }
            let guess = extrapolated(target);
            let Some(q) = self.solved(&guess, target) else {
                continue;
            };
            if self.size(&(&q - &guess)) > MISSED_LEAP * moved {
                continue;
            }
            let Some(state) = self.state(q, target) else {
                continue;
            };
            let jump = self.size(&(&state.qd - &rate));
            let is_odd = !self.loops.is_multiple_of(2);
            let has_changed = state.is_negative != last.is_negative;
            if has_changed == is_odd && jump <= 0.1 * self.size(&rate) {
                return Some(state);
            }
        }
        None
    }

    /// Jacobian in the scales of its coordinates, each row with a largest entry of 1, and the divisors of the rows.
    fn factors(&self, q: &DVector<f64>, t: f64) -> (Factors, Vec<f64>) {
        let n = q.len();
        (self.supply)(t);
        let mut jacobian = DMatrix::zeros(n, n);
        self.equations.jacobian(q, t, &mut jacobian);
        for (column, scale) in self.scales.iter().enumerate() {
            jacobian.column_mut(column).scale_mut(*scale);
        }
        let largest: Vec<f64> = (0..n).map(|row| jacobian.row(row).amax()).collect();
        for (row, largest) in largest.iter().enumerate() {
            jacobian.row_mut(row).unscale_mut(*largest);
        }
        (jacobian.full_piv_lu(), largest)
    }

    /// Next correction of Newton-Raphson.
    fn correction(&self, q: &DVector<f64>, t: f64) -> Option<DVector<f64>> {
        let (factors, rows) = self.factors(q, t);
        let mut phi = DVector::zeros(q.len());
        self.equations.residual(q, t, &mut phi);
        self.solution(&factors, &rows, -phi)
    }

    fn solution(
        &self,
        factors: &Factors,
        rows: &[f64],
        mut b: DVector<f64>,
    ) -> Option<DVector<f64>> {
        for (value, row) in b.iter_mut().zip(rows) {
            *value /= row;
        }
        let mut x = factors.solve(&b)?;
        for (value, scale) in x.iter_mut().zip(self.scales) {
            *value *= scale;
        }
        x.iter().all(|it| it.is_finite()).then_some(x)
    }

    /// Largest entry relative to its scale.
    pub fn size(&self, x: &DVector<f64>) -> f64 {
        let parts = x.iter().zip(self.scales).map(|(x, scale)| x.abs() / scale);
        parts.fold(0.0, f64::max)
    }

    /// Pose by Newton-Raphson from a pose nearby.
    pub fn solved(&self, near: &DVector<f64>, t: f64) -> Option<DVector<f64>> {
        let mut q = near.clone();
        let mut last = f64::INFINITY;
        for _ in 0..12 {
            let correction = self.correction(&q, t)?;
            q += &correction;
            let size = self.size(&correction);
            if size < SETTLED {
                return Some(q);
            }
            if size > 2.0 * last {
                return None;
            }
            last = size;
        }
        None
    }

    /// Length of a Newton-Raphson step, in scales: the violation of the equations by a pose.
    pub fn miss(&self, q: &DVector<f64>, t: f64) -> f64 {
        let step = self.correction(q, t);
        step.map_or(f64::INFINITY, |step| self.size(&step))
    }

    fn state(&self, q: DVector<f64>, t: f64) -> Option<State> {
        let n = q.len();
        let (factors, rows) = self.factors(&q, t);
        let mut rate = DVector::zeros(n);
        self.equations.time_derivative(&q, t, &mut rate);
        let qd = self.solution(&factors, &rows, -rate)?;
        let mut gamma = DVector::zeros(n);
        self.equations.gamma(&q, &qd, t, &mut gamma);
        let qdd = self.solution(&factors, &rows, gamma)?;
        let pivots = factors.u().diagonal().abs();
        Some(State {
            t,
            q,
            qd,
            qdd,
            is_negative: factors.determinant() < 0.0,
            pivot: pivots.min() / pivots.max(),
        })
    }

    fn step(&self, from: &State, to: f64) -> Option<State> {
        let h = to - from.t;
        let guess = &from.q + &from.qd * h + &from.qdd * (0.5 * h * h);
        let q = self.solved(&guess, to)?;
        if self.size(&(&q - &guess)) > MISS {
            return None;
        }
        let next = self.state(q, to)?;
        let expected = &from.qd + &from.qdd * h;
        let jump = self.size(&(&next.qd - &expected));
        let rate = self.size(&from.qd) + self.size(&from.qdd) * h.abs() + REST_LIMIT / self.longest;
        // Hermite's rule gives the pose between both states as accurately.
        let way = (&from.qd + &next.qd) * (0.5 * h) - (&next.qdd - &from.qdd) * (h * h / 12.0);
        let defect = self.size(&(&next.q - &from.q - way));
        let is_smooth = jump <= JUMP * rate && defect <= DEFECT;
        (next.is_negative == from.is_negative && is_smooth).then_some(next)
    }
}
