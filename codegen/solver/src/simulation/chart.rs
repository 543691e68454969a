//! *A pose and the null space of Φ_q there* → *coordinates u of the poses around it, and the acceleration that forces give them*.
//!
//! With lengths in characteristic lengths of the mechanism and V an orthonormal basis of the null space, u = Vᵀ (q − q₀): the pose of a u lies
//! where Newton's method meets the constraints in the orthogonal complement (tangent-space parametrization; Potra and Rheinboldt
//! 1991). Nothing is integrated that the constraints give, so that no pose drifts from them. [Φ_q; Vᵀ] is regular wherever Φ_q has
//! full rank and the tangent has not turned too far: its determinant keeps its sign on one path.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn, LU};

use super::equations::MotionEquations;
use super::stop::Stop;
use super::straight::Straight;
use crate::instant::Instant;

/// How many corrections a pose may take.
const CORRECTIONS: usize = 16;

/// The correction after which a pose needs only one more.
const SMALL: f64 = 1e-7;

/// How far a correction may lead from what is expected, in rad or characteristic lengths.
const FAR: f64 = 1.0;

/// How far ahead and back a pose is looked at, in parts of its distance from where Φ_q loses rank.
const PROBE: f64 = 1e-4;

/// The square of a pivot beside its diagonal entry, below which a reduced mass carries no digit.
const SMALLEST_PIVOT: f64 = 64.0 * f64::EPSILON;

/// Coordinates of the poses around one pose.
#[derive(Clone, Debug)]
pub(super) struct Chart {
    /// V (n × f), without what elongations span.
    basis: DMatrix<f64>,
    straight: Straight,
    /// True if what dampers resist was looked for.
    pub is_straight: bool,
    /// Directions in which the coordinates lead (n × f).
    tangent: DMatrix<f64>,
    /// The largest stretch of a coordinate there.
    stretch: f64,
    /// When the mechanism was in the pose (s).
    time: f64,
    /// The unknowns there, their rates and their accelerations.
    origin: [Vec<f64>; 3],
    /// The sign of the determinant of [Φ_q; Vᵀ] there.
    sign: f64,
    /// How far Φ_q is from losing rank there.
    pub measure: f64,
}

/// All that follows in one pose with rates.
#[derive(Clone, Debug)]
pub(super) struct Solved {
    pub instant: Instant,
    /// Accelerations of the chart's coordinates.
    pub acceleration: Vec<f64>,
    /// The kinetic and the potential energy (J).
    pub energies: [f64; 2],
    /// What forces, dampers, torques and drivers bring in (W).
    pub power: f64,
    /// How far Φ_q is from losing rank: the reciprocal of the norm of its inverse across the tangent.
    pub measure: f64,
    /// How far the tangent has turned: the largest stretch of a coordinate, 1 where it has not.
    pub stretch: f64,
}

/// A regular matrix [Φ_q; Vᵀ].
struct Bordered {
    residual: DVector<f64>,
    factors: LU<f64, Dyn, Dyn>,
}

impl Chart {
    /// Around a pose on the constraints; `None` where there is no null space of the right dimension.
    pub fn around(
        equations: &MotionEquations,
        origin: &Instant,
        is_straight: bool,
    ) -> Option<Chart> {
        let [rows, columns] = equations.dimensions();
        let (_, matrix) = equations.constraints(origin);
        if matrix.iter().any(|entry| !entry.is_finite()) {
            return None;
        }
        let mut whole = DMatrix::identity(columns, columns);
        matrix.transpose().col_piv_qr().q_tr_mul(&mut whole);
        let basis = whole.rows(rows, columns - rows).transpose();
        let mut tangent = basis.clone();
        let (straight, basis) = match is_straight {
            true => Straight::of(equations, origin, basis),
            false => (Straight::default(), basis),
        };
        let mut chart = Chart {
            basis,
            straight,
            is_straight,
            tangent: DMatrix::zeros(0, 0),
            stretch: 1.0,
            time: origin.t(),
            origin: [0, 1, 2].map(|level| equations.level(origin, level)),
            sign: 0.0,
            measure: 0.0,
        };
        let bordered = chart.bordered(equations, origin, None)?;
        chart.sign = bordered.sign();
        let inverse = bordered.factors.try_inverse()?;
        chart.measure = measure(&inverse, rows);
        if !chart.straight.is_empty() {
            tangent = inverse.columns(rows, columns - rows).into_owned();
            chart.stretch = stretch(&tangent);
        }
        chart.tangent = tangent;
        Some(chart)
    }

