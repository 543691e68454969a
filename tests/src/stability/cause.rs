//! Finds the cause of a typed failure at an instant with a pose, from the exact motion and the bounds alone.

use super::bounded::Margin;
use super::verdict::{Scalar, Way};

/// Cause of a failure although a pose exists.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Cause {
    /// Powers of the lengths, up to the fourth, overflow or are subnormal in the scalar.
    Range,
    /// Within its error the pose cannot be told from a singular one: the Jacobian changes by as much as its own
    /// magnitude.
    Singular,
    /// The inputs determine the pose to less than three digits.
    NoDigits,
    /// The driver moves too far in one step for the path to be followed.
    Step,
    /// Plain Newton-Raphson does not converge from this estimate, nor promises to.
    Plain,
    /// None of these.
    Other,
}

impl Cause {
    /// All causes, in the order of a report.
    pub const ALL: [Cause; 6] = [
        Cause::Singular,
        Cause::NoDigits,
        Cause::Range,
        Cause::Step,
        Cause::Plain,
        Cause::Other,
    ];

    /// Label in reports.
    pub fn words(self) -> &'static str {
        match self {
            Cause::Range => "powers of the lengths leave the range of the scalar",
            Cause::Singular => "the pose cannot be told from a singular one",
            Cause::NoDigits => "less than three digits of the pose are determined",
            Cause::Step => "the driver moves too far in a step for the path to be followed",
            Cause::Plain => "plain Newton-Raphson does not converge from the estimate, as it may",
            Cause::Other => "another cause",
        }
    }
}

/// Error of a pose beyond which it has less than three digits.
pub const NO_DIGITS: f64 = 1e-3;

/// Cause of a failure: `length` is the size of the mechanism, `pose` the bounds in the coordinates' scales, `change`
/// the relative change of the Jacobian within the error of the pose.
pub fn cause(
    kind: &str,
    way: Way,
    first: bool,
    scalar: Scalar,
    length: f64,
    pose: &[Margin],
    change: f64,
) -> Cause {
    let (smallest, largest) = scalar.range();
    let power = length.powi(4);
    if power < smallest / scalar.epsilon() || power > largest {
        return Cause::Range;
    }
    if pose
        .iter()
        .any(|margin| margin.worst.is_finite() && margin.worst > NO_DIGITS)
    {
        return Cause::NoDigits;
    }
    if change >= SINGULAR_CHANGE {
        return Cause::Singular;
    }
    if kind == "step too large" && !first {
        return Cause::Step;
    }
    if way == Way::Plain {
        return Cause::Plain;
    }
    Cause::Other
}

/// Change of the Jacobian within the error from which on a pose may be taken for a singular one. The solver's limit
/// is an eighth, where it takes the largest singular vector for all errors.
const SINGULAR_CHANGE: f64 = 1.0 / 16.0;
