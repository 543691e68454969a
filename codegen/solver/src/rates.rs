//! Rates of a state, which may not exist everywhere, as methods of integration ask for them.

/// Rates of a state at a time; an error where there are none.
pub trait Rates {
    /// Why there are none.
    type Failure;

    /// Writes the rates.
    ///
    /// # Errors
    /// They do not exist there.
    fn rates(&mut self, t: f64, state: &[f64], rates: &mut [f64]) -> Result<(), Self::Failure>;

    /// Number of components, from the first, whose error counts. Rates depend on them alone: all others are integrals along the way.
    fn judged(&self) -> usize;

    /// Size beyond which a component allows no larger error: angles grow with every turn, and what happens at them does not.
    fn largest(&self, _component: usize) -> f64 {
        f64::INFINITY
    }

    /// Sizes of judged components, beside which rates change slowly, at a state with these rates before a step of a length.
    fn scales(&self, state: &[f64], _slope: &[f64], _length: f64) -> Vec<f64> {
        let own = state.iter().take(self.judged());
        own.map(|it| it.abs().max(1.0)).collect()
    }
}
