//! The exam's mechanism written by hand: a crank of length 1 and a rod of length √3 whose end moves on x = √3.
//!
//! Φ, rows as the exam writes them, with q = (x1, y1, φ1, x2, y2, φ2):
//! x1; y1; x1 + cos φ1 - x2 + √3 cos φ2; y1 + sin φ1 - y2 + √3 sin φ2; x2 - √3; φ1 - π/6 - sin 2t.

use linkwright::Equations;
use linkwright::math::Real;
use linkwright::nalgebra::{Const, SMatrix, SVector};

/// The exam's equations in either scalar.
pub struct Exam;

impl<T: Real> Equations<T, Const<6>> for Exam {
    fn dimension(&self) -> Const<6> {
        Const
    }

    fn residual(&self, q: &SVector<T, 6>, t: T, phi: &mut SVector<T, 6>) {
        let [x1, y1, phi1, x2, y2, phi2] = q.data.0[0];
        let two = T::from_f64(2.0);
        let root = Real::sqrt(T::from_f64(3.0));
        let sixth = T::from_f64(core::f64::consts::FRAC_PI_6);
        let (sin1, cos1) = Real::sin_cos(phi1);
        let (sin2, cos2) = Real::sin_cos(phi2);
        phi.data.0[0] = [
            x1,
            y1,
            x1 + cos1 - x2 + root * cos2,
            y1 + sin1 - y2 + root * sin2,
            x2 - root,
            phi1 - sixth - Real::sin(two * t),
        ];
    }

    fn jacobian(&self, q: &SVector<T, 6>, _t: T, phi_q: &mut SMatrix<T, 6, 6>) {
        let [_, _, phi1, _, _, phi2] = q.data.0[0];
        let (o, i) = (T::ZERO, T::ONE);
        let root = Real::sqrt(T::from_f64(3.0));
        let (sin1, cos1) = Real::sin_cos(phi1);
        let (sin2, cos2) = Real::sin_cos(phi2);
        // One line per column, as nalgebra stores them.
        phi_q.data.0 = [
            [i, o, i, o, o, o],
            [o, i, o, i, o, o],
            [o, o, -sin1, cos1, o, i],
            [o, o, -i, o, i, o],
            [o, o, o, -i, o, o],
            [o, o, -root * sin2, root * cos2, o, o],
        ];
    }

    fn time_derivative(&self, _q: &SVector<T, 6>, t: T, phi_t: &mut SVector<T, 6>) {
        let two = T::from_f64(2.0);
        let o = T::ZERO;
        phi_t.data.0[0] = [o, o, o, o, o, -two * Real::cos(two * t)];
    }

    fn gamma(&self, q: &SVector<T, 6>, qd: &SVector<T, 6>, t: T, gamma: &mut SVector<T, 6>) {
        let [_, _, phi1, _, _, phi2] = q.data.0[0];
        let [_, _, rate1, _, _, rate2] = qd.data.0[0];
        let two = T::from_f64(2.0);
        let o = T::ZERO;
        let root = Real::sqrt(T::from_f64(3.0));
        let (sin1, cos1) = Real::sin_cos(phi1);
        let (sin2, cos2) = Real::sin_cos(phi2);
        let (square1, square2) = (rate1 * rate1, rate2 * rate2);
        gamma.data.0[0] = [
            o,
            o,
            square1 * cos1 + root * square2 * cos2,
            square1 * sin1 + root * square2 * sin2,
            o,
            -two * two * Real::sin(two * t),
        ];
    }

    fn row_scale(&self, _row: usize) -> T {
        T::ONE
    }

    fn coordinate_scale(&self, _column: usize) -> T {
        T::ONE
    }
}
