//! A bound that a graph has passed → the error at the statement that passed it.
//!
//! Work and size are counted by the graph; which statement they belong to is known to whoever carries the statements out.

use super::expression::Value;
use super::resolve::Resolver;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::expr::{DEEPEST, Excess};
use crate::syntax::Expression;

/// The deepest formula with the constants that it names: its derivatives are somewhat deeper.
const DEEPEST_FORMULA: u32 = DEEPEST / 2;

/// The error for a bound that was passed while `span` was worked on.
pub fn beyond_bounds(excess: Excess, span: Span) -> Diagnostic {
    match excess {
        Excess::Depth => Diagnostic::error(
            Code::NestedTooDeeply,
            span,
            format!("what follows from this is nested more than {DEEPEST} levels deep"),
        )
        .label("derived from this")
        .help("build it from fewer formulas inside one another"),
        Excess::Size => Diagnostic::error(
            Code::TooMuchWork,
            span,
            "the formulas up to here are longer than one description may cause",
        )
        .label("the bound is passed here")
        .help("shorten the formulas, or describe the mechanism in parts"),
    }
}

impl Resolver<'_> {
    /// Passes a value on unless it is nested too deeply, by itself and by the constants that it names.
    pub(super) fn shallow(&mut self, value: Value, written: &Expression) -> Option<Value> {
        if self.graph.depth(value.0) <= DEEPEST_FORMULA {
            return Some(value);
        }
        self.diagnostics.push(
            Diagnostic::error(
                Code::NestedTooDeeply,
                written.span,
                format!(
                    "nested more than {DEEPEST_FORMULA} levels deep by the constants that it names"
                ),
            )
            .help("build it from fewer formulas inside one another"),
        );
        None
    }
}
