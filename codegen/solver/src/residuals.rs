//! Finds the largest residuals of position, velocity and acceleration over a motion.
//!
//! The equations are evaluated again at each instant, independently of the solver.

use linkwright_codegen::stages::pool::Pool;
use linkwright_codegen::stages::system::System;

use crate::instant::{Instant, Layout};
use crate::reader::Reader;

/// Largest residuals over a motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Residuals {
    /// max |Φ_i|, in m or rad.
    pub position: f64,
    /// Row of `position`.
    pub row: usize,
    /// max |Φ_i| / m_i, where m_i is the sum of the absolute values of the terms of Φ_i, or the scale of the row if that is
    /// larger: a small multiple of ε = 2.2e-16 if only rounding remains.
    pub scaled: f64,
    /// Largest residual of the redundant equations, which are not solved, in m or rad; `None` if there are none.
    pub monitored: Option<f64>,
    /// Redundant equation of `monitored`.
    pub monitored_row: usize,
    /// max |Φ_q q̇ + Φ_t|, in m/s or rad/s.
    pub velocity: f64,
    /// max |Φ_q q̈ - γ|, in m/s² or rad/s².
    pub acceleration: f64,
}

/// Observer of residuals.
#[derive(Clone, Debug)]
pub struct ResidualCheck {
    /// Evaluator, for each row, of its residual, its magnitude, Φ_t, γ and the entries of Φ_q; then of the monitored residuals.
    reader: Reader,
    rows: Vec<CheckedRow>,
    values: Vec<f64>,
    /// Largest residuals so far.
    pub largest: Residuals,
}

#[derive(Clone, Debug)]
struct CheckedRow {
    scale: f64,
    /// Coordinates of the entries of Φ_q.
    columns: Vec<usize>,
}

impl ResidualCheck {
    /// Creates an observer before the first instant.
    ///
    /// # Panics
    /// If instants of this layout do not store what the equations mention.
    pub fn new(pool: &Pool, system: &System, layout: &Layout) -> ResidualCheck {
        let reader = Reader::recorded(&pool.graph, layout, |recorder| {
            let mut results = Vec::new();
            for row in &system.rows {
                results.push(recorder.value(row.residual));
                results.push(recorder.magnitude(row.residual));
                results.push(recorder.value(row.time_derivative));
                results.push(recorder.value(row.gamma));
                results.extend(row.jacobian.iter().map(|entry| recorder.value(entry.value)));
            }
            results.extend(
                system
                    .monitored
                    .iter()
                    .map(|row| recorder.value(row.residual)),
            );
            results
        });
        let rows = system.rows.iter().map(|row| CheckedRow {
            scale: system.scale(row.quantity, pool),
            columns: row.jacobian.iter().map(|entry| entry.coordinate).collect(),
        });
        ResidualCheck {
            reader,
            rows: rows.collect(),
            values: Vec::new(),
            largest: Residuals::default(),
        }
    }

    /// Observes an instant.
    pub fn see(&mut self, instant: &Instant) {
        self.reader.read(instant, &mut self.values);
        let mut rest = self.values.as_slice();
        let largest = &mut self.largest;
        for (number, row) in self.rows.iter().enumerate() {
            let (own, others) = rest.split_at(4 + row.columns.len());
            rest = others;
            let [residual, magnitude, mut velocity, mut acceleration] =
                [own[0], own[1], own[2], -own[3]];
            for (&column, entry) in row.columns.iter().zip(&own[4..]) {
                velocity += entry * instant.qd()[column];
                acceleration += entry * instant.qdd()[column];
            }
            if residual.abs() > largest.position {
                largest.position = residual.abs();
                largest.row = number;
            }
            largest.scaled = largest
                .scaled
                .max(residual.abs() / magnitude.max(row.scale));
            largest.velocity = largest.velocity.max(velocity.abs());
            largest.acceleration = largest.acceleration.max(acceleration.abs());
        }
        for (number, value) in rest.iter().enumerate() {
            if largest.monitored.is_none_or(|most| value.abs() > most) {
                largest.monitored = Some(value.abs());
                largest.monitored_row = number;
            }
        }
    }
}
