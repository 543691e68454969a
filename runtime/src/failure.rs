//! Solve failures as numbers, for a control loop to act on.
//!
//! A [`Failure`] holds no strings and no references, so it costs nothing to return. Indices count from 0; messages map
//! them to names.

use core::fmt;

use crate::math::Real;

/// Failure of a solve: its kind, its time and the progress of the solve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Failure<T = f64> {
    /// Kind of the failure.
    pub kind: FailureKind<T>,
    /// Time for which the equations were to be solved, in the unit of the equations (s).
    pub time: T,
    /// Block of equations that failed, in solve order; 0 for the first one, and for the textbook formulation as a
    /// whole.
    pub block: u16,
    /// Number of completed Newton-Raphson steps.
    pub iterations: u16,
    /// Last scaled residual, max |Φ_i| / scale_i; not finite if the residual is the value that is not finite.
    pub residual: T,
    /// Equation with that residual; the first one that is not finite, if any.
    pub row: u16,
    /// Index of the input that is not finite or outside of its range; `None` if the failure has another cause.
    pub input: Option<u16>,
}

/// Kinds of failure.
///
/// Every comparison is made after scaling, with the thresholds on the page [`thresholds`](crate::thresholds). The known
/// failures of Newton-Raphson have these names:
///
/// | iteration | kind |
/// |---|---|
/// | the iterates diverge | [`Diverged`](Self::Diverged) |
/// | the iterates cycle | [`Cycling`](Self::Cycling) |
/// | the iterates converge to another root | [`WrongBranch`](Self::WrongBranch), if the branch is given |
/// | an iterate is a stationary point | [`Singular`](Self::Singular), at the step from there |
/// | the Jacobian is singular at the solution | [`Singular`](Self::Singular), of a frame |
/// | no root is near, or none exists | [`Stalled`](Self::Stalled) or one of the first two |
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FailureKind<T = f64> {
    /// The Jacobian is singular, or so close to singular that no digit of a solution can be trusted.
    ///
    /// Either a pivot ratio is below [`crate::Settings::pivot_ratio`], or the pose of a frame cannot be told from a
    /// singular one: within the uncertainty that its residual leaves, the Jacobian changes by half of itself or more.
    Singular {
        /// Smallest ratio of a pivot to the largest entry of the scaled Jacobian, or to 1 if that is larger.
        pivot_ratio: T,
        /// Coordinate at which elimination stopped, because it depends on those before it, or the coordinate that the
        /// residual leaves most uncertain.
        column: u16,
    },
    /// The iterates diverge. A step is longer than 10⁶ coordinate scales; or the residual is more than 10⁴ times the
    /// first one (or times 1, if that is larger); or the residual has grown in 5 consecutive steps.
    Diverged,
    /// A pose returned to within 4 ε of an earlier one, so that the iteration repeats.
    Cycling,
    /// A step was shorter than 4 ε of every coordinate (or of its scale, if that is
    /// larger), and the residual still exceeds the tolerance: no better pose can be represented.
    Stalled,
    /// None of the other failures occurred within [`crate::Settings::iterations`] steps, and the residual still exceeds
    /// the tolerance, or the pose has not settled.
    IterationLimit,
    /// The links of a closed-form block do not span the distance between their far pins.
    OutOfReach {
        /// Missing distance (m).
        by: T,
    },
    /// The Jacobian determinant does not have the sign of the requested branch: the pose belongs to another assembly
    /// mode.
    WrongBranch,
    /// The motion could not be followed to the requested time. Its estimate is so far from the pose that Newton-Raphson
    /// may end at another one, and [`crate::Settings::substeps`] attempts did not bring it nearer.
    StepTooLarge,
    /// The motion comes to a change point, and nothing tells in which mode it continues: it rests there, or is equally
    /// smooth in both. A shorter step does not help.
    Undecided,
    /// A length, a radius or a ratio that must be positive is not, because of parameters; or a driven length is not,
    /// because of inputs or t. The failure's block is the index of the quantity among those that must be positive.
    NotPositive {
        /// Value of the quantity.
        value: T,
    },
    /// A parameter or an input is outside of the range that the description gives it. [`Failure::input`] is the index of
    /// the input; if it is `None`, the failure's block is the index of the parameter.
    OutsideRange {
        /// Value of the parameter or the input.
        value: T,
    },
    /// The forces of friction in joints do not settle: the reactions grow with the friction that they cause, as in a mechanism that jams.
    FrictionUnsettled {
        /// Change in the last step, relative to the largest force.
        change: T,
    },
    /// An input (see [`Failure::input`]), a time, a pose, a residual, an entry of the Jacobian, a velocity or an
    /// acceleration is infinite or NaN; or a scale of the equations is not a positive finite number.
    NotFinite,
    /// A load, such as an applied force or a spring, is infinite or NaN; the pose that it follows from is finite.
    LoadNotFinite {
        /// Index of the load in the table `LOADS` of the generated module.
        load: u16,
    },
}

