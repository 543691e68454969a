//! Implements the runtime's [`Equations`] for the textbook formulation, for Newton-Raphson and linear solves.

use linkwright::Equations;
use nalgebra::{DMatrix, DVector, Dyn};

use super::TextbookEquations;

impl Equations<f64, Dyn> for TextbookEquations {
    fn dimension(&self) -> Dyn {
        Dyn(self.dimension)
    }

    fn residual(&self, q: &DVector<f64>, t: f64, phi: &mut DVector<f64>) {
        self.evaluate(&self.residual, q, None, t, phi);
    }

    fn jacobian(&self, q: &DVector<f64>, t: f64, phi_q: &mut DMatrix<f64>) {
        let scratch = &mut *self.scratch.borrow_mut();
        self.fill(&mut scratch.symbols, &self.positions, q.as_slice());
        self.set_time(scratch, t);
        let entries = &mut scratch.results[..self.places.len()];
        self.jacobian
            .evaluate(&scratch.symbols, &mut scratch.workspace, entries);
        phi_q.fill(0.0);
        let matrix = phi_q.as_mut_slice();
        for (place, entry) in self.places.iter().zip(entries) {
            matrix[*place] = *entry;
        }
    }

    fn time_derivative(&self, q: &DVector<f64>, t: f64, phi_t: &mut DVector<f64>) {
        self.evaluate(&self.time_derivative, q, None, t, phi_t);
    }

    fn gamma(&self, q: &DVector<f64>, qd: &DVector<f64>, t: f64, gamma: &mut DVector<f64>) {
        self.evaluate(&self.gamma, q, Some(qd), t, gamma);
    }

    fn row_scale(&self, row: usize) -> f64 {
        self.row_scales[row]
    }

    fn coordinate_scale(&self, column: usize) -> f64 {
        self.coordinate_scales[column]
    }
}