    /// Takes a pose that its coordinates have led to for where estimates begin.
    pub fn follow(&mut self, equations: &MotionEquations, solved: &Solved) {
        self.time = solved.instant.t();
        self.origin = [0, 1, 2].map(|level| equations.level(&solved.instant, level));
        self.measure = solved.measure;
    }

    /// How many coordinates it has.
    pub fn dimension(&self) -> usize {
        self.tangent.ncols()
    }

    /// The coordinates of a pose, with lengths measured from `reference`.
    pub fn coordinates(
        &self,
        equations: &MotionEquations,
        pose: &Instant,
        reference: &[f64],
    ) -> Vec<f64> {
        let (mut values, ..) = self.straight.at(equations, pose);
        let unknowns = equations.level(pose, 0);
        let moved = unknowns.iter().zip(reference);
        let moved: Vec<f64> = moved.map(|(q, from)| q - from).collect();
        let along = self.basis.tr_mul(&scaled(equations, &moved));
        values.extend_from_slice(along.as_slice());
        values
    }

    /// Rates (1) or accelerations (2) of the coordinates at an instant.
    pub fn level(&self, equations: &MotionEquations, pose: &Instant, level: usize) -> Vec<f64> {
        let (_, bends, rows) = self.straight.at(equations, pose);
        let own = scaled(equations, &equations.level(pose, level));
        let moved = rows * &own;
        let moved = moved.iter().zip(bends);
        let moved = moved.map(|(it, bend)| if level == 2 { it + bend } else { *it });
        let along = self.basis.tr_mul(&own);
        moved.chain(along.iter().copied()).collect()
    }

    /// [Φ_q; Vᵀ] in a pose, with what it misses of the constraints and of `wanted`.
    fn bordered(
        &self,
        equations: &MotionEquations,
        instant: &Instant,
        missed: Option<&[f64]>,
    ) -> Option<Bordered> {
        let [rows, columns] = equations.dimensions();
        let (residual, matrix) = equations.constraints(instant);
        let mut all = DMatrix::zeros(columns, columns);
        all.rows_mut(0, rows).copy_from(&matrix);
        let (_, _, own) = self.straight.at(equations, instant);
        all.rows_mut(rows, own.nrows()).copy_from(&own);
        all.rows_mut(rows + own.nrows(), self.basis.ncols())
            .copy_from(&self.basis.transpose());
        let mut whole = DVector::zeros(columns);
        whole.rows_mut(0, rows).copy_from(&residual);
        for (place, value) in missed.into_iter().flatten().enumerate() {
            whole[rows + place] = *value;
        }
        let is_finite = all.iter().chain(&whole).all(|it| it.is_finite());
        is_finite.then(|| Bordered {
            residual: whole,
            factors: all.lu(),
        })
    }

    /// The pose, rates and accelerations of coordinates u and their rates at a time, measured from `reference`.
    ///
    /// # Errors
    /// There is no such pose near the chart's, or forces give it no acceleration.
    pub fn solve(
        &self,
        equations: &MotionEquations,
        t: f64,
        [value, rate]: [&[f64]; 2],
        reference: &[f64],
    ) -> Result<Solved, Stop> {
        let time = t - self.time;
        let mut q = self.ahead(time);
        // Where that misses u, V leads on.
        let mut estimate = equations.instant(t);
        equations.set_level(&mut estimate, 0, &q);
        let missed = self.missed(equations, &estimate, value, reference);
        let ahead = &self.tangent * DVector::from_vec(missed);
        for (at, q) in q.iter_mut().enumerate() {
            *q -= ahead[at] * equations.coordinate_scales[at];
        }
        self.settle(equations, t, q, [value, rate], reference)
    }

