//! Declares [`Settings`], the limits of a solve that a caller may choose, with defaults for both scalars.
//!
//! All settings are unitless, because residuals and pivots are judged after scaling (see [`crate::scale`]), by
//! [`crate::newton`] and [`crate::linear`].

use crate::math::Real;

/// Tolerance in double precision: 4500 ε. Rounding leaves less in a residual, and the polishing step removes the rest.
const TOLERANCE: f64 = 1e-12;

/// Tolerance in single precision: 84 ε, for the same reason.
const TOLERANCE_SINGLE: f64 = 1e-5;

/// Number of Newton-Raphson steps of one call.
const ITERATIONS: u16 = 25;

/// Multiple of ε below which a ratio of pivots is rounding.
///
/// Elimination of an n × n matrix leaves errors of a few n ε in its pivots. At the sizes this crate is for, no digit of
/// a pivot below 64 ε can be told from such an error.
const PIVOT_RATIO: f64 = 64.0;

/// Number of attempts to advance.
const SUBSTEPS: u16 = 256;

/// Limits within which a solve must succeed.
///
/// `Settings::default()` exists for `f64` and for `f32`; the table gives both.
///
/// | setting | `f64` | `f32` |
/// |---|---|---|
/// | `tolerance` | 1e-12 | 1e-5 |
/// | `iterations` | 25 | 25 |
/// | `pivot_ratio` | 64 ε = 1.4e-14 | 64 ε = 7.6e-6 |
/// | `polish` | true | true |
/// | `substeps` | 256 | 256 |
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings<T = f64> {
    /// Largest scaled residual max |Φ_i| / scale_i that counts as solved.
    pub tolerance: T,
    /// Largest number of Newton-Raphson steps of one call, without the polishing step.
    pub iterations: u16,
    /// Smallest pivot ratio of a Jacobian that counts as regular; see [`FailureKind::Singular`](crate::FailureKind).
    pub pivot_ratio: T,
    /// True if a pose that has met the tolerance is polished to rounding level.
    ///
    /// Convergence is quadratic, so one more step, with the newest factorization, usually removes all that the
    /// tolerance left.
    pub polish: bool,
    /// Largest number of attempts of [`crate::Frame::follow`], and of [`crate::Shell::advance`], to advance; the least is
    /// one.
    ///
    /// An attempt that fails halves the step. Two attempts are worth about one bit of the time at which a path ends.
    pub substeps: u16,
}

impl Default for Settings<f64> {
    fn default() -> Self {
        with_tolerance(TOLERANCE)
    }
}

impl Default for Settings<f32> {
    fn default() -> Self {
        with_tolerance(TOLERANCE_SINGLE)
    }
}

fn with_tolerance<T: Real>(tolerance: f64) -> Settings<T> {
    Settings {
        tolerance: T::from_f64(tolerance),
        iterations: ITERATIONS,
        pivot_ratio: T::EPSILON * T::from_f64(PIVOT_RATIO),
        polish: true,
        substeps: SUBSTEPS,
    }
}
