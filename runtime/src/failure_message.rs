//! Words a failure as a sentence, with the names of a mechanism's blocks.
//!
//! A [`Failure`] holds no names. The function `describe` of a generated module adds them where a message is needed.
//! Neither needs an allocator.

use core::fmt;

use crate::failure::{Failure, FailureKind};
use crate::math::Real;
use crate::value_range::ValueRange;

/// Name of a block of a mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BlockName<'a> {
    /// Block: `loop F-N-M`.
    pub name: &'a str,
    /// State of the block's members at a singular pose or at the end of reach: `c2 and the actuator c8-c7 are in line`.
    /// For a quantity that must be positive, its kind: `the distance`.
    pub singular: &'a str,
}

impl<'a> BlockName<'a> {
    /// Returns a name with the state at a singular pose.
    #[doc(hidden)]
    pub const fn new(name: &'a str, singular: &'a str) -> Self {
        Self { name, singular }
    }
}

/// Failure in a mechanism's own terms; its `Display` is one sentence.
///
/// ```
/// linkwright_macros::mechanism! {
///     mechanism arm {
///         input angle = 0;
///         point O = (0, 0);
///         body boom at O { O, P: (2, 0) }
///         revolute O(ground, boom);
///         drive phi(boom) = angle;
///     }
/// }
/// use arm::{Arm, Inputs};
/// use linkwright::Signal;
///
/// let mut arm = Arm::assemble(0.0, &Inputs::INITIAL)?;
/// let inputs = Inputs { angle: Signal::constant(f64::NAN) };
/// let failure = arm.advance(0.01, &inputs).expect_err("not a number");
/// let message = arm::describe(&failure);
/// assert_eq!(message.block.map(|block| block.name), Some("angle"));
/// assert!(message.to_string().contains("angle"), "{message}");
/// # Ok::<(), linkwright::Failure>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FailureMessage<'a, T = f64> {
    /// Failure to describe.
    pub failure: Failure<T>,
    /// Name of the failed block, or of the parameter, input or load that is refused; `None` if it is unknown.
    pub block: Option<BlockName<'a>>,
    /// Range that the value is outside of; `None` for other failures.
    pub range: Option<ValueRange<'a, T>>,
}

impl<T: Real> FailureMessage<'_, T> {
    /// Cause of the failure, without the time.
    pub fn cause(&self) -> impl fmt::Display + '_ {
        self.cause_in("m", 1.0)
    }

    /// Returns the cause with lengths in a unit, of which a meter has `per_meter`.
    #[doc(hidden)]
    pub fn cause_in<'b>(&'b self, unit: &'b str, per_meter: f64) -> impl fmt::Display + 'b {
        Cause {
            explained: self,
            unit,
            per_meter,
        }
    }
}

struct Cause<'a, T> {
    explained: &'a FailureMessage<'a, T>,
    unit: &'a str,
    per_meter: f64,
}

impl<T: Real> Cause<'_, T> {
    /// Writes that a value is outside of its range, in the unit of the range.
    fn write_outside(&self, value: T, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let FailureMessage {
            failure,
            block,
            range,
        } = self.explained;
        formatter.write_str(match failure.input {
            Some(_) => "input ",
            None => "parameter ",
        })?;
        if let Some(block) = block {
            write!(formatter, "{}: ", block.name)?;
        }
        let Some(ValueRange {
            ends: [low, high],
            unit,
        }) = range
        else {
            return write!(formatter, "{value} is outside of its range");
        };
        let space = if unit.is_empty() { "" } else { " " };
        write!(
            formatter,
            "{value}{space}{unit} is outside of its range from {low}{space}{unit} to {high}{space}{unit}"
        )
    }
}

impl<T: Real> fmt::Display for FailureMessage<'_, T> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.failure.kind {
            FailureKind::NotPositive { .. } => write!(formatter, "{}", self.cause()),
            FailureKind::OutsideRange { .. } if self.failure.input.is_none() => {
                write!(formatter, "{}", self.cause())
            }
            _ => write!(
                formatter,
                "{}, at t = {} s",
                self.cause(),
                self.failure.time
            ),
        }
    }
}

impl<T: Real> fmt::Display for Cause<'_, T> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Failure {
            kind,
            iterations,
            residual,
            ..
        } = self.explained.failure;
        let block = self.explained.block;
        if let FailureKind::NotPositive { value } = kind {
            let what = block.map_or("a length", |required| required.singular);
            if let Some(required) = block {
                write!(formatter, "{}: ", required.name)?;
            }
            return write!(
                formatter,
                "{what} must be positive, and would be {}",
                Figure(value)
            );
        }
        if let FailureKind::OutsideRange { value } = kind {
            return self.write_outside(value, formatter);
        }
        if self.explained.failure.input.is_some() {
            let name = block.map_or("", |input| input.name);
            let space = if name.is_empty() { "" } else { " " };
            return write!(formatter, "input{space}{name} is not finite");
        }
        if let FailureKind::LoadNotFinite { .. } = kind {
            let name = block.map_or("a load", |load| load.name);
            return write!(formatter, "{name} is not finite");
        }
        if let Some(block) = block {
            write!(formatter, "{}: ", block.name)?;
        }
        let singular = block.map_or("its Jacobian is singular", |block| block.singular);
        match kind {
            FailureKind::Singular { pivot_ratio, .. } => {
                write!(formatter, "{singular} (pivot ratio {pivot_ratio:.1e})")?;
            }
            FailureKind::OutOfReach { by } => {
                write!(
                    formatter,
                    "out of reach by {} {}, beyond where {singular}",
                    Figure(by * T::from_f64(self.per_meter)),
                    self.unit
                )?;
            }
            _ => formatter.write_str(kind.words())?,
        }
        if iterations > 0 {
            let several = if iterations == 1 { "" } else { "s" };
            write!(
                formatter,
                ", after {iterations} iteration{several} with a scaled residual of {residual:.1e}"
            )?;
        }
        Ok(())
    }
}

