//! Parametrizes the poses around one pose by coordinates u of the null space of Φ_q, and finds the acceleration of u under forces.
//!
//! With lengths in characteristic lengths of the mechanism and V an orthonormal basis of the null space, u = Vᵀ (q − q₀): the pose of a u lies
//! where Newton's method meets the constraints in the orthogonal complement (tangent-space parametrization; Potra and Rheinboldt
//! 1991). Only u is integrated, so that no pose drifts from the constraints. [Φ_q; Vᵀ] is regular wherever Φ_q has full rank and the
//! tangent has not turned too far: its determinant keeps its sign on one path.

use nalgebra::{DMatrix, DVector, Dyn, LU};

use super::equations::MotionEquations;
use super::solved::Solved;
use super::stop::Stop;
use super::straight::Straight;
use crate::instant::Instant;

/// Time difference at which a pose ahead and one back are evaluated, as a part of the time to the loss of rank of Φ_q.
const PROBE: f64 = 1e-4;

/// Coordinates of the poses around one pose.
#[derive(Clone, Debug)]
pub(super) struct Chart {
    /// V (n × f), without the directions of elongations.
    basis: DMatrix<f64>,
    pub(super) straight: Straight,
    /// True if directions of strong damping were sought.
    pub is_straight: bool,
    /// Directions of the coordinates (n × f).
    tangent: DMatrix<f64>,
    /// Largest stretch of a coordinate in the pose.
    pub(super) stretch: f64,
    /// Time of the pose (s).
    time: f64,
    /// Unknowns of the pose, their rates and their accelerations.
    origin: [Vec<f64>; 3],
    /// Sign of the determinant of [Φ_q; Vᵀ] in the pose.
    pub(super) sign: f64,
    /// Distance of Φ_q from the loss of rank in the pose.
    pub measure: f64,
}

/// Regular matrix [Φ_q; Vᵀ].
pub(super) struct Bordered {
    pub residual: DVector<f64>,
    pub factors: LU<f64, Dyn, Dyn>,
}

impl Chart {
    /// Creates coordinates around a pose on the constraints; `None` if the null space does not have the right dimension.
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

    /// Moves the starting point of estimates to a pose on the chart.
    pub fn follow(&mut self, equations: &MotionEquations, solved: &Solved) {
        self.time = solved.instant.t();
        self.origin = [0, 1, 2].map(|level| equations.level(&solved.instant, level));
        self.measure = solved.measure;
    }

    /// Number of coordinates.
    pub fn dimension(&self) -> usize {
        self.tangent.ncols()
    }

    /// Returns the coordinates of a pose, with lengths measured from `reference`.
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

    /// Returns rates (level 1) or accelerations (level 2) of the coordinates at an instant.
    pub fn level(&self, equations: &MotionEquations, pose: &Instant, level: usize) -> Vec<f64> {
        let (_, bends, rows) = self.straight.at(equations, pose);
        let unknowns = scaled(equations, &equations.level(pose, level));
        let moved = rows * &unknowns;
        let moved = moved.iter().zip(bends);
        let moved = moved.map(|(it, bend)| if level == 2 { it + bend } else { *it });
        let along = self.basis.tr_mul(&unknowns);
        moved.chain(along.iter().copied()).collect()
    }

    /// Returns [Φ_q; Vᵀ] in a pose, with the residuals of the constraints and those of the coordinates, which `missed` holds.
    pub(super) fn bordered(
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

    /// Finds the pose, rates and accelerations of coordinates u and their rates at a time, measured from `reference`.
    ///
    /// # Errors
    /// No such pose is near that of the chart, or forces do not determine its acceleration.
    pub fn solve(
        &self,
        equations: &MotionEquations,
        t: f64,
        [value, rate]: [&[f64]; 2],
        reference: &[f64],
    ) -> Result<Solved, Stop> {
        let time = t - self.time;
        let mut q = self.ahead(time);
        // If the estimate misses u, V corrects it.
        let mut estimate = equations.instant(t);
        equations.set_level(&mut estimate, 0, &q);
        let missed = self.missed(equations, &estimate, value, reference);
        let ahead = &self.tangent * DVector::from_vec(missed);
        for (at, q) in q.iter_mut().enumerate() {
            *q -= ahead[at] * equations.coordinate_scales[at];
        }
        self.settle(equations, t, q, [value, rate], reference)
    }

    /// Extrapolates the unknowns of the pose over a time, by their rates and accelerations.
    fn ahead(&self, time: f64) -> Vec<f64> {
        let [pose, rates, accelerations] = &self.origin;
        let moving = pose.iter().zip(rates).zip(accelerations);
        let moved = moving.map(|((at, rate), bend)| at + time * (rate + 0.5 * time * bend));
        moved.collect()
    }

    /// Returns the coordinates of a pose minus the requested ones.
    pub(super) fn missed(
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

    /// Returns the rate of the distance from the loss of rank along the motion (1/s).
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
    /// Returns the sign of the determinant.
    pub fn sign(&self) -> f64 {
        let diagonal = self.factors.lu_internal().diagonal();
        let signs = diagonal.iter().map(|it| it.signum()).product::<f64>();
        signs * self.factors.p().determinant::<f64>()
    }
}

/// Returns C⁻¹ times a vector of all unknowns.
fn scaled(equations: &MotionEquations, vector: &[f64]) -> DVector<f64> {
    DVector::from_fn(vector.len(), |row, _| {
        vector[row] / equations.coordinate_scales[row]
    })
}

/// Returns the largest norm of a column.
pub(super) fn stretch(tangent: &DMatrix<f64>) -> f64 {
    let columns = tangent.column_iter();
    columns.map(|it| it.norm()).fold(0.0, f64::max)
}

/// Returns the reciprocal of the norm of the first columns of an inverse.
pub(super) fn measure(inverse: &DMatrix<f64>, rows: usize) -> f64 {
    match inverse.columns(0, rows).norm() {
        size if size > 0.0 => 1.0 / size,
        _ => 1.0,
    }
}
