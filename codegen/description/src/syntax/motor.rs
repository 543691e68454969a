//! Parses motors of drivers: `motor crank gear 50 inertia 2e-5kg*m^2 efficiency 0.8;`.

use super::document::Statement;
use super::forces::valued;
use super::formula::{Expression, Name};
use super::reader::Outcome;
use super::reference::identifier;
use super::statement::semicolon;
use super::tokens::Tokens;
use crate::diagnostic::Span;

/// `motor DRIVER [gear RATIO] [inertia MOMENT] [efficiency NUMBER];`
#[derive(Debug, Clone, PartialEq)]
pub struct Motor {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// Driver that the motor turns.
    pub driver: Name,
    /// Rotation of the shaft per unit of the driven quantity; `None` if not written.
    pub gear: Option<Expression>,
    /// Moment of inertia at the shaft; `None` if not written.
    pub inertia: Option<Expression>,
    /// Efficiency of the gear; `None` if not written.
    pub efficiency: Option<Expression>,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// Order of the clauses, for help lines.
const FORM: &str = "a motor has its gear, then its inertia, then its efficiency: `motor crank gear 50 inertia 2e-5kg*m^2 efficiency 0.8;`";

/// Parses a motor after its first word.
pub(super) fn motor(tokens: &mut Tokens<'_>, docs: Vec<String>, start: Span) -> Outcome<Statement> {
    let driver = identifier(tokens, "the name of a driver")?;
    let gear = valued(tokens, "gear")?;
    let inertia = valued(tokens, "inertia")?;
    let efficiency = valued(tokens, "efficiency")?;
    if matches!(tokens.peek_word(), Some("gear" | "inertia" | "efficiency"))
        || tokens.peek_mark('=')
    {
        return Err(tokens.unexpected("`;`", FORM));
    }
    let span = start.to(semicolon(tokens, start)?);
    Ok(Statement::Motor(Motor {
        docs,
        driver,
        gear,
        inertia,
        efficiency,
        span,
    }))
}
