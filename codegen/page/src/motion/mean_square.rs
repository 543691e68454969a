//! Averages the square of a quantity over time.
//!
//! Between two instants, the quantity counts as linear.

/// Integral of the square of a quantity over time.
#[derive(Clone, Copy, Debug, Default)]
pub struct MeanSquare {
    /// Integral and duration (s) so far.
    sum: [f64; 2],
    /// Time (s) and value of the last instant.
    last: Option<[f64; 2]>,
}

impl MeanSquare {
    /// Adds the next instant.
    pub fn add(&mut self, t: f64, value: f64) {
        if let Some([before, earlier]) = self.last {
            let span = t - before;
            // The mean of the square of a linear quantity.
            let mean = (earlier * earlier + earlier * value + value * value) / 3.0;
            self.sum = [self.sum[0] + span * mean, self.sum[1] + span];
        }
        self.last = Some([t, value]);
    }

    /// Returns the root of the mean square; the magnitude of a single value, and NaN without a value.
    pub fn root(&self) -> f64 {
        match (self.sum, self.last) {
            ([_, 0.0], Some([_, value])) => value.abs(),
            ([_, 0.0], None) => f64::NAN,
            ([integral, duration], _) => (integral / duration).sqrt(),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::MeanSquare;

    #[test]
    fn means_are_those_of_integrals() {
        let mut line = MeanSquare::default();
        assert!(line.root().is_nan());
        line.add(1.0, -2.0);
        assert_eq!(line.root(), 2.0);
        line.add(3.0, 1.0);
        // ∫ (1.5 s − 2)² ds from 0 to 2, over 2.
        assert!((line.root() - 1.0).abs() < 1e-15);
        let mut wave = MeanSquare::default();
        for step in 0..=10_000 {
            let t = f64::from(step) / 10_000.0;
            wave.add(t, 3.0 * (TAU * t).sin());
        }
        assert!((wave.root() - 3.0 / 2_f64.sqrt()).abs() < 1e-6);
    }
}