impl<T> FailureKind<T> {
    /// Name of the kind in tables, JSON and other languages, in lower case with underscores: `out_of_reach`. It never changes.
    ///
    /// ```
    /// assert_eq!(linkwright::FailureKind::OutOfReach { by: 0.01 }.name(), "out_of_reach");
    /// ```
    pub fn name(&self) -> &'static str {
        self.spelled()[0]
    }

    /// Words for the kind, without its figure: `Newton-Raphson diverges`.
    ///
    /// All messages take the words from here, so each kind is worded in one place.
    pub fn words(&self) -> &'static str {
        self.spelled()[1]
    }

    /// Returns name and words.
    fn spelled(&self) -> [&'static str; 2] {
        match self {
            Self::Singular { .. } => ["singular", "its Jacobian is singular"],
            Self::Diverged => ["diverged", "Newton-Raphson diverges"],
            Self::Cycling => ["cycling", "Newton-Raphson cycles"],
            Self::Stalled => ["stalled", "Newton-Raphson stalls"],
            Self::IterationLimit => ["iteration_limit", "Newton-Raphson does not converge"],
            Self::OutOfReach { .. } => ["out_of_reach", "out of reach"],
            Self::WrongBranch => ["wrong_branch", "only another assembly mode is found"],
            Self::Undecided => [
                "undecided",
                "two assembly modes meet, and the motion does not tell them apart",
            ],
            Self::StepTooLarge => [
                "step_too_large",
                "the step is too large for the motion to be followed",
            ],
            Self::NotPositive { .. } => ["not_positive", "a parameter is not positive"],
            Self::OutsideRange { .. } => ["outside_range", "a value is outside of its range"],
            Self::FrictionUnsettled { .. } => {
                ["friction_unsettled", "the forces of friction do not settle"]
            }
            Self::NotFinite => ["not_finite", "a number is not finite"],
            Self::LoadNotFinite { .. } => ["load_not_finite", "a load is not finite"],
        }
    }

    /// True if the description does not permit the value of a parameter or an input, so that no assembly exists.
    #[doc(hidden)]
    pub fn rejects_values(&self) -> bool {
        matches!(self, Self::NotPositive { .. } | Self::OutsideRange { .. })
    }

    /// True if a number is refused: the failure does not tell which block has no pose.
    pub(crate) fn refuses_number(&self) -> bool {
        matches!(
            self,
            Self::NotPositive { .. }
                | Self::NotFinite
                | Self::LoadNotFinite { .. }
                | Self::FrictionUnsettled { .. }
        )
    }
}

impl<T: Real> Failure<T> {
    /// Returns this failure, ascribed to the block with the index `block`.
    #[doc(hidden)]
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
            input,
        } = self;
        if let Some(input) = input {
            return match kind {
                FailureKind::OutsideRange { value } => write!(
                    formatter,
                    "outside of its range: input {input} of {value}, t = {time}"
                ),
                _ => write!(formatter, "not finite: input {input}, t = {time}"),
            };
        }
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
            FailureKind::NotPositive { value } => {
                return write!(
                    formatter,
                    "requirement {block}: {value:.1e} is not positive"
                );
            }
            FailureKind::OutsideRange { value } => {
                return write!(
                    formatter,
                    "outside of its range: parameter {block} of {value}"
                );
            }
            FailureKind::LoadNotFinite { load } => {
                write!(formatter, "not finite: load {load}")?;
                None
            }
            FailureKind::FrictionUnsettled { change } => {
                write!(formatter, "friction does not settle: change {change:.1e}")?;
                None
            }
            FailureKind::Diverged => Some("diverged"),
            FailureKind::Cycling => Some("cycling"),
            FailureKind::Stalled => Some("stalled"),
            FailureKind::IterationLimit => Some("iteration limit"),
            FailureKind::WrongBranch => Some("wrong branch"),
            FailureKind::StepTooLarge => Some("step too large"),
            FailureKind::Undecided => Some("undecided branch"),
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

/// Returns the index of a row or column as a failure stores it; indices above 65535 are reported as 65535.
pub(crate) fn index(index: usize) -> u16 {
    u16::try_from(index).unwrap_or(u16::MAX)
}
