//! Parses an equation of the user: `equation rope: A.x^2 + (K.y - 1)^2 = L^2;`.

use super::document::{Equation, Statement};
use super::expression::expression;
use super::formula::Name;
use super::reader::Outcome;
use super::reference::identifier;
use super::statement::{equals, semicolon};
use super::tokens::Tokens;
use crate::diagnostic::Span;

/// Parses the statement after its first word.
pub(super) fn equation(
    tokens: &mut Tokens<'_>,
    docs: Vec<String>,
    redundant: Option<Span>,
    start: Span,
) -> Outcome<Statement> {
    let name = name(tokens)?;
    let left = expression(tokens)?;
    equals(tokens)?;
    let right = expression(tokens)?;
    let span = start.to(semicolon(tokens, start)?);
    Ok(Statement::Equation(Equation {
        docs,
        redundant,
        name,
        left,
        right,
        span,
    }))
}

/// Parses `NAME:`; `None` if no name is written.
fn name(tokens: &mut Tokens<'_>) -> Outcome<Option<Name>> {
    let mut ahead = *tokens;
    let is_named = ahead.word().is_some() || ahead.number().is_some();
    ahead.skip_indices();
    if !is_named || !ahead.peek_mark(':') {
        return Ok(None);
    }
    let name = identifier(tokens, "the name of the equation")?;
    tokens.mark(':');
    Ok(Some(name))
}
