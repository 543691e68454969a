//! Solves a pose from coordinates of a chart and their rates: pose, rates, accelerations, energies and power.
//!
//! A pose counts if Newton's method meets the constraints to rounding, on the side of the chart's own pose.

use nalgebra::{Cholesky, DMatrix, DVector};

use super::chart::{Chart, measure, stretch};
use super::equations::MotionEquations;
use super::massless::{SMALLEST_PIVOT, unresisted};
use super::stop::Stop;
use crate::instant::Instant;
use crate::product::product;

/// Largest number of corrections of a pose.
const CORRECTIONS: usize = 16;

/// Correction below which a pose needs only one more.
const SMALL: f64 = 1e-7;

/// Largest distance of a correction from the estimate, in rad or characteristic lengths.
const MAX_CORRECTION: f64 = 1.0;

/// Solution in one pose with rates.
#[derive(Clone, Debug)]
pub(super) struct Solved {
    pub instant: Instant,
    /// Accelerations of the chart's coordinates.
    pub acceleration: Vec<f64>,
    /// Kinetic and potential energy (J).
    pub energies: [f64; 2],
    /// Power of forces, dampers, torques and drivers (W).
    pub power: f64,
    /// Distance of Φ_q from the loss of rank: the reciprocal of the norm of its inverse across the tangent.
    pub measure: f64,
    /// Largest stretch of a coordinate, which grows while the tangent turns; 1 in the chart's own pose.
    pub stretch: f64,
}

impl Chart {
    /// Finds the pose, rates and accelerations of coordinates u and their rates at a time, from an estimate of the pose.
    ///
    /// # Errors
    /// No such pose is near the estimate, or forces do not determine its acceleration.
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
        let mut last_bordered = None;
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
            if size > MAX_CORRECTION || size.is_nan() {
                return Err(Stop::Unsettled { t });
            }
            if is_close {
                last_bordered = Some(bordered);
                break;
            }
            is_close = size <= SMALL;
        }
        let bordered = last_bordered.ok_or(Stop::Unsettled { t })?;
        if bordered.sign() != self.sign {
            return Err(Stop::LosesRank { t });
        }
        equations.set_level(&mut instant, 0, &q);
        let inverse = bordered
            .factors
            .try_inverse()
            .ok_or(Stop::LosesRank { t })?;
        let stretch = stretch(&inverse.columns(rows, columns - rows).into_owned()) / self.stretch;
        // Free coordinates are moving unknowns, so Φ_t and γ do not include their motion.
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
        let mass = moved.tr_mul(&product(&dynamics.mass, &moved));
        let force = moved.tr_mul(&(&dynamics.loads - &dynamics.mass * &bends));
        if mass.iter().any(|entry| !entry.is_finite()) {
            return Err(Stop::NotFinite { t });
        }
        let acceleration = accelerated(&mass, &force).ok_or_else(|| {
            // Free coordinates are the last unknowns.
            let free = equations.free_count();
            let mut rates = moved.rows(columns - free, free).into_owned();
            for (mut row, scale) in rates.row_iter_mut().zip(&scales[columns - free..]) {
                row /= *scale;
            }
            Stop::Massless {
                t,
                coordinates: unresisted(mass, &rates),
            }
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
}

/// Returns the acceleration of a mass by a force; `None` if the mass is not positive definite to its digits.
fn accelerated(mass: &DMatrix<f64>, force: &DVector<f64>) -> Option<DVector<f64>> {
    let diagonal = mass.diagonal();
    let factor = Cholesky::new(mass.clone())?;
    let pivots = factor.l_dirty().diagonal();
    let mut pairs = pivots.iter().zip(&diagonal);
    let is_small = pairs.any(|(pivot, whole)| pivot * pivot <= SMALLEST_PIVOT * whole);
    (!is_small).then(|| factor.solve(force))
}
