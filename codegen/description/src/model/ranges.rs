//! Resolves ranges of parameters and inputs, and writes them in units.

use super::dimension::Dimension;
use super::expression::Value;
use super::resolve::Resolver;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::syntax::{Adjustable, Expression};
use crate::units::OutputUnits;

/// Number of digits of printed values: two fewer than identify a number, so that factors of units leave no rounding.
const DIGITS: usize = 15;

impl Resolver<'_> {
    /// Returns both ends of a range in SI units and the dimension of its value with them. Reports a range that does not enclose
    /// the value; the range is `None` if it has an error.
    pub(super) fn limits(
        &mut self,
        written: &Adjustable,
        (value, mut dimension): Value,
    ) -> (Option<[f64; 2]>, Dimension) {
        let Some([low, high]) = &written.range else {
            return (None, dimension);
        };
        let ends = [low, high].map(|end| self.end(end, &mut dimension));
        let [Some(first), Some(last)] = ends else {
            return (None, dimension);
        };
        let name = &written.constant.name.text;
        let value = self.graph.constant_value(value).unwrap_or(f64::NAN);
        let (place, range) = (written.constant.value.span, low.span.to(high.span));
        if first >= last {
            self.diagnostics.push(empty(name, range));
            return (None, dimension);
        }
        if !(first..=last).contains(&value) {
            self.diagnostics.push(outside(name, place, range));
            return (None, dimension);
        }
        (Some([first, last]), dimension)
    }

    /// Returns an end in SI units, and adds its dimension; `None` if it has an error.
    pub(super) fn end(&mut self, written: &Expression, dimension: &mut Dimension) -> Option<f64> {
        self.fixed_number(written, "an end of a range", dimension)
    }

    /// Returns a number of this sort that does not depend on parameters, in SI units, and adds its dimension; `None` after an error.
    fn fixed_number(
        &mut self,
        written: &Expression,
        sort: &str,
        dimension: &mut Dimension,
    ) -> Option<f64> {
        let (value, found) = self.fitting(written, *dimension)?;
        if self.graph.is_constant(value) {
            *dimension = dimension.joined(found);
            return self.graph.constant_value(value);
        }
        let cause = self.moving(value);
        let cause = cause.unwrap_or_else(|| "a parameter".to_string());
        let message = format!("{sort} cannot depend on {cause}");
        let finding = Diagnostic::error(Code::NotConstant, written.span, message)
            .label("expected a number")
            .help("write a number with its unit, or the name of a `const` of numbers");
        self.diagnostics.push(finding);
        None
    }

    /// Returns a number as [`fixed_number`](Self::fixed_number) does; `None` also if it is negative, which is reported with this help.
    pub(super) fn fixed_extent(
        &mut self,
        written: &Expression,
        [sort, help]: [&str; 2],
        dimension: &mut Dimension,
    ) -> Option<f64> {
        let extent = self.fixed_number(written, sort, dimension)?;
        if extent < 0.0 {
            let message = format!("{sort} cannot be negative");
            let finding = Diagnostic::error(Code::ValueNotAllowed, written.span, message)
                .label("negative")
                .help(help);
            self.diagnostics.push(finding);
            return None;
        }
        Some(extent)
    }
}

fn empty(name: &str, range: Span) -> Diagnostic {
    let message = format!("the range of `{name}` does not enclose anything");
    Diagnostic::error(Code::ValueNotAllowed, range, message)
        .label("the second end is not larger than the first one")
        .help("write the smaller end first: `from 80mm to 160mm`")
}

fn outside(name: &str, value: Span, range: Span) -> Diagnostic {
    let message = format!("the value of `{name}` is outside of its range");
    Diagnostic::error(Code::ValueNotAllowed, value, message)
        .label("not in the range")
        .also(range, "the range")
        .help("write a value in the range, or extend the range; both ends belong to it")
}

/// Returns the unit of SI of a dimension; empty for numbers and ratios.
pub fn si_unit(dimension: Dimension) -> String {
    match dimension {
        Dimension::Number | Dimension::OfTime | Dimension::RATIO => String::new(),
        _ => dimension.unit(),
    }
}

/// Returns a value in the unit of its dimension: `80 mm`.
pub fn value_text(value: f64, dimension: Dimension, units: &OutputUnits) -> String {
    let unit = units.of(&si_unit(dimension));
    unit.labeled(unit.rounded(value, DIGITS))
}

/// Returns both ends of a range in the unit of their dimension: `from 80 mm to 160 mm`.
pub fn range_text(ends: [f64; 2], dimension: Dimension, units: &OutputUnits) -> String {
    let [low, high] = ends.map(|end| value_text(end, dimension, units));
    format!("from {low} to {high}")
}