    /// The unknowns to which rates and accelerations of the pose lead in a time.
    fn ahead(&self, time: f64) -> Vec<f64> {
        let [pose, rates, accelerations] = &self.origin;
        let moving = pose.iter().zip(rates).zip(accelerations);
        let moved = moving.map(|((at, rate), bend)| at + time * (rate + 0.5 * time * bend));
        moved.collect()
    }

    /// The same from an estimate of the pose.
    ///
    /// # Errors
    /// The same.
    pub fn settle(
        &self,
        equations: &MotionEquations,
        t: f64,
        mut q: Vec<f64>,
        [value, rate]: [&[f64]; 2],
        reference: &[f64],
    ) -> Result<Solved, Stop> {
        let [rows, columns] = equations.dimensions();
        let scales = &equations.coordinate_scales;
        let mut instant = equations.instant(t);
        let mut is_close = false;
        let mut found = None;
        for _ in 0..CORRECTIONS {
            equations.set_level(&mut instant, 0, &q);
            let missed = self.missed(equations, &instant, value, reference);
            let bordered = self.bordered(equations, &instant, Some(&missed));
            let bordered = bordered.ok_or(Stop::NotFinite { t })?;
            let step = bordered.factors.solve(&bordered.residual);
            let step = step.ok_or(Stop::LosesRank { t })?;
            for (at, q) in q.iter_mut().enumerate() {
                *q -= step[at] * scales[at];
            }
            let size = step.amax();
            if size > FAR || size.is_nan() {
                return Err(Stop::Unsettled { t });
            }
            if is_close {
                found = Some(bordered);
                break;
            }
            is_close = size <= SMALL;
        }
        let bordered = found.ok_or(Stop::Unsettled { t })?;
        if bordered.sign() != self.sign {
            return Err(Stop::LosesRank { t });
        }
        equations.set_level(&mut instant, 0, &q);
        let inverse = bordered
            .factors
            .try_inverse()
            .ok_or(Stop::LosesRank { t })?;
        let stretch = stretch(&inverse.columns(rows, columns - rows).into_owned()) / self.stretch;
        // In Φ_t and γ what is free stands still, since it is an unknown that moves.
        equations.still(&mut instant);
        let before = equations.dynamics(&instant);
        let moves = DVector::from_fn(columns, |at, _| match at.checked_sub(rows) {
            None => -before.time_derivative[at] / equations.row_scales[at],
            Some(place) => rate[place],
        });
        let moves = &inverse * moves;
        let moves: Vec<f64> = moves
            .iter()
            .zip(scales)
            .map(|(it, scale)| it * scale)
            .collect();
        equations.set_level(&mut instant, 1, &moves);
        let dynamics = equations.dynamics(&instant);
        let (_, own_bends, _) = self.straight.at(equations, &instant);
        let bends = DVector::from_fn(columns, |at, _| match at.checked_sub(rows) {
            None => dynamics.gamma[at] / equations.row_scales[at],
            Some(place) => own_bends.get(place).map_or(0.0, |bend| -bend),
        });
        let scaled =
            |vector: DVector<f64>| DVector::from_fn(columns, |at, _| vector[at] * scales[at]);
        let bends = scaled(&inverse * bends);
        let mut moved = inverse.columns(rows, columns - rows).into_owned();
        for (at, mut row) in moved.row_iter_mut().enumerate() {
            row *= scales[at];
        }
        let mass = moved.tr_mul(&(&dynamics.mass * &moved));
        let force = moved.tr_mul(&(&dynamics.loads - &dynamics.mass * &bends));
        let acceleration = accelerated(mass, &force).ok_or(Stop::Massless {
            t,
            coordinate: None,
        })?;
        let bent = bends + &moved * &acceleration;
        equations.set_level(&mut instant, 2, bent.as_slice());
        let rest = scaled(&dynamics.loads - &dynamics.mass * &bent);
        let carried = inverse.tr_mul(&rest);
        let driven = (0..rows)
            .map(|row| carried[row] * before.time_derivative[row] / equations.row_scales[row]);
        let power = dynamics.power + driven.sum::<f64>();
        let is_finite = power.is_finite() && instant.values().iter().all(|it| it.is_finite());
        if !is_finite {
            return Err(Stop::NotFinite { t });
        }
        Ok(Solved {
            instant,
            acceleration: acceleration.as_slice().to_vec(),
            energies: dynamics.energies,
            power,
            measure: measure(&inverse, rows),
            stretch,
        })
    }

