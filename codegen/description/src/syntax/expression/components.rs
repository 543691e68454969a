//! Parses coordinates of arguments and positions: values in parentheses, separated by commas.

use proc_macro2::Delimiter;

use super::{after_expression, expression, sum};
use crate::diagnostic::{Code, Diagnostic};
use crate::syntax::formula::{Expression, ExpressionKind, Pair};
use crate::syntax::reader::Outcome;
use crate::syntax::tokens::Tokens;

/// Parses an argument of a call: a formula, or two or three of them in parentheses.
pub(super) fn argument(tokens: &mut Tokens<'_>, depth: usize) -> Outcome<Expression> {
    let mut ahead = *tokens;
    let Some((mut inner, span)) = ahead.group(Delimiter::Parenthesis) else {
        return sum(tokens, depth);
    };
    let mut within = inner;
    while !within.at_end() && !within.peek_mark(',') {
        within.skip();
    }
    if within.at_end() {
        return sum(tokens, depth);
    }
    let mut components = vec![sum(&mut inner, depth + 1)?];
    while inner.mark(',').is_some() && !(inner.at_end() && components.len() > 1) {
        components.push(sum(&mut inner, depth + 1)?);
    }
    if !inner.at_end() {
        let help = "components are written `(x, y)` or `(x, y, z)`";
        return Err(after_expression(&inner, "an operation, `,` or `)`", help));
    }
    if components.len() > 3 {
        let message = format!(
            "expected `(X, Y)` or `(X, Y, Z)`, found {} values",
            components.len()
        );
        let finding = Diagnostic::error(Code::WrongForm, span, message);
        return Err(Box::new(
            finding.help("a position has two or three components"),
        ));
    }
    *tokens = ahead;
    Ok(Expression {
        kind: ExpressionKind::Components(components),
        span,
    })
}

/// Parses `(X, Y)` with two to `most` components; returns those after the second beside the pair.
pub(in crate::syntax) fn coordinates(
    tokens: &mut Tokens<'_>,
    most: usize,
) -> Outcome<(Pair, Option<Expression>)> {
    let expected = if most == 2 {
        "`(X, Y)`"
    } else {
        "`(X, Y)` or `(X, Y, ANGLE)`"
    };
    let Some((mut inner, span)) = tokens.group(Delimiter::Parenthesis) else {
        return Err(tokens.unexpected(expected, &format!("write {expected} in parentheses")));
    };
    let mut components = Vec::new();
    while !inner.at_end() {
        components.push(expression(&mut inner)?);
        if inner.mark(',').is_none() && !inner.at_end() {
            return Err(after_expression(
                &inner,
                "an operation, `,` or `)`",
                "values are separated with `,`",
            ));
        }
    }
    let count = components.len();
    let mut components = components.into_iter();
    match (components.next(), components.next()) {
        (Some(x), Some(y)) if count <= most => Ok((Pair { x, y, span }, components.next())),
        _ => {
            let message = format!(
                "expected {expected}, found {count} {}",
                if count == 1 { "value" } else { "values" }
            );
            let finding = Diagnostic::error(Code::WrongForm, span, message);
            Err(Box::new(finding.help(format!("write {expected}"))))
        }
    }
}
