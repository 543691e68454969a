//! Parses limits of measures: `limit stroke from 20mm to 80mm;`, `limit stroke <= 80mm stop;`.

use super::document::Statement;
use super::expression::expression;
use super::formula::{Expression, Name};
use super::reader::Outcome;
use super::reference::identifier;
use super::statement::semicolon;
use super::tokens::Tokens;
use crate::diagnostic::Span;

/// `limit MEASURE from LOW to HIGH [stop];`, `limit MEASURE <= HIGH [stop];` or `limit MEASURE >= LOW [stop];`
#[derive(Debug, Clone, PartialEq)]
pub struct Limit {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// Limited measure.
    pub measure: Name,
    /// Smallest and largest permitted value; `None` for an end without a limit.
    pub ends: [Option<Expression>; 2],
    /// Location of the word `stop`; `None` without it.
    pub stop: Option<Span>,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// Forms of a limit, for help lines.
const FORMS: &str = "a limit is written `limit stroke from 20mm to 80mm;`, `limit stroke <= 80mm;` or `limit stroke >= 20mm;`";

/// Parses a limit after its first word.
pub(super) fn limit(tokens: &mut Tokens<'_>, docs: Vec<String>, start: Span) -> Outcome<Statement> {
    let measure = identifier(tokens, "the name of a measure")?;
    let ends = if tokens.keyword("from").is_some() {
        let low = expression(tokens)?;
        if tokens.keyword("to").is_none() {
            return Err(tokens.unexpected("`to`", FORMS));
        }
        [Some(low), Some(expression(tokens)?)]
    } else {
        let is_upper = match (tokens.mark('<'), tokens.mark('>')) {
            (Some(_), None) => true,
            (None, Some(_)) => false,
            _ => return Err(tokens.unexpected("`from`, `<=` or `>=`", FORMS)),
        };
        if tokens.mark('=').is_none() {
            return Err(tokens.unexpected("`=`", FORMS));
        }
        let end = expression(tokens)?;
        match is_upper {
            true => [None, Some(end)],
            false => [Some(end), None],
        }
    };
    let stop = tokens.keyword("stop");
    let span = start.to(semicolon(tokens, start)?);
    Ok(Statement::Limit(Limit {
        docs,
        measure,
        ends,
        stop,
        span,
    }))
}