    /// How much u of a pose is beyond what is wanted.
    fn missed(
        &self,
        equations: &MotionEquations,
        pose: &Instant,
        wanted: &[f64],
        reference: &[f64],
    ) -> Vec<f64> {
        let along = self.coordinates(equations, pose, reference);
        along
            .iter()
            .zip(wanted)
            .map(|(one, other)| one - other)
            .collect()
    }

    /// How fast the measure changes along the motion (1/s).
    pub fn measure_rate(&self, equations: &MotionEquations) -> f64 {
        let [rows, _] = equations.dimensions();
        let scaled = self.origin[1].iter().zip(&equations.coordinate_scales);
        let speed = scaled
            .map(|(rate, scale)| (rate / scale).abs())
            .fold(0.0, f64::max);
        if speed == 0.0 || rows == 0 {
            return 0.0;
        }
        let time = PROBE * self.measure.min(1.0) / speed;
        let ahead = |time: f64| {
            let mut instant = equations.instant(self.time + time);
            equations.set_level(&mut instant, 0, &self.ahead(time));
            let inverse = self
                .bordered(equations, &instant, None)?
                .factors
                .try_inverse()?;
            Some(measure(&inverse, rows))
        };
        match [ahead(time), ahead(-time)] {
            [Some(after), Some(before)] => (after - before) / (2.0 * time),
            _ => 0.0,
        }
    }
}

impl Bordered {
    fn sign(&self) -> f64 {
        let diagonal = self.factors.lu_internal().diagonal();
        let signs = diagonal.iter().map(|it| it.signum()).product::<f64>();
        signs * self.factors.p().determinant::<f64>()
    }
}

/// C⁻¹ of a vector of all unknowns.
fn scaled(equations: &MotionEquations, vector: &[f64]) -> DVector<f64> {
    DVector::from_fn(vector.len(), |row, _| {
        vector[row] / equations.coordinate_scales[row]
    })
}

/// The largest norm of a column.
fn stretch(tangent: &DMatrix<f64>) -> f64 {
    let columns = tangent.column_iter();
    columns.map(|it| it.norm()).fold(0.0, f64::max)
}

/// The reciprocal of the norm of the first columns of an inverse.
fn measure(inverse: &DMatrix<f64>, rows: usize) -> f64 {
    match inverse.columns(0, rows).norm() {
        size if size > 0.0 => 1.0 / size,
        _ => 1.0,
    }
}

/// The acceleration that a force gives a mass; `None` where the mass is not positive definite to its digits.
fn accelerated(mass: DMatrix<f64>, force: &DVector<f64>) -> Option<DVector<f64>> {
    let diagonal = mass.diagonal();
    let factor = Cholesky::new(mass)?;
    let pivots = factor.l_dirty().diagonal();
    let mut pairs = pivots.iter().zip(&diagonal);
    let is_small = pairs.any(|(pivot, whole)| pivot * pivot <= SMALLEST_PIVOT * whole);
    (!is_small).then(|| factor.solve(force))
}
