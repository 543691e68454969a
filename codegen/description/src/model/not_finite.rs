//! Explains infinite and undefined values of expressions: a division by zero, an argument outside a function's domain, or a
//! number that is too large.

use super::expression::Value;
use super::resolve::Resolver;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::expr::ExprId;
use crate::syntax::{Expression, ExpressionKind, Operation};

/// Bound on lengths, in m: the fourth power must be finite, and no closed form needs a higher one.
const MAX_LENGTH: f64 = 1e75;

/// Bound on the cosine below which the tangent is undefined: no written angle is a right angle to the last digit.
const MIN_COSINE: f64 = 1e-9;

/// Cause of an error, with its location and remedy.
struct Cause {
    span: Span,
    message: String,
    label: String,
    help: String,
}

impl Resolver<'_> {
    /// Returns the value unless it is infinite or undefined. All parts of the expression must be finite.
    pub(super) fn finite(&mut self, value: Value, written: &Expression) -> Option<Value> {
        let evaluates = self
            .graph
            .constant_value(value.0)
            .is_none_or(f64::is_finite);
        if evaluates && self.graph.is_finite(value.0) {
            return Some(value);
        }
        // A passed bound of the graph is reported at its statement.
        if self.graph.excess().is_some() {
            return None;
        }
        let cause = match &written.kind {
            ExpressionKind::Product(factors) => self.zero_divisor(factors),
            ExpressionKind::Power(base, exponent) => self.undefined_power(base, exponent),
            ExpressionKind::Call {
                function,
                arguments,
            } => self.outside_domain(&function.text, arguments, written.span),
            _ => None,
        };
        let cause = cause.unwrap_or_else(|| Cause {
            span: written.span,
            message: "this number is too large".to_string(),
            label: "beyond 1.8e308".to_string(),
            help: "check the unit and the exponent".to_string(),
        });
        self.diagnostics.push(
            Diagnostic::error(Code::NotFinite, cause.span, cause.message)
                .label(cause.label)
                .help(cause.help),
        );
        None
    }

    /// True if products of the length can be computed, as far as its value is known; otherwise reports an error.
    pub(super) fn is_measurable(&mut self, length: ExprId, span: Span) -> bool {
        let value = self.graph.constant_value(length).unwrap_or(0.0);
        if value.abs() <= MAX_LENGTH {
            return true;
        }
        self.diagnostics.push(
            Diagnostic::error(
                Code::NotFinite,
                span,
                format!("a length of {value:e} m is too large for products of lengths"),
            )
            .label(format!("beyond {MAX_LENGTH:e} m"))
            .help("check the unit and the exponent"),
        );
        false
    }

    /// Returns the value of a part that was resolved without an error.
    fn part(&mut self, written: &Expression) -> Option<f64> {
        let (value, _) = self.value(written)?;
        self.graph.constant_value(value)
    }

    fn zero_divisor(&mut self, factors: &[(Operation, Expression)]) -> Option<Cause> {
        let divisors = factors
            .iter()
            .filter(|(operation, _)| *operation == Operation::Over);
        for (_, divisor) in divisors {
            if self.part(divisor) == Some(0.0) {
                return Some(division_by_zero(divisor.span));
            }
        }
        None
    }

    fn undefined_power(&mut self, base: &Expression, exponent: &Expression) -> Option<Cause> {
        let (base_value, exponent_value) = (self.part(base)?, self.part(exponent)?);
        if base_value == 0.0 && exponent_value < 0.0 {
            return Some(division_by_zero(base.span));
        }
        (base_value < 0.0 && exponent_value.fract() != 0.0).then(|| Cause {
            span: base.span,
            message: "a fractional power of a negative number".to_string(),
            label: format!("this is {base_value}"),
            help: "only integer powers of a negative number are real".to_string(),
        })
    }

    fn outside_domain(
        &mut self,
        function: &str,
        arguments: &[Expression],
        span: Span,
    ) -> Option<Cause> {
        let argument = arguments.first()?;
        let value = self.part(argument)?;
        let (outside, domain) = match function {
            "asin" | "acos" => (value.abs() > 1.0, "numbers from -1 to 1"),
            "sqrt" => (value < 0.0, "numbers that are not negative"),
            "ln" => (value <= 0.0, "positive numbers"),
            "tan" => (
                value.cos().abs() < MIN_COSINE,
                "angles other than 90deg, 270deg, …",
            ),
            "atan2" => (value == 0.0, "two numbers that are not both zero"),
            _ => return None,
        };
        outside.then(|| Cause {
            span,
            message: format!("`{function}` takes {domain}"),
            label: format!("this is `{function}` of {value}"),
            help: format!("check the sign and the unit in the argument of `{function}`"),
        })
    }
}

fn division_by_zero(span: Span) -> Cause {
    Cause {
        span,
        message: "division by zero".to_string(),
        label: "this is zero".to_string(),
        help: "divide by a value other than zero".to_string(),
    }
}
