//! *A typed failure where there is a pose* → *its cause*, from the exact motion and the bounds alone.

use super::bounded::Margin;
use super::verdict::{Scalar, Way};

/// Why a pose that exists is not found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Cause {
    /// Powers of the lengths, up to the fourth, are no normal numbers of the scalar.
    Range,
    /// Within its error the pose cannot be told from a singular one: the Jacobian changes by as much as itself.
    Singular,
    /// What is given determines the pose to less than three digits.
    NoDigits,
    /// The driver moves too far in one step for the path to be followed.
    Step,
    /// Plain Newton-Raphson does not come from this estimate to a pose, and is not asked to.
    Plain,
    /// None of these.
    Other,
}

impl Cause {
    /// All of them, in the order of a report.
    pub const ALL: [Cause; 6] = [
        Cause::Singular,
        Cause::NoDigits,
        Cause::Range,
        Cause::Step,
        Cause::Plain,
        Cause::Other,
    ];

    /// What it is called.
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

/// The error of a pose beyond which it has less than three digits.
pub const NO_DIGITS: f64 = 1e-3;

/// Why there is no answer: `length` is the size of the mechanism, `pose` the bounds in the coordinates' scales, `change` by how
/// much the Jacobian changes within the error of the pose.
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
    if change >= CLOSE {
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

/// The change of the Jacobian within the error from which on a pose may be taken for a singular one. The solver's verdict
/// falls at an eighth, where it takes the largest singular vector for all errors.
const CLOSE: f64 = 1.0 / 16.0;
