//! Holds the ranges of parameters and inputs in the form of the runtime, and words the failures of values outside of them.

use linkwright::generated::failed;
use linkwright::{Failure, FailureKind, ValueRange};
use linkwright_codegen::stages::model::{Dimension, Mechanism, range_text, si_unit, value_text};
use linkwright_codegen::stages::system::System;

/// Range with its unit.
#[derive(Clone, Debug)]
struct OwnedRange {
    ends: [f64; 2],
    unit: String,
}

/// Ranges of parameters and inputs, in the order of the description.
#[derive(Clone, Debug)]
pub(crate) struct Ranges {
    parameters: Vec<Option<OwnedRange>>,
    inputs: Vec<Option<OwnedRange>>,
}

impl Ranges {
    /// Returns the ranges of a system.
    pub(crate) fn of(system: &System) -> Ranges {
        let range = |ends: Option<[f64; 2]>, dimension: Dimension| {
            ends.map(|ends| OwnedRange {
                ends,
                unit: si_unit(dimension),
            })
        };
        let mechanism = &system.mechanism;
        let parameters = mechanism.parameters.iter();
        let inputs = mechanism.inputs.iter();
        Ranges {
            parameters: parameters.map(|it| range(it.range, it.dimension)).collect(),
            inputs: inputs.map(|it| range(it.range, it.dimension)).collect(),
        }
    }

    /// Returns the range of a parameter; `None` if it has none.
    pub(crate) fn parameter(&self, index: usize) -> Option<ValueRange<'_>> {
        of_runtime(&self.parameters, index)
    }

    /// Returns the range of an input; `None` if it has none.
    pub(crate) fn input(&self, index: usize) -> Option<ValueRange<'_>> {
        of_runtime(&self.inputs, index)
    }

    /// Returns the failure of the first input whose value at time `t` (s) is outside of its range; `None` if all are inside.
    pub(crate) fn refused(&self, values: impl Iterator<Item = f64>, t: f64) -> Option<Failure> {
        let is_outside = |(index, value): &(u16, f64)| {
            let range = self.input(usize::from(*index));
            range.is_some_and(|it| it.excludes(*value))
        };
        let (input, value) = (0..).zip(values).find(is_outside)?;
        Some(Failure {
            input: Some(input),
            ..failed(FailureKind::OutsideRange { value }, t, 0)
        })
    }
}

/// Describes a value outside of its range, in the units of messages; `None` for another failure.
pub(crate) fn outside(mechanism: &Mechanism, failure: &Failure) -> Option<String> {
    let FailureKind::OutsideRange { value } = failure.kind else {
        return None;
    };
    let (label, range, dimension) = match failure.input.map(usize::from) {
        Some(input) => {
            let input = mechanism.inputs.get(input)?;
            (
                format!("input {}", input.name),
                input.range,
                input.dimension,
            )
        }
        None => {
            let parameter = mechanism.parameters.get(usize::from(failure.block))?;
            let label = format!("parameter {}", parameter.name);
            (label, parameter.range, parameter.dimension)
        }
    };
    let units = mechanism.units.of_messages();
    let value = value_text(value, dimension, units);
    let range = range_text(range?, dimension, units);
    Some(format!("{label}: {value} is outside of its range {range}"))
}

fn of_runtime(ranges: &[Option<OwnedRange>], index: usize) -> Option<ValueRange<'_>> {
    let range = ranges.get(index)?.as_ref()?;
    Some(ValueRange {
        ends: range.ends,
        unit: &range.unit,
    })
}
