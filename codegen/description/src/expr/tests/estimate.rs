//! Computes with floats and a bound of their error, and with pairs of value and derivative.
//!
//! The bound is first order in the rounding errors, with a margin. A bound that is not small relative to the value becomes
//! infinite, and the sample is inconclusive. Two computations of one quantity are thus compared by their possible rounding
//! errors, without a tolerance.

/// Half a unit in the last place of 1, with a margin of two for second-order terms.
const ROUNDING: f64 = f64::EPSILON;

#[derive(Clone, Copy, Debug)]
pub(super) struct Estimate {
    pub(super) value: f64,
    pub(super) error: f64,
}

impl Estimate {
    pub(super) fn exact(value: f64) -> Estimate {
        Estimate { value, error: 0.0 }
    }

    /// Returns a value with a few roundings.
    pub(super) fn rounded(value: f64) -> Estimate {
        Estimate::exact(value).with(value, 0.0)
    }

    /// Returns a result with a propagated error and its own rounding.
    fn with(self, value: f64, propagated: f64) -> Estimate {
        // The smallest normal number covers underflow.
        let error = propagated + 4.0 * ROUNDING * value.abs() + f64::MIN_POSITIVE;
        // Far from 1, an equal expression may overflow in an intermediate result, as x/√(1 + x²) does where sin(atan x) does
        // not.
        let in_range = value == 0.0 || (1e-50..1e50).contains(&value.abs());
        let error = if in_range && !error.is_nan() {
            error
        } else {
            f64::INFINITY
        };
        Estimate { value, error }
    }

    /// True if the value is accurate enough for a comparison.
    pub(super) fn is_reliable(self) -> bool {
        self.value.is_finite() && self.error <= 1e-6 * (1.0 + self.value.abs())
    }

    pub(super) fn agrees(self, other: Estimate) -> bool {
        (self.value - other.value).abs() <= self.error + other.error
    }

    /// Returns the relative error; infinite if first-order propagation is invalid.
    fn relative(self) -> f64 {
        let relative = self.error / self.value.abs();
        if relative < 1e-3 {
            relative
        } else {
            f64::INFINITY
        }
    }

    /// Returns an inconclusive value.
    pub(super) fn unknown() -> Estimate {
        Estimate {
            value: 0.0,
            error: f64::INFINITY,
        }
    }

    /// True if the value is negative; `None` if the error leaves a doubt.
    pub(super) fn is_below_zero(self) -> Option<bool> {
        (self.value.abs() > self.error || self.error == 0.0).then_some(self.value < 0.0)
    }

    /// Returns the greatest whole number that does not exceed the value; unknown if the error leaves a doubt.
    pub(super) fn floor(self) -> Estimate {
        let floor = self.value.floor();
        let gap = (self.value - floor).min(floor + 1.0 - self.value);
        if gap > self.error || self.error == 0.0 {
            Estimate::exact(floor)
        } else if !self.value.is_finite() {
            self
        } else {
            Estimate::unknown()
        }
    }

    pub(super) fn add(self, other: Estimate) -> Estimate {
        self.with(self.value + other.value, self.error + other.error)
    }

    pub(super) fn mul(self, other: Estimate) -> Estimate {
        let propagated =
            self.error * (other.value.abs() + other.error) + self.value.abs() * other.error;
        self.with(self.value * other.value, propagated)
    }

    pub(super) fn neg(self) -> Estimate {
        Estimate {
            value: -self.value,
            error: self.error,
        }
    }

    pub(super) fn recip(self) -> Estimate {
        let value = 1.0 / self.value;
        self.with(value, 1.1 * value.abs() * self.relative())
    }

