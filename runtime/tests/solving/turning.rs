//! The exam's mechanism with a crank that turns on and on: φ1 = π/6 + t.
//!
//! cos φ2 = 1 - cos φ1 / √3, so that the rod lies level (φ2 = 0) at φ1 = π/2. The crank cannot turn beyond that angle.
//! It is a fold: φ2 ≈ √(2 (π/3 - t) / √3) just before t = π/3.

use std::f64::consts::FRAC_PI_6;

use linkwright::Equations;
use linkwright::math::Real;
use linkwright::nalgebra::{Const, SMatrix, SVector};

use crate::exam_equations::Exam;

/// The exam's equations with another driver, in either scalar.
pub struct Turning;

impl<T: Real> Equations<T, Const<6>> for Turning {
    fn dimension(&self) -> Const<6> {
        Const
    }
    fn residual(&self, q: &SVector<T, 6>, t: T, phi: &mut SVector<T, 6>) {
        Exam.residual(q, T::ZERO, phi);
        phi[5] -= t;
    }
    fn jacobian(&self, q: &SVector<T, 6>, t: T, phi_q: &mut SMatrix<T, 6, 6>) {
        Exam.jacobian(q, t, phi_q);
    }
    fn time_derivative(&self, _q: &SVector<T, 6>, _t: T, phi_t: &mut SVector<T, 6>) {
        phi_t.fill(T::ZERO);
        phi_t[5] = -T::ONE;
    }
    fn gamma(&self, q: &SVector<T, 6>, qd: &SVector<T, 6>, _t: T, gamma: &mut SVector<T, 6>) {
        Exam.gamma(q, qd, T::ZERO, gamma);
    }
    fn row_scale(&self, _row: usize) -> T {
        T::ONE
    }
    fn coordinate_scale(&self, _column: usize) -> T {
        T::ONE
    }
}

/// The time (s) at which the crank stands upright and the rod lies level.
pub const DEAD_POINT: f64 = 2.0 * FRAC_PI_6;

/// The pose before the dead point, for a rod above the line of the slider's foot (`sign` +1) or below it (-1).
pub fn closed_form(t: f64, sign: f64) -> SVector<f64, 6> {
    assert!(t.abs() <= 2.0 * DEAD_POINT, "beyond the dead points");
    let root = 3.0_f64.sqrt();
    let phi1 = FRAC_PI_6 + t;
    let phi2 = sign * (1.0 - phi1.cos() / root).acos();
    let y2 = phi1.sin() + root * phi2.sin();
    SVector::from([0.0, 0.0, phi1, root, y2, phi2])
}
