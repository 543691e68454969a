//! Defines the rates of a state that methods of integration need.

/// Rates of a state at a time, which may not exist everywhere.
pub trait Rates {
    /// Reason that rates do not exist.
    type Failure;

    /// Writes the rates of a state at a time (s).
    ///
    /// # Errors
    /// The rates do not exist there.
    fn rates(&mut self, t: f64, state: &[f64], rates: &mut [f64]) -> Result<(), Self::Failure>;

    /// Number of components, from the first, whose error counts. Rates depend on them alone: the others are integrals along the motion.
    fn judged(&self) -> usize;

    /// Largest magnitude that raises the tolerance of a component: angles grow with every turn, but their effects do not.
    fn largest(&self, _component: usize) -> f64 {
        f64::INFINITY
    }

    /// Returns scales of the judged components within which rates change slowly, at a state with these rates before a step of a length.
    fn scales(&self, state: &[f64], _slope: &[f64], _length: f64) -> Vec<f64> {
        let judged = state.iter().take(self.judged());
        judged.map(|it| it.abs().max(1.0)).collect()
    }
}
