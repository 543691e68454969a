//! A synthetic ring of 30 coordinates: q_i + sin(q_{i+1}) / 10 + cos(t + i) / 20 = 0.
//!
//! It has the size of the excavator's textbook block and no closed form that a compiler could find.

use linkwright::Equations;
use linkwright::math::Real;
use linkwright::nalgebra::{Const, SMatrix, SVector};

/// The number of coordinates.
pub const SIZE: usize = 30;

/// The ring's equations in either scalar.
pub struct Ring;

impl<T: Real> Equations<T, Const<SIZE>> for Ring {
    fn dimension(&self) -> Const<SIZE> {
        Const
    }

    fn residual(&self, q: &SVector<T, SIZE>, t: T, phi: &mut SVector<T, SIZE>) {
        let neighbors = q.iter().cycle().skip(1);
        let mut phase = t;
        for ((row, coordinate), neighbor) in phi.iter_mut().zip(q.iter()).zip(neighbors) {
            *row = *coordinate
                + Real::sin(*neighbor) * T::from_f64(0.1)
                + Real::cos(phase) * T::from_f64(0.05);
            phase += T::ONE;
        }
    }

    fn jacobian(&self, q: &SVector<T, SIZE>, _t: T, phi_q: &mut SMatrix<T, SIZE, SIZE>) {
        for (j, (column, coordinate)) in phi_q.data.0.iter_mut().zip(q.iter()).enumerate() {
            let coupled = if j == 0 { SIZE - 1 } else { j - 1 };
            for (i, entry) in column.iter_mut().enumerate() {
                *entry = if i == j {
                    T::ONE
                } else if i == coupled {
                    Real::cos(*coordinate) * T::from_f64(0.1)
                } else {
                    T::ZERO
                };
            }
        }
    }

    fn time_derivative(&self, _q: &SVector<T, SIZE>, t: T, phi_t: &mut SVector<T, SIZE>) {
        let mut phase = t;
        for row in phi_t.iter_mut() {
            *row = -Real::sin(phase) * T::from_f64(0.05);
            phase += T::ONE;
        }
    }

    fn gamma(
        &self,
        q: &SVector<T, SIZE>,
        qd: &SVector<T, SIZE>,
        t: T,
        gamma: &mut SVector<T, SIZE>,
    ) {
        let neighbors = q.iter().zip(qd.iter()).cycle().skip(1);
        let mut phase = t;
        for (row, (angle, rate)) in gamma.iter_mut().zip(neighbors) {
            *row = Real::sin(*angle) * *rate * *rate * T::from_f64(0.1)
                + Real::cos(phase) * T::from_f64(0.05);
            phase += T::ONE;
        }
    }

    fn row_scale(&self, _row: usize) -> T {
        T::ONE
    }

    fn coordinate_scale(&self, _column: usize) -> T {
        T::ONE
    }
}
