//! Evaluates points, pressure angles and residuals in a frame of the textbook formulation.

use linkwright::generated::pressure_angle;
use linkwright::{Frame, PointMotion};
use nalgebra::{DVector, Dyn};

use super::TextbookEquations;

impl TextbookEquations {
    /// Names of the points, in the order of [`TextbookEquations::points`].
    pub fn point_names(&self) -> &[String] {
        &self.output_names
    }

    /// Returns the pressure angle of every contact at `frame`, in rad and in the order of
    /// [`System::pressures`](linkwright_codegen::stages::system::System::pressures); `None` if the follower rests.
    pub fn pressure_angles(&self, frame: &Frame<f64, Dyn>) -> Vec<Option<f64>> {
        let scratch = &mut *self.scratch.borrow_mut();
        self.fill(&mut scratch.symbols, &self.positions, frame.q.as_slice());
        self.fill(&mut scratch.symbols, &self.rates, frame.qd.as_slice());
        self.set_time(scratch, frame.t);
        let results = &mut scratch.results[..3 * self.pressure_count];
        self.pressures
            .evaluate(&scratch.symbols, &mut scratch.workspace, results);
        results
            .chunks_exact(3)
            .map(|it| pressure_angle(it[0], it[1], it[2]))
            .collect()
    }

    /// Returns the motion of every declared point at `frame`, in the order of [`System::outputs`](linkwright_codegen::stages::system::System::outputs).
    pub fn points(&self, frame: &Frame<f64, Dyn>) -> Vec<PointMotion<f64>> {
        let scratch = &mut *self.scratch.borrow_mut();
        self.fill(&mut scratch.symbols, &self.positions, frame.q.as_slice());
        self.fill(&mut scratch.symbols, &self.rates, frame.qd.as_slice());
        self.fill(
            &mut scratch.symbols,
            &self.accelerations,
            frame.qdd.as_slice(),
        );
        self.set_time(scratch, frame.t);
        let results = &mut scratch.results[..6 * self.output_names.len()];
        self.outputs
            .evaluate(&scratch.symbols, &mut scratch.workspace, results);
        results
            .chunks_exact(6)
            .map(|it| PointMotion {
                position: [it[0], it[1]],
                velocity: [it[2], it[3]],
                acceleration: [it[4], it[5]],
            })
            .collect()
    }

    /// Returns the residuals of the redundant equations, in the order of [`System::monitored`](linkwright_codegen::stages::system::System::monitored).
    pub fn monitored(&self, q: &DVector<f64>, t: f64) -> DVector<f64> {
        let mut residuals = DVector::zeros(self.monitored_count);
        self.evaluate(&self.monitored, q, None, t, &mut residuals);
        residuals
    }
}