/// Magnitudes between which plain decimals are short.
const PLAIN_DECIMAL_RANGE: [f64; 2] = [1e-3, 1e4];

/// Number with three digits, in plain decimals if these are short.
struct Figure<T>(T);

impl<T: Real> fmt::Display for Figure<T> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut size = self.0.abs();
        if size == T::ZERO {
            return formatter.write_str("0");
        }
        // Written so that NaN has an exponent's form.
        let [least, most] = PLAIN_DECIMAL_RANGE.map(T::from_f64);
        let is_short = size >= least && size < most;
        if !is_short {
            return write!(formatter, "{:.1e}", self.0);
        }
        let ten = T::from_f64(10.0);
        let mut decimals = 2_usize;
        while size < T::ONE {
            size *= ten;
            decimals += 1;
        }
        while size >= ten {
            size /= ten;
            decimals = decimals.saturating_sub(1);
        }
        write!(formatter, "{:.decimals$}", self.0)
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use std::string::ToString;

    use super::*;

    const BLOCKS: [BlockName<'static>; 2] = [
        BlockName {
            name: "explicit",
            singular: "",
        },
        BlockName {
            name: "loop F-N-M",
            singular: "c2 and the actuator c8-c7 are in line",
        },
    ];

    fn text(kind: FailureKind, block: u16, iterations: u16) -> std::string::String {
        let failure = Failure {
            kind,
            time: 0.5,
            block,
            iterations,
            residual: 2e-3,
            row: 0,
            input: None,
        };
        let block = BLOCKS.get(usize::from(block)).copied();
        let range = None;
        FailureMessage {
            failure,
            block,
            range,
        }
        .to_string()
    }

    #[test]
    fn a_value_outside_of_its_range_is_told_with_both_ends() {
        let failure = |input| Failure {
            kind: FailureKind::OutsideRange { value: 0.165 },
            time: 0.5,
            block: 0,
            iterations: 0,
            residual: 0.0,
            row: 0,
            input,
        };
        let range = ValueRange {
            ends: [0.08, 0.16],
            unit: "m",
        };
        let block = Some(BlockName::new("rod", ""));
        let text = |input, block, range| {
            let failure = failure(input);
            FailureMessage {
                failure,
                block,
                range,
            }
            .to_string()
        };
        assert_eq!(
            text(None, block, Some(range)),
            "parameter rod: 0.165 m is outside of its range from 0.08 m to 0.16 m"
        );
        assert_eq!(
            text(Some(0), block, Some(ValueRange { unit: "", ..range })),
            "input rod: 0.165 is outside of its range from 0.08 to 0.16, at t = 0.5 s"
        );
        assert_eq!(
            text(Some(0), None, None),
            "input 0.165 is outside of its range, at t = 0.5 s"
        );
        assert_eq!(
            failure(Some(2)).to_string(),
            "outside of its range: input 2 of 0.165, t = 0.5"
        );
        assert_eq!(
            failure(None).to_string(),
            "outside of its range: parameter 0 of 0.165"
        );
        for (value, is_outside) in [(0.08, false), (0.16, false), (f64::NAN, false)] {
            assert_eq!(range.excludes(value), is_outside);
        }
        assert!(range.excludes(f64::INFINITY) && range.excludes(0.08_f64.next_down()));
    }

    #[test]
    fn a_failure_is_one_sentence_about_its_block() {
        let singular = FailureKind::Singular {
            pivot_ratio: 0.0,
            column: 0,
        };
        assert_eq!(
            text(singular, 1, 0),
            "loop F-N-M: c2 and the actuator c8-c7 are in line (pivot ratio 0.0e0), at t = 0.5 s"
        );
        assert_eq!(
            text(FailureKind::OutOfReach { by: 0.25 }, 1, 0),
            "loop F-N-M: out of reach by 0.250 m, beyond where c2 and the actuator c8-c7 are in line, at t = 0.5 s"
        );
        assert_eq!(
            text(FailureKind::WrongBranch, 1, 4),
            "loop F-N-M: only another assembly mode is found, after 4 iterations with a scaled residual of 2.0e-3, at t = 0.5 s"
        );
        assert_eq!(
            text(FailureKind::NotFinite, 0, 0),
            "explicit: a number is not finite, at t = 0.5 s"
        );
        let load = FailureKind::LoadNotFinite { load: 3 };
        assert_eq!(text(load, 1, 0), "loop F-N-M is not finite, at t = 0.5 s");
        assert_eq!(text(load, 9, 0), "a load is not finite, at t = 0.5 s");
        let negative = FailureKind::NotPositive { value: -0.09 };
        assert_eq!(
            text(negative, 1, 0),
            "loop F-N-M: c2 and the actuator c8-c7 are in line must be positive, and would be -0.0900"
        );
        for (by, reach_text) in [
            (1234.5, "1234"),
            (2e5, "2.0e5"),
            (12.345, "12.3"),
            (2e-4, "2.0e-4"),
        ] {
            let reach_text = std::format!("out of reach by {reach_text} m, ");
            let reach = FailureKind::OutOfReach { by };
            assert!(text(reach, 1, 0).contains(&reach_text), "{reach_text}");
        }
        // A block that the names do not know is left out.
        assert_eq!(
            text(singular, 9, 0),
            "its Jacobian is singular (pivot ratio 0.0e0), at t = 0.5 s"
        );
    }
}
