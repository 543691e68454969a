//! Parses choices between formulas: `if … { … } else { … }`.

use proc_macro2::Delimiter;

use super::{after_expression, sum};
use crate::diagnostic::{Code, Diagnostic};
use crate::syntax::MAX_DEPTH;
use crate::syntax::brackets::too_deep;
use crate::syntax::formula::{Choice, Comparison, Expression, ExpressionKind};
use crate::syntax::reader::Outcome;
use crate::syntax::tokens::Tokens;

/// Form of a choice, for help lines.
const CHOICE: &str =
    "a choice is written `if t < 2s { … } else { … }`, with `<`, `<=`, `>` or `>=`";

/// Parses `if left < right { holds } else { otherwise }`; another choice may follow `else`.
pub(super) fn choice(tokens: &mut Tokens<'_>, depth: usize) -> Outcome<Expression> {
    if depth >= MAX_DEPTH {
        return Err(Box::new(too_deep(tokens.next_span())));
    }
    let Some(start) = tokens.keyword("if") else {
        return Err(tokens.unexpected("`if`", CHOICE));
    };
    let left = sum(tokens, depth + 1)?;
    let comparison = match (tokens.mark('<'), tokens.mark('>')) {
        (None, None) => {
            let expected = "`<`, `<=`, `>` or `>=`";
            return Err(tokens.unexpected_with_code(Code::OutsideGrammar, expected, CHOICE));
        }
        (Some(_), None) if tokens.mark('=').is_some() => Comparison::LessOrEqual,
        (Some(_), None) => Comparison::Less,
        (None, Some(_)) if tokens.mark('=').is_some() => Comparison::GreaterOrEqual,
        (None, Some(_)) => Comparison::Greater,
        (Some(less), Some(greater)) => {
            let message = "`<>` is not a comparison";
            let finding = Diagnostic::error(Code::OutsideGrammar, less.to(greater), message);
            return Err(Box::new(finding.help(CHOICE)));
        }
    };
    let right = sum(tokens, depth + 1)?;
    let condition = left.span.to(right.span);
    let holds = piece(tokens, depth)?;
    if tokens.keyword("else").is_none() {
        return Err(tokens.unexpected("`else`", CHOICE));
    }
    let otherwise = if tokens.peek_word() == Some("if") {
        choice(tokens, depth + 1)?
    } else {
        piece(tokens, depth)?
    };
    let span = start.to(otherwise.span);
    Ok(Expression {
        kind: ExpressionKind::Choice(Box::new(Choice {
            left,
            comparison,
            right,
            holds,
            otherwise,
            condition,
        })),
        span,
    })
}

/// Parses a formula in braces.
fn piece(tokens: &mut Tokens<'_>, depth: usize) -> Outcome<Expression> {
    let Some((mut inner, span)) = tokens.group(Delimiter::Brace) else {
        return Err(after_expression(tokens, "an operation or `{`", CHOICE));
    };
    let mut inside = sum(&mut inner, depth + 1)?;
    if !inner.at_end() {
        return Err(after_expression(&inner, "an operation or `}`", CHOICE));
    }
    inside.span = span;
    Ok(inside)
}
