//! Resolves tolerances of parameters into distributions, and writes them in units.

use super::dimension::Dimension;
use super::expression::Value;
use super::ranges::value_text;
use super::resolve::Resolver;
use crate::diagnostic::{Code, Diagnostic};
use crate::syntax::Adjustable;
use crate::units::OutputUnits;

/// Distribution of a parameter about its value, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Distribution {
    /// All values within a distance are equally frequent.
    Uniform {
        /// Largest distance from the value.
        half_width: f64,
    },
    /// Normal distribution.
    Normal {
        /// Standard deviation.
        deviation: f64,
    },
    /// Component of an offset that is evenly spread over a disc.
    Clearance {
        /// Radius of the disc.
        radius: f64,
        /// 0 for x, 1 for y; the parameter of y follows that of x.
        axis: usize,
    },
}

/// Number of standard deviations that stand for the limits of a normal distribution, which has none.
const LIMIT_OF_NORMAL: f64 = 3.0;

impl Distribution {
    /// Returns the variance.
    pub fn variance(self) -> f64 {
        match self {
            Distribution::Uniform { half_width } => half_width * half_width / 3.0,
            Distribution::Normal { deviation } => deviation * deviation,
            Distribution::Clearance { radius, .. } => radius * radius / 4.0,
        }
    }

    /// Returns the largest distance from the value in a worst case: three standard deviations of a normal distribution.
    pub fn limit(self) -> f64 {
        match self {
            Distribution::Uniform { half_width } => half_width,
            Distribution::Normal { deviation } => LIMIT_OF_NORMAL * deviation,
            Distribution::Clearance { radius, .. } => radius,
        }
    }

    /// Returns the distribution in units of output, as a description states it: `tolerance 0.1 mm`,
    /// `sigma 0.03 mm`, `clearance 0.05 mm`.
    pub fn text(self, dimension: Dimension, units: &OutputUnits) -> String {
        let (word, extent) = match self {
            Distribution::Uniform { half_width } => ("tolerance", half_width),
            Distribution::Normal { deviation } => ("sigma", deviation),
            Distribution::Clearance { radius, .. } => ("clearance", radius),
        };
        format!("{word} {}", value_text(extent, dimension, units))
    }
}

impl Resolver<'_> {
    /// Returns the distribution of a parameter and the dimension of its value with it; `None` without a tolerance, or if it has an
    /// error.
    pub(super) fn distribution(
        &mut self,
        written: &Adjustable,
        (value, mut dimension): Value,
        range: Option<[f64; 2]>,
    ) -> (Option<Distribution>, Dimension) {
        let Some(stated) = &written.tolerance else {
            return (None, dimension);
        };
        let help = match stated.is_normal {
            true => "write the standard deviation: `sigma 0.03mm`",
            false => "write the distance to both sides: `tolerance 0.1mm`",
        };
        let extent = self.fixed_extent(&stated.extent, ["a tolerance", help], &mut dimension);
        let Some(extent) = extent else {
            return (None, dimension);
        };
        if stated.is_normal {
            let normal = Distribution::Normal { deviation: extent };
            return (Some(normal), dimension);
        }
        let value = self.graph.constant_value(value).unwrap_or(f64::NAN);
        let is_outside = |[low, high]: [f64; 2]| value - extent < low || value + extent > high;
        if let (true, Some([low, high])) = (range.is_some_and(is_outside), &written.range) {
            let name = &written.constant.name.text;
            let message = format!("the tolerance of `{name}` reaches beyond its range");
            let finding = Diagnostic::error(Code::ValueNotAllowed, stated.extent.span, message)
                .label("not in the range")
                .also(low.span.to(high.span), "the range")
                .help("write a smaller tolerance, or extend the range; both ends belong to it");
            self.diagnostics.push(finding);
            return (None, dimension);
        }
        let half_width = extent;
        (Some(Distribution::Uniform { half_width }), dimension)
    }
}
