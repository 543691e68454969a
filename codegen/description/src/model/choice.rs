//! Resolves `if … { … } else { … }` into a choice whose pieces join.
//!
//! A condition compares two values, and changes at one value of one variable, which is found if the condition is linear. The
//! pieces and their first two derivatives are compared exactly at this boundary. A jump of the value is an error, since no
//! mechanism can follow it. A jump of the rate or the acceleration is a warning. Parameters have their defaults. A boundary
//! excluded by an outer condition is ignored.

use super::expression::Value;
use super::resolve::Resolver;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::expr::{ExprId, SymbolId};
use crate::syntax::{Choice, Comparison};

/// Relative difference below which two values are equal up to rounding.
const ROUNDING: f64 = 1e-9;

/// Magnitude below which both values count as zero, in SI units.
const ZERO_LIMIT: f64 = 1e-12;

/// Names of jumps, by order of the derivative.
const LEVELS: [&str; 3] = ["value", "first derivative", "second derivative"];

impl Resolver<'_> {
    /// Evaluates a choice.
    pub(super) fn choice(&mut self, written: &Choice) -> Option<Value> {
        let (left, right) = (self.value(&written.left), self.value(&written.right));
        let sides = match (left, right) {
            (Some(left), Some(right)) => {
                let fits = self.fits_like(&written.right, right.1, (&written.left, left.1));
                fits.then_some((left.0, right.0))
            }
            _ => None,
        };
        // The choice is between `condition < 0` and the rest. For `>` and `<=`, the sides or the pieces are exchanged.
        let condition = sides.map(|(left, right)| match written.comparison {
            Comparison::Less | Comparison::GreaterOrEqual => self.graph.subtract(left, right),
            Comparison::Greater | Comparison::LessOrEqual => self.graph.subtract(right, left),
        });
        let holds_below = matches!(written.comparison, Comparison::Less | Comparison::Greater);
        let holds = self.within(condition, holds_below, |resolver| {
            resolver.value(&written.holds)
        });
        let otherwise = self.within(condition, !holds_below, |resolver| {
            resolver.value(&written.otherwise)
        });
        let (condition, holds, otherwise) = (condition?, holds?, otherwise?);
        if !self.fits_like(&written.otherwise, otherwise.1, (&written.holds, holds.1)) {
            return None;
        }
        let [below, above] = if holds_below {
            [holds.0, otherwise.0]
        } else {
            [otherwise.0, holds.0]
        };
        self.joins(condition, [below, above], written.condition)?;
        let choice = self.graph.choose(condition, below, above);
        Some((choice, holds.1.joined(otherwise.1)))
    }

    /// Resolves a piece that applies only where the condition is negative, or only elsewhere.
    fn within(
        &mut self,
        condition: Option<ExprId>,
        is_below: bool,
        read: impl FnOnce(&mut Self) -> Option<Value>,
    ) -> Option<Value> {
        let depth = self.formulas.choices.len();
        self.formulas
            .choices
            .extend(condition.map(|condition| (condition, is_below)));
        let value = read(self);
        self.formulas.choices.truncate(depth);
        value
    }

    /// Compares the pieces below and above the boundary of a condition; `None` after an error.
    fn joins(&mut self, condition: ExprId, pieces: [ExprId; 2], span: Span) -> Option<()> {
        let moving: Vec<SymbolId> = self
            .graph
            .symbols(condition)
            .iter()
            .copied()
            .filter(|&symbol| self.graph.nominal(symbol).is_none())
            .collect();
        let variable = match moving[..] {
            // A condition that is constant during a motion has no boundary.
            [] => return Some(()),
            [variable] => variable,
            _ => {
                self.report_condition(
                    span,
                    "a condition must depend on one variable, not on several",
                );
                return None;
            }
        };
        let slope = self.graph.derivative(condition, variable);
        let is_linear = !self.graph.depends_on(slope, variable);
        let direction = self
            .graph
            .constant_value(slope)
            .filter(|slope| *slope != 0.0);
        let (true, Some(direction)) = (is_linear, direction) else {
            self.report_condition(
                span,
                "the place where this condition changes is not a closed form",
            );
            return None;
        };
        let zero = self.graph.zero();
        let start = self.graph.substitute(condition, &[(variable, zero)]);
        let quotient = self.graph.divide(start, slope);
        let boundary = self.graph.negate(quotient);
        let choices = self.formulas.choices.clone();
        for (outer, is_below) in choices {
            let there = self.graph.substitute(outer, &[(variable, boundary)]);
            let value = self.graph.constant_value(there);
            if value.is_some_and(|value| if is_below { value > 0.0 } else { value < 0.0 }) {
                return Some(());
            }
        }
        // Pieces in the order of an increasing variable.
        let mut pieces = if direction > 0.0 {
            pieces
        } else {
            [pieces[1], pieces[0]]
        };
        for (order, level) in LEVELS.into_iter().enumerate() {
            if order > 0 {
                pieces = pieces.map(|piece| self.graph.derivative(piece, variable));
            }
            let ends = pieces.map(|piece| self.graph.substitute(piece, &[(variable, boundary)]));
            if ends[0] == ends[1] && self.graph.is_finite(ends[0]) {
                continue;
            }
            let place = self.graph.constant_value(boundary).unwrap_or(f64::NAN);
            let place = format!("{} = {}", self.variable_name(variable), shown(place));
            let [Some(before), Some(after)] = ends.map(|end| self.graph.constant_value(end)) else {
                self.diagnostics.push(
                    Diagnostic::warning(
                        Code::PiecesApart,
                        span,
                        format!(
                            "whether the pieces join at {place} depends on more than this variable"
                        ),
                    )
                    .label("their join is not checked")
                    .help("make sure that both pieces agree there in value and two derivatives"),
                );
                return Some(());
            };
            let size = before.abs().max(after.abs());
            if (before - after).abs() <= ROUNDING * size || size <= ZERO_LIMIT {
                continue;
            }
            let message = format!(
                "the {level} jumps from {} to {} at {place}",
                shown(before),
                shown(after)
            );
            if order == 0 {
                self.diagnostics.push(
                    Diagnostic::error(Code::PiecesApart, span, message)
                        .label("the pieces do not meet where this changes")
                        .help("make both pieces equal there, or go from one to the other by a law such as `step`"),
                );
                return None;
            }
            let shock = ["", "a shock", "a jerk"][order];
            self.diagnostics.push(
                Diagnostic::warning(Code::PiecesApart, span, message)
                    .label("the pieces meet with a kink where this changes")
                    .help(format!(
                        "this is {shock} for the mechanism; a law such as `poly345` joins smoothly"
                    )),
            );
            // A jump of the rate makes the next derivative meaningless.
            return Some(());
        }
        Some(())
    }

    fn report_condition(&mut self, span: Span, message: &str) {
        self.diagnostics.push(
            Diagnostic::error(Code::WrongForm, span, message)
                .label("the point at which the pieces join is unknown")
                .help(
                    "compare the variable itself with a number, as in `if t < 2s { … } else { … }`",
                ),
        );
    }

    /// Returns the name of a variable in the description.
    fn variable_name(&self, variable: SymbolId) -> String {
        let name = self.graph.symbol_name(variable);
        let word = name.split(' ').next().unwrap_or(name);
        word.to_string()
    }
}

/// Formats a number with at most six digits.
fn shown(value: f64) -> String {
    let rounded: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    // Avoids minus zero, which looks like a mistake.
    format!("{}", rounded + 0.0)
}
