//! Why a solve did not succeed → one value of plain numbers that a control loop can act on.
//!
//! A [`Failure`] holds no strings and no references, so it costs nothing to return. Indices count from 0.
//! The module does not know the names of coordinates or joints: whoever reports to a person maps the indices.

use core::fmt;

use crate::math::Real;

/// A solve that did not succeed: what happened, when and how far it had come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Failure<T = f64> {
    /// What happened.
    pub kind: FailureKind<T>,
    /// The time at which the equations were to be solved, in the unit of the equations (s).
    pub time: T,
    /// The block of equations that failed, in solve order; 0 for the first one, and for the textbook view as a whole.
    pub block: u16,
    /// How many Newton-Raphson steps had been taken.
    pub iterations: u16,
    /// The last scaled residual, max |Φ_i| / scale_i; not finite if it is the residual that is not.
    pub residual: T,
    /// The equation with that residual; the first one that is not finite, if any.
    pub row: u16,
}

/// What happened to a solve that did not succeed.
///
/// The thresholds are those of [`crate::newton::solve`]; every comparison is made after scaling.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FailureKind<T = f64> {
    /// The Jacobian is singular, or so close to it that no digit of a solution can be trusted.
    Singular {
        /// The pivot ratio that was found, below [`crate::Settings::pivot_ratio`]; see [`crate::Factorization`].
        pivot_ratio: T,
        /// The coordinate at which elimination stopped: it depends on those before it.
        column: u16,
    },
    /// The iterates run away: a step is longer than [`crate::newton::LONGEST_STEP`] coordinate scales, or the
    /// residual is more than [`crate::newton::LARGEST_GROWTH`] times the first one (or times 1, if that is larger),
    /// or it has grown in [`crate::newton::GROWING_STEPS`] consecutive steps.
    Diverged,
    /// A pose came back to within [`crate::newton::ROUNDING`] ε of an earlier one, so that all that follows repeats.
    Cycling,
    /// A step was shorter than [`crate::newton::ROUNDING`] ε of every coordinate (or of its scale, if that is
    /// larger), and the residual still exceeds the tolerance: no better pose can be represented.
    Stalled,
    /// None of the other failures occurred within [`crate::Settings::iterations`] steps.
    IterationLimit,
    /// The links of a closed-form block do not span the distance between their far pins.
    OutOfReach {
        /// How much is missing, in m.
        by: T,
    },
    /// A time, a pose, a residual, an entry of the Jacobian, a velocity or an acceleration is infinite or NaN,
    /// or a scale of the equations is not a positive finite number.
    NotFinite,
}

impl<T: Real> Failure<T> {
    /// The same failure, ascribed to the block with the index `block`.
    #[must_use]
    pub fn in_block(self, block: u16) -> Self {
        Self { block, ..self }
    }
}

impl<T: Real> fmt::Display for Failure<T> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            kind,
            time,
            block,
            iterations,
            residual,
            row,
        } = self;
        let what = match kind {
            FailureKind::Singular {
                pivot_ratio,
                column,
            } => {
                write!(
                    formatter,
                    "singular Jacobian: pivot ratio {pivot_ratio:.1e} at coordinate {column}"
                )?;
                None
            }
            FailureKind::OutOfReach { by } => {
                write!(formatter, "out of reach by {by:.1e} m")?;
                None
            }
            FailureKind::Diverged => Some("diverged"),
            FailureKind::Cycling => Some("cycling"),
            FailureKind::Stalled => Some("stalled"),
            FailureKind::IterationLimit => Some("iteration limit"),
            FailureKind::NotFinite => Some("not finite"),
        };
        if let Some(what) = what {
            write!(
                formatter,
                "{what}: scaled residual {residual:.1e} in equation {row} after {iterations} steps"
            )?;
        }
        if *block != 0 {
            write!(formatter, ", block {block}")?;
        }
        write!(formatter, ", t = {time}")
    }
}

impl<T: Real> core::error::Error for Failure<T> {}

/// The index of a row or column as a failure stores it; larger ones than 65535 are reported as 65535.
pub(crate) fn index(index: usize) -> u16 {
    u16::try_from(index).unwrap_or(u16::MAX)
}
