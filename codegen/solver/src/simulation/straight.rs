//! Selects the elongations of strong dampers as coordinates of a chart.
//!
//! Elongations are selected by the loss of force with a rate along each: the strongest first, then those independent of the selected.

use nalgebra::{DMatrix, DVector};

use super::equations::MotionEquations;
use crate::instant::Instant;
use crate::product::product;

/// Smallest part of a gradient along the tangent, and outside the selected gradients.
const ALONG: f64 = 0.1;

/// Damping relative to the strongest that counts as rounding.
const ROUNDING: f64 = 1e3 * f64::EPSILON;

/// Coordinates that are elongations: their indices, and the norms of their gradients along the tangent.
#[derive(Clone, Debug, Default)]
pub(super) struct Straight {
    chosen: Vec<(usize, f64)>,
}

impl Straight {
    /// Selects elongations in a pose with rates and an orthonormal basis of its tangent; returns the rest of the basis as well.
    pub fn of(
        equations: &MotionEquations,
        instant: &Instant,
        basis: DMatrix<f64>,
    ) -> (Straight, DMatrix<f64>) {
        let count = basis.ncols();
        if equations.elongations.is_empty() || count == 0 {
            return (Straight::default(), basis);
        }
        let elongated = equations
            .elongations
            .at(instant, &equations.coordinate_scales);
        let along = product(&elongated.gradients, &basis);
        let damping = damping(equations, instant, &basis);
        let mut left: DMatrix<f64> = DMatrix::identity(count, count);
        let mut chosen = Vec::new();
        let mut strongest = 0.0;
        while chosen.len() < count {
            let candidates = (0..along.nrows()).filter_map(|place| {
                let whole = elongated.gradients.row(place).norm();
                let gradient: DVector<f64> = along.row(place).transpose();
                let beside = &left * (left.transpose() * &gradient);
                let size = beside.norm();
                let is_free = size > ALONG * whole && whole > 0.0;
                let direction = beside / size;
                let lost = direction.dot(&(&damping * &direction));
                (is_free && lost > ROUNDING * strongest).then_some((
                    lost,
                    place,
                    gradient.norm(),
                    direction,
                ))
            });
            let Some((lost, place, norm, direction)) =
                candidates.max_by(|one, other| one.0.total_cmp(&other.0))
            else {
                break;
            };
            strongest = f64::max(strongest, lost);
            chosen.push((place, norm));
            left = without(&left, &direction);
        }
        (Straight { chosen }, product(&basis, &left))
    }

    /// True if no coordinate is an elongation.
    pub fn is_empty(&self) -> bool {
        self.chosen.is_empty()
    }

    /// Returns values of the coordinates, their accelerations if those of the unknowns are zero, and derivatives by all unknowns.
    pub fn at(
        &self,
        equations: &MotionEquations,
        instant: &Instant,
    ) -> (Vec<f64>, Vec<f64>, DMatrix<f64>) {
        let columns = equations.coordinate_scales.len();
        if self.is_empty() {
            return (Vec::new(), Vec::new(), DMatrix::zeros(0, columns));
        }
        let all = equations
            .elongations
            .at(instant, &equations.coordinate_scales);
        let of = |values: &[f64]| {
            let chosen = self.chosen.iter();
            chosen.map(|(place, norm)| values[*place] / norm).collect()
        };
        let rows = DMatrix::from_fn(self.chosen.len(), columns, |row, column| {
            let (place, norm) = self.chosen[row];
            all.gradients[(place, column)] / norm
        });
        (of(&all.values), of(&all.bends), rows)
    }
}

/// Returns the damping matrix along a basis: minus the derivatives of forces by rates.
fn damping(equations: &MotionEquations, instant: &Instant, basis: &DMatrix<f64>) -> DMatrix<f64> {
    let scales = DVector::from_column_slice(&equations.coordinate_scales);
    let rates = equations.level(instant, 1);
    let mut moved = instant.clone();
    equations.still(&mut moved);
    let mut loads = |direction: DVector<f64>| {
        let direction = direction.component_mul(&scales);
        let rates: Vec<f64> = rates
            .iter()
            .zip(&direction)
            .map(|(one, other)| one + other)
            .collect();
        equations.set_level(&mut moved, 1, &rates);
        equations.dynamics(&moved).loads.component_mul(&scales)
    };
    let columns = basis.column_iter().map(|column| {
        let column = column.into_owned();
        (loads(-&column) - loads(column)).scale(0.5)
    });
    let columns: Vec<DVector<f64>> = columns.collect();
    basis.tr_mul(&DMatrix::from_columns(&columns))
}

/// Returns an orthonormal basis of the span of a basis, without a direction.
fn without(basis: &DMatrix<f64>, direction: &DVector<f64>) -> DMatrix<f64> {
    let inside = basis.transpose() * direction;
    let count = inside.len();
    let mut whole = DMatrix::identity(count, count);
    DMatrix::from_columns(&[inside])
        .col_piv_qr()
        .q_tr_mul(&mut whole);
    product(basis, &whole.rows(1, count - 1).transpose())
}
