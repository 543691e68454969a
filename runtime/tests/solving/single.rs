//! One equation f(x) = 0 whose behavior under Newton-Raphson is known.

use linkwright::Equations;
use linkwright::nalgebra::{Const, SMatrix, SVector};

/// A function of one number.
pub type Scalar = fn(f64) -> f64;

/// One equation f(x) = 0 with its derivative.
pub struct Single {
    /// f(x).
    pub value: Scalar,
    /// f'(x).
    pub slope: Scalar,
    /// ∂f/∂t.
    pub time_derivative: f64,
    /// The right-hand side of the acceleration.
    pub gamma: f64,
    /// The magnitude of f.
    pub row_scale: f64,
    /// The magnitude of x.
    pub coordinate_scale: f64,
}

/// f with its derivative, in unit scales and without a rate.
pub fn single(value: Scalar, slope: Scalar) -> Single {
    Single {
        value,
        slope,
        time_derivative: 0.0,
        gamma: 0.0,
        row_scale: 1.0,
        coordinate_scale: 1.0,
    }
}

impl Equations<f64, Const<1>> for Single {
    fn dimension(&self) -> Const<1> {
        Const
    }
    fn residual(&self, q: &SVector<f64, 1>, _t: f64, phi: &mut SVector<f64, 1>) {
        phi[0] = (self.value)(q[0]);
    }
    fn jacobian(&self, q: &SVector<f64, 1>, _t: f64, phi_q: &mut SMatrix<f64, 1, 1>) {
        phi_q[0] = (self.slope)(q[0]);
    }
    fn time_derivative(&self, _q: &SVector<f64, 1>, _t: f64, phi_t: &mut SVector<f64, 1>) {
        phi_t[0] = self.time_derivative;
    }
    fn gamma(&self, _: &SVector<f64, 1>, _: &SVector<f64, 1>, _: f64, gamma: &mut SVector<f64, 1>) {
        gamma[0] = self.gamma;
    }
    fn row_scale(&self, _row: usize) -> f64 {
        self.row_scale
    }
    fn coordinate_scale(&self, _column: usize) -> f64 {
        self.coordinate_scale
    }
}
