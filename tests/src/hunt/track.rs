//! Follows the path from a pose through instants, or to its end, in f64.
//!
//! An independent tracker: complete pivoting, the sign of the determinant, and steps so short that the Taylor
//! polynomial misses by less than `MISS`. So no other path can be mistaken for this one. It is slow and shares
//! nothing with the runtime's Newton-Raphson. Its poses are made exact in 384 bits afterwards.

use linkwright::Equations;
use linkwright_solver::textbook::TextbookEquations;
use nalgebra::{DMatrix, DVector};

/// Largest deviation of a coordinate from the Taylor polynomial, relative to its scale.
const MISS: f64 = 1e-4;

/// Correction below which only rounding is left, relative to the scale.
const SETTLED: f64 = 1e-9;

/// Correction below which only rounding is left, relative to the largest coordinate.
const SETTLED_FAR: f64 = 1e-12;

/// Largest number of halvings of the interval between two instants.
const HALVINGS: i32 = 34;

/// Fraction of the first smallest singular value that is left where a path ends at a singular pose.
const SINGULAR: f64 = 1e-3;

/// Continuation of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// Beyond the last instant.
    Open,
    /// At a singular pose.
    Singular,
    /// Unknown: the tracker has given up.
    Unknown,
}

/// Poses at the instants that the path reaches, and its continuation.
pub struct Path {
    /// q, instant by instant.
    pub poses: Vec<DVector<f64>>,
    /// Continuation.
    pub end: End,
}

struct State {
    t: f64,
    q: DVector<f64>,
    qd: DVector<f64>,
    qdd: DVector<f64>,
    is_negative: bool,
    smallest: f64,
}

/// Equations with the scales of their coordinates.
pub struct Tracker<'a> {
    equations: &'a TextbookEquations,
    scales: Vec<f64>,
    settled: f64,
}

impl Tracker<'_> {
    /// Tracker for these equations; `scales` are those of the coordinates, and the largest of them is `away` sizes.
    pub fn new(equations: &TextbookEquations, scales: Vec<f64>, away: f64) -> Tracker<'_> {
        Tracker {
            equations,
            scales,
            settled: SETTLED.max(SETTLED_FAR * away),
        }
    }

    /// Follows the path from a pose near `start` at the first of `times`.
    pub fn path(&self, start: &DVector<f64>, times: &[f64]) -> Path {
        let mut path = Path {
            poses: Vec::new(),
            end: End::Open,
        };
        let Some(mut state) = self
            .solved(start, times[0])
            .and_then(|q| self.state(q, times[0]))
        else {
            path.end = End::Unknown;
            return path;
        };
        let first = state.smallest;
        path.poses.push(state.q.clone());
        for pair in times.windows(2) {
            let whole = pair[1] - pair[0];
            let mut h = whole / 8.0;
            while state.t < pair[1] {
                let to = if state.t + 1.001 * h >= pair[1] {
                    pair[1]
                } else {
                    state.t + h
                };
                match self.step(&state, to) {
                    Some(next) => {
                        state = next;
                        h = (1.7 * h).min(whole);
                    }
                    None => h *= 0.5,
                }
                if h < whole * 0.5_f64.powi(HALVINGS) {
                    path.end = if state.smallest < SINGULAR * first {
                        End::Singular
                    } else {
                        End::Unknown
                    };
                    return path;
                }
            }
            path.poses.push(state.q.clone());
        }
        path
    }

    fn jacobian(&self, q: &DVector<f64>, t: f64) -> DMatrix<f64> {
        let n = q.len();
        let mut jacobian = DMatrix::zeros(n, n);
        self.equations.jacobian(q, t, &mut jacobian);
        for (column, scale) in self.scales.iter().enumerate() {
            jacobian.column_mut(column).scale_mut(*scale);
        }
        for row in 0..n {
            let scale = self.equations.row_scale(row);
            jacobian.row_mut(row).unscale_mut(scale);
        }
        jacobian
    }

    /// Solution of J x = b in coordinates, with b unscaled.
    fn solve(&self, jacobian: &DMatrix<f64>, mut b: DVector<f64>) -> Option<DVector<f64>> {
        for (row, value) in b.iter_mut().enumerate() {
            *value /= self.equations.row_scale(row);
        }
        let mut x = jacobian.clone().full_piv_lu().solve(&b)?;
        for (value, scale) in x.iter_mut().zip(&self.scales) {
            *value *= scale;
        }
        x.iter().all(|it| it.is_finite()).then_some(x)
    }

    fn size(&self, x: &DVector<f64>) -> f64 {
        let parts = x.iter().zip(&self.scales).map(|(x, scale)| x.abs() / scale);
        parts.fold(0.0, f64::max)
    }

    fn correction(&self, q: &DVector<f64>, t: f64) -> Option<DVector<f64>> {
        let mut phi = DVector::zeros(q.len());
        self.equations.residual(q, t, &mut phi);
        self.solve(&self.jacobian(q, t), -phi)
    }

    /// Pose by Newton-Raphson from a pose nearby.
    fn solved(&self, near: &DVector<f64>, t: f64) -> Option<DVector<f64>> {
        let mut q = near.clone();
        for _ in 0..8 {
            let correction = self.correction(&q, t)?;
            q += &correction;
            if self.size(&correction) < self.settled {
                return Some(q);
            }
        }
        None
    }

    fn state(&self, q: DVector<f64>, t: f64) -> Option<State> {
        let n = q.len();
        let jacobian = self.jacobian(&q, t);
        let mut rate = DVector::zeros(n);
        self.equations.time_derivative(&q, t, &mut rate);
        let qd = self.solve(&jacobian, -rate)?;
        let mut gamma = DVector::zeros(n);
        self.equations.gamma(&q, &qd, t, &mut gamma);
        let qdd = self.solve(&jacobian, gamma)?;
        let smallest = jacobian.clone().singular_values().min();
        Some(State {
            t,
            q,
            qd,
            qdd,
            is_negative: jacobian.full_piv_lu().determinant() < 0.0,
            smallest,
        })
    }

    fn step(&self, from: &State, to: f64) -> Option<State> {
        let h = to - from.t;
        let guess = &from.q + &from.qd * h + &from.qdd * (0.5 * h * h);
        let first = self.correction(&guess, to)?;
        let q = &guess + &first;
        let second = self.correction(&q, to)?;
        let (first, second_size) = (self.size(&first), self.size(&second));
        if first > MISS || second_size > (0.1 * first).max(self.settled) {
            return None;
        }
        let q = self.solved(&(q + second), to)?;
        let next = self.state(q, to)?;
        (next.is_negative == from.is_negative).then_some(next)
    }
}
