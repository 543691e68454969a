//! Reads `units mm, deg;`.

use super::document::{Statement, Units};
use super::formula::Name;
use super::reader::Outcome;
use super::statement::{listed, semicolon_after_operands};
use super::tokens::Tokens;
use crate::diagnostic::Span;

/// Form of the statement, for help lines.
const FORM: &str = "units of output are written `units mm, deg;`";

/// Marks inside a unit: `N*mm`, `m/s^2`, `kg*m^-1`.
const MARKS: [char; 4] = ['*', '/', '^', '-'];

/// Parses the statement after its first word.
pub(super) fn units(tokens: &mut Tokens<'_>, docs: Vec<String>, start: Span) -> Outcome<Statement> {
    let units = listed(tokens, unit)?;
    let span = start.to(semicolon_after_operands(tokens, start)?);
    Ok(Statement::Units(Units { docs, units, span }))
}

/// Parses words and numbers with marks between them.
fn unit(tokens: &mut Tokens<'_>) -> Outcome<Name> {
    let first = tokens
        .word()
        .ok_or_else(|| tokens.unexpected("a unit", FORM))?;
    let mut span = first.span;
    while MARKS.iter().any(|mark| tokens.mark(*mark).is_some()) {
        let next = tokens.word().or_else(|| tokens.number());
        span = span.to(match next {
            Some(next) => next.span,
            // A minus may follow `^`.
            None if MARKS.iter().any(|mark| tokens.peek_mark(*mark)) => continue,
            None => return Err(tokens.unexpected("a unit", FORM)),
        });
    }
    let written = tokens.reader.written(span);
    Ok(Name {
        text: written.split_whitespace().collect(),
        span,
    })
}
