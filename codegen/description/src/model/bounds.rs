//! Reports a passed bound of a graph at the statement that passed it.
//!
//! The graph counts work and size; the caller knows the current statement.

use super::expression::Value;
use super::resolve::Resolver;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::expr::{Excess, MAX_DEPTH};
use crate::syntax::Expression;

/// Maximum depth of a formula including its named constants; derivatives are somewhat deeper.
const MAX_FORMULA_DEPTH: u32 = MAX_DEPTH / 2;

/// Returns the error for a bound that was passed while processing `span`.
pub fn beyond_bounds(excess: Excess, span: Span) -> Diagnostic {
    match excess {
        Excess::Depth => Diagnostic::error(
            Code::NestedTooDeeply,
            span,
            format!("what follows from this is nested more than {MAX_DEPTH} levels deep"),
        )
        .label("derived from this")
        .help("build it from fewer formulas inside one another"),
        Excess::Size => Diagnostic::error(
            Code::TooMuchWork,
            span,
            "the formulas up to here exceed the limit of one description",
        )
        .label("the limit is exceeded here")
        .help("shorten the formulas, or describe the mechanism in parts"),
    }
}

impl Resolver<'_> {
    /// Returns the value unless the formula, including its named constants, is nested too deeply.
    pub(super) fn shallow(&mut self, value: Value, written: &Expression) -> Option<Value> {
        if self.graph.depth(value.0) <= MAX_FORMULA_DEPTH {
            return Some(value);
        }
        self.diagnostics.push(
            Diagnostic::error(
                Code::NestedTooDeeply,
                written.span,
                format!(
                    "nested more than {MAX_FORMULA_DEPTH} levels deep by the constants that it names"
                ),
            )
            .help("build it from fewer formulas inside one another"),
        );
        None
    }
}
