//! *Frames → the largest residuals of position, velocity and acceleration over all of them.*
//!
//! The equations are evaluated again at each frame, independently of what the solver believed. The module does not judge
//! the figures.

use linkwright::{Equations, Frame};
use nalgebra::{DMatrix, DVector, Dyn};
use serde::Serialize;

use crate::interpreter::Interpreter;

/// The largest residuals over a motion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Residuals {
    /// max |Φ_i|, in m or rad.
    pub position: f64,
    /// The row of `position`.
    #[serde(skip)]
    pub row: usize,
    /// max |Φ_i| / m_i, where m_i is the sum of the absolute values of the terms of Φ_i, or the scale of the row if that is
    /// larger: a multiple of ε = 2.2e-16 where the rest is rounding.
    pub scaled: f64,
    /// The largest residual of the redundant equations, which are not solved, in m or rad; `None` where there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub monitored: Option<f64>,
    /// The redundant equation of `monitored`.
    #[serde(skip)]
    pub monitored_row: usize,
    /// max |Φ_q q̇ + Φ_t|, in m/s or rad/s.
    pub velocity: f64,
    /// max |Φ_q q̈ - γ|, in m/s² or rad/s².
    pub acceleration: f64,
}

impl Residuals {
    /// The largest residuals over `frames`; all zero without frames.
    pub fn over(interpreter: &Interpreter, frames: &[Frame<f64, Dyn>]) -> Residuals {
        let n = interpreter.dimension().0;
        let mut largest = Residuals::default();
        let mut phi = DVector::zeros(n);
        let mut magnitudes = DVector::zeros(n);
        let mut matrix = DMatrix::zeros(n, n);
        let mut right_hand_side = DVector::zeros(n);
        for frame in frames {
            interpreter.residual(&frame.q, frame.t, &mut phi);
            interpreter.residual_magnitudes(&frame.q, frame.t, &mut magnitudes);
            for (row, (value, magnitude)) in phi.iter().zip(&magnitudes).enumerate() {
                if value.abs() > largest.position {
                    largest.position = value.abs();
                    largest.row = row;
                }
                let scale = magnitude.max(interpreter.row_scale(row));
                largest.scaled = largest.scaled.max(value.abs() / scale);
            }
            let watched = interpreter.monitored(&frame.q, frame.t);
            for (row, value) in watched.iter().enumerate() {
                if largest.monitored.is_none_or(|most| value.abs() > most) {
                    largest.monitored = Some(value.abs());
                    largest.monitored_row = row;
                }
            }
            interpreter.jacobian(&frame.q, frame.t, &mut matrix);
            interpreter.time_derivative(&frame.q, frame.t, &mut right_hand_side);
            right_hand_side.gemv(1.0, &matrix, &frame.qd, 1.0);
            largest.velocity = largest.velocity.max(amax(&right_hand_side));
            interpreter.gamma(&frame.q, &frame.qd, frame.t, &mut right_hand_side);
            right_hand_side.gemv(1.0, &matrix, &frame.qdd, -1.0);
            largest.acceleration = largest.acceleration.max(amax(&right_hand_side));
        }
        largest
    }
}

/// The largest magnitude; 0 for a mechanism without coordinates.
fn amax(vector: &DVector<f64>) -> f64 {
    vector.iter().fold(0.0, |largest, it| it.abs().max(largest))
}
