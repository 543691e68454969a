//! Evaluates laws of motion as expressions of their argument.
//!
//! A law consists of choices, polynomials and sines of any argument x, mostly t. Its derivatives of every order follow by
//! differentiation. The arguments are in the order of ADAMS.

mod rise;
mod sequence;
mod series;

use super::dimension::Dimension;
use super::expression::Value;
use super::resolve::Resolver;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::expr::ExprId;
use crate::syntax::{Expression, Name};
use rise::Rise;

/// Laws of motion, for help lines; the rises, which a sequence may use, come first.
pub const LAWS: &[&str] = &[
    "step",
    "havsin",
    "step5",
    "cycloidal",
    "poly345",
    "poly4567",
    "modified_trapezoid",
    "modified_sine",
    "simple_harmonic",
    "sequence",
    "polynomial",
    "harmonic",
];

/// Words of the error that a value does not exceed an earlier one.
struct Increase<'a> {
    problem: &'a str,
    label: &'a str,
    /// Label of the earlier value.
    earlier: &'a str,
    help: &'a str,
}

impl Resolver<'_> {
    /// Evaluates a law; its name must be one of [`LAWS`].
    pub(super) fn law(
        &mut self,
        law: &Name,
        arguments: &[Expression],
        span: Span,
    ) -> Option<Value> {
        match (law.text.as_str(), Rise::named(&law.text)) {
            (_, Some(rise)) => self.single_rise(rise, law, arguments, span),
            ("sequence", _) => self.sequence(arguments, span),
            ("polynomial", _) => self.polynomial(arguments, span),
            _ => self.harmonic(arguments, span),
        }
    }

    /// Reports a call with too few or too many arguments; `form` is the form of the law.
    fn wrong_count(&mut self, law: &str, wanted: &str, given: usize, form: &str, span: Span) {
        self.diagnostics.push(
            Diagnostic::error(
                Code::WrongArgumentCount,
                span,
                format!("`{law}` takes {wanted}, not {given}"),
            )
            .label(format!("{given} given"))
            .help(format!("write `{form}`")),
        );
    }

    /// Resolves all arguments, even after an error.
    fn all_values(&mut self, arguments: &[Expression]) -> Option<Vec<Value>> {
        let values: Vec<Option<Value>> = arguments
            .iter()
            .map(|argument| self.value(argument))
            .collect();
        values.into_iter().collect()
    }

    /// True if a value has the dimension of `like`; otherwise reports an error.
    pub(super) fn fits_like(
        &mut self,
        written: &Expression,
        found: Dimension,
        like: (&Expression, Dimension),
    ) -> bool {
        if found.fits(like.1) {
            return true;
        }
        let finding = Diagnostic::error(
            Code::WrongDimension,
            written.span,
            format!("expected {}, found {}", like.1.name(), found.name()),
        )
        .label(format!("this is {}", found.name()))
        .also(like.0.span, format!("this is {}", like.1.name()))
        .help("give both the same kind of unit, or write bare numbers for SI units");
        let finding = self.with_declarations(finding, &[like.0, written]);
        self.diagnostics.push(finding);
        false
    }

    /// True if `later` is greater than `earlier`, or if one of them is unknown; otherwise reports an error in these words.
    fn increases(
        &mut self,
        earlier: (&Expression, ExprId),
        later: (&Expression, ExprId),
        words: &Increase<'_>,
    ) -> bool {
        let gap = self.graph.subtract(later.1, earlier.1);
        let known = self.graph.constant_value(gap);
        let is_increase = known.is_none_or(|gap| gap > 0.0);
        if !is_increase {
            let span = later.0.span;
            self.diagnostics.push(
                Diagnostic::error(Code::NotIncreasing, span, words.problem)
                    .label(words.label)
                    .also(earlier.0.span, words.earlier)
                    .help(words.help),
            );
        }
        is_increase
    }
}
