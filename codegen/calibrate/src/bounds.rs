//! Bounds of parameters, and the unbounded variables that a minimizer changes in their place.
//!
//! A value between two bounds is a sine of its variable (James and Roos 1975, *Minuit*), one beyond a single bound an
//! exponential of it. Every value that is tried therefore lies strictly within, and none is cut off.

/// Part of the width, or of the distance at the start, below which a value is at its bound.
const AT: f64 = 1e-6;

/// Range of a parameter's values, in SI units; infinite without a bound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Bound below every value.
    pub low: f64,
    /// Bound above every value.
    pub high: f64,
}

impl Bounds {
    /// Range without bounds.
    pub const NONE: Bounds = Bounds {
        low: f64::NEG_INFINITY,
        high: f64::INFINITY,
    };

    /// Returns the bounds of values with the sign of this one; none for zero.
    pub fn with_sign_of(value: f64) -> Bounds {
        match value {
            value if value > 0.0 => Bounds {
                low: 0.0,
                ..Bounds::NONE
            },
            value if value < 0.0 => Bounds {
                high: 0.0,
                ..Bounds::NONE
            },
            _ => Bounds::NONE,
        }
    }

    /// True if a value lies strictly within the bounds.
    pub fn contain(&self, value: f64) -> bool {
        self.low < value && value < self.high
    }

    /// Variable of a value.
    pub(crate) fn variable(&self, value: f64, start: f64) -> f64 {
        let [low, high] = [self.low.is_finite(), self.high.is_finite()];
        match (low, high) {
            (false, false) => value,
            (true, true) => (2.0 * (value - self.low) / (self.high - self.low) - 1.0).asin(),
            (true, false) => ((value - self.low) / (start - self.low)).ln(),
            (false, true) => ((self.high - value) / (self.high - start)).ln(),
        }
    }

    /// Value of a variable, and its derivative.
    pub(crate) fn value(&self, variable: f64, start: f64) -> [f64; 2] {
        let [low, high] = [self.low.is_finite(), self.high.is_finite()];
        match (low, high) {
            (false, false) => [variable, 1.0],
            (true, true) => {
                let half = 0.5 * (self.high - self.low);
                // Rounding does not leave the bounds, outside of which the parameter may be refused.
                let value = self.low + half * (1.0 + variable.sin());
                [value.min(self.high), half * variable.cos()]
            }
            (true, false) => {
                let above = (start - self.low) * variable.exp();
                [self.low + above, above]
            }
            (false, true) => {
                let below = (self.high - start) * variable.exp();
                [self.high - below, -below]
            }
        }
    }

    /// Bound at which a value is; `None` if it is at none.
    pub fn reached(&self, value: f64, start: f64) -> Option<f64> {
        let width = self.high - self.low;
        let least = |bound: f64| {
            AT * if width.is_finite() {
                width
            } else {
                (start - bound).abs()
            }
        };
        [self.low, self.high]
            .into_iter()
            .find(|it| it.is_finite() && (value - it).abs() <= least(*it))
    }
}

#[cfg(test)]
mod tests {
    use super::Bounds;

    #[test]
    fn values_come_back_and_slopes_are_those_of_the_value() {
        let [positive, negative] = [1.0, -1.0].map(Bounds::with_sign_of);
        let between = Bounds {
            low: -0.5,
            high: 2.0,
        };
        for (bounds, start, value) in [
            (Bounds::NONE, 0.3, -0.7),
            (positive, 0.3, 0.1),
            (negative, -0.3, -0.8),
            (between, 0.3, 1.9),
        ] {
            let variable = bounds.variable(value, start);
            let [found, slope] = bounds.value(variable, start);
            assert!((found - value).abs() < 1e-15, "{found} {value}");
            let h = 1e-6;
            let [after, before] = [h, -h].map(|it| bounds.value(variable + it, start)[0]);
            assert!((slope - (after - before) / (2.0 * h)).abs() < 1e-8);
            assert!(bounds.contain(value) && bounds.reached(value, start).is_none());
        }
        assert_eq!(positive.reached(1e-9, 0.3), Some(0.0));
        assert!(!negative.contain(0.0));
    }
}
