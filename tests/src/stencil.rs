//! First and second derivatives of a function from equidistant values, with bounds on their errors.
//!
//! Central differences of fourth order (Abramowitz & Stegun, table 25.2), whose Taylor remainders and rounding errors
//! are bounded by a [`Majorant`] of the function on the line through the points.

use crate::majorant::Majorant;

/// An estimate of a derivative.
#[derive(Clone, Copy, Debug)]
pub struct Quotient {
    /// The estimate.
    pub value: f64,
    /// The largest difference to the derivative.
    pub error: f64,
}

/// f'(0) from the values of f at -2h, -h, h, 2h. The majorant holds for |s| ≤ 2h.
///
/// (f₋₂ - 8 f₋₁ + 8 f₁ - f₂) / 12h; the remainder of f_i is at most c₅ (i h)⁵.
pub fn first(values: [f64; 4], h: f64, majorant: &Majorant<6>) -> Quotient {
    let [f0, f1, f2, f3] = values;
    let value = ((f0 - f3) + 8.0 * (f2 - f1)) / (12.0 * h);
    let truncation = (2.0 * 8.0 + 2.0 * 32.0) / 12.0 * majorant.coefficients[5] * h.powi(4);
    Quotient {
        value,
        error: truncation + rounding(majorant, 18.0 / 12.0 / h),
    }
}

/// f''(0) from the values of f at -2h, -h, 0, h, 2h. The majorant holds for |s| ≤ 2h.
///
/// (-f₋₂ + 16 f₋₁ - 30 f₀ + 16 f₁ - f₂) / 12h²; the remainder of f_i is at most c₆ (i h)⁶.
pub fn second(values: [f64; 5], h: f64, majorant: &Majorant<7>) -> Quotient {
    let [f0, f1, f2, f3, f4] = values;
    let value = (16.0 * (f1 + f3) - (f0 + f4) - 30.0 * f2) / (12.0 * h * h);
    let truncation = (2.0 * 16.0 + 2.0 * 64.0) / 12.0 * majorant.coefficients[6] * h.powi(4);
    Quotient {
        value,
        error: truncation + rounding(majorant, 64.0 / 12.0 / (h * h)),
    }
}

/// Bound on the rounding of a quotient: that of the values, and of at most six operations on them, for weights with
/// this sum of absolute values.
fn rounding<const N: usize>(majorant: &Majorant<N>, weights: f64) -> f64 {
    weights * (majorant.error + 6.0 * f64::EPSILON * (majorant.coefficients[0] + majorant.error))
}
