//! Parses friction in joints: `friction P = 0.1 radius 6mm;`, `friction rail = 0.1 over 40mm;`.

use super::document::Statement;
use super::expression::expression;
use super::forces::valued;
use super::formula::{Expression, Name};
use super::reader::Outcome;
use super::reference::identifier;
use super::statement::{equals, semicolon};
use super::tokens::Tokens;
use crate::diagnostic::Span;

/// `friction JOINT = COEFFICIENT [radius RADIUS] [over LENGTH];`
#[derive(Debug, Clone, PartialEq)]
pub struct Friction {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// Joint with friction.
    pub joint: Name,
    /// Coefficient of friction.
    pub coefficient: Expression,
    /// Radius of a pin; `None` if not written.
    pub radius: Option<Expression>,
    /// Length of a slide, whose ends carry its moment; `None` if not written.
    pub length: Option<Expression>,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// Forms of the statement, for help lines.
const FORMS: &str = "friction is written `friction P = 0.1 radius 6mm;` in a pin, and `friction rail = 0.1;` or `friction rail = 0.1 over 40mm;` in a slide";

/// Parses friction after its first word.
pub(super) fn friction(
    tokens: &mut Tokens<'_>,
    docs: Vec<String>,
    start: Span,
) -> Outcome<Statement> {
    let joint = identifier(tokens, "the name of a joint")?;
    equals(tokens)?;
    let coefficient = expression(tokens)?;
    let radius = valued(tokens, "radius")?;
    let length = valued(tokens, "over")?;
    if matches!(
        tokens.peek_word(),
        Some("radius" | "over" | "from" | "tolerance" | "sigma")
    ) {
        return Err(tokens.unexpected("`;`", FORMS));
    }
    let span = start.to(semicolon(tokens, start)?);
    Ok(Statement::Friction(Friction {
        docs,
        joint,
        coefficient,
        radius,
        length,
        span,
    }))
}