    /// Returns the power with a rational exponent.
    pub(super) fn pow(self, numerator: i32, denominator: i32) -> Estimate {
        if numerator == 0 {
            return Estimate::exact(1.0);
        }
        if (numerator, denominator) == (1, 1) {
            return self;
        }
        if denominator == 1 && numerator > 0 {
            let rest = self.pow(numerator - 1, 1);
            return self.mul(rest);
        }
        let exponent = f64::from(numerator) / f64::from(denominator);
        let value = if denominator == 1 {
            self.value.powi(numerator)
        } else {
            self.value.powf(exponent)
        };
        let relative = self.relative() * exponent.abs() * 2.0
            + (exponent.abs() + 1.0) * (self.value.abs().ln().abs() + 1.0) * ROUNDING;
        self.with(value, value.abs() * relative)
    }

    pub(super) fn sin(self) -> Estimate {
        self.with(self.value.sin(), self.error)
    }

    pub(super) fn cos(self) -> Estimate {
        self.with(self.value.cos(), self.error)
    }

    pub(super) fn exp(self) -> Estimate {
        let value = self.value.exp();
        let error = if self.error < 1e-3 {
            self.error
        } else {
            f64::INFINITY
        };
        self.with(value, 1.1 * value * error)
    }

    pub(super) fn ln(self) -> Estimate {
        self.with(self.value.ln(), 1.1 * self.relative())
    }

    pub(super) fn atan2(self, x: Estimate) -> Estimate {
        let value = self.value.atan2(x.value);
        let length = self.value.hypot(x.value);
        let near_cut = x.value < 0.0 && self.value.abs() <= self.error;
        let near_origin = self.error + x.error > 1e-3 * length || length == 0.0;
        let propagated = if near_cut || near_origin {
            f64::INFINITY
        } else {
            1.1 * (self.error + x.error) / length
        };
        self.with(value, propagated)
    }
}

/// A value with its derivative with respect to one symbol: differentiation without a difference quotient.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dual {
    pub(super) value: Estimate,
    pub(super) slope: Estimate,
}

impl Dual {
    pub(super) fn constant(value: Estimate) -> Dual {
        let slope = Estimate::exact(0.0);
        Dual { value, slope }
    }

    fn chain(self, value: Estimate, outer: Estimate) -> Dual {
        let slope = self.slope.mul(outer);
        Dual { value, slope }
    }

    pub(super) fn add(self, other: Dual) -> Dual {
        Dual {
            value: self.value.add(other.value),
            slope: self.slope.add(other.slope),
        }
    }

    pub(super) fn mul(self, other: Dual) -> Dual {
        let (left, right) = (self.slope.mul(other.value), self.value.mul(other.slope));
        Dual {
            value: self.value.mul(other.value),
            slope: left.add(right),
        }
    }

    pub(super) fn pow(self, numerator: i32, denominator: i32) -> Dual {
        let exponent = Estimate::rounded(f64::from(numerator) / f64::from(denominator));
        let outer = exponent.mul(self.value.pow(numerator - denominator, denominator));
        self.chain(self.value.pow(numerator, denominator), outer)
    }

    pub(super) fn sin(self) -> Dual {
        self.chain(self.value.sin(), self.value.cos())
    }

    pub(super) fn cos(self) -> Dual {
        self.chain(self.value.cos(), self.value.sin().neg())
    }

    pub(super) fn exp(self) -> Dual {
        self.chain(self.value.exp(), self.value.exp())
    }

    pub(super) fn ln(self) -> Dual {
        self.chain(self.value.ln(), self.value.recip())
    }

    pub(super) fn atan2(self, x: Dual) -> Dual {
        let square = self.value.pow(2, 1).add(x.value.pow(2, 1));
        let (forward, backward) = (x.value.mul(self.slope), self.value.mul(x.slope));
        Dual {
            value: self.value.atan2(x.value),
            slope: forward.add(backward.neg()).mul(square.recip()),
        }
    }

    /// Returns the arcsine by its own derivative, independently of its expression.
    pub(super) fn asin(self) -> Dual {
        let value = self.value.value.asin();
        let across = Estimate::exact(1.0)
            .add(self.value.pow(2, 1).neg())
            .pow(1, 2);
        let propagated = Estimate {
            value,
            error: 1.1 * self.value.error * across.recip().value
                + 8.0 * ROUNDING * value.abs()
                + across.recip().error,
        };
        self.chain(propagated, across.recip())
    }
}
