//! *Tokens → a table:* `table lift = [(0deg, 0mm), (90deg, 12mm), (360deg, 0mm)] periodic;`.

use proc_macro2::Delimiter;

use super::document::{Ends, Statement, Table};
use super::expression::{after_expression, coordinates, expression};
use super::reference::{identifier, separator};
use super::statement::{equals, semicolon_after_operands};
use super::tokens::{Outcome, Tokens};
use crate::diagnostic::Span;

/// How a table is written, for help lines.
const FORM: &str = "a table is written `table NAME = [(X, Y), (X, Y), …];`";

/// How a table may end, for help lines.
const ENDS: &str = "a table ends in `;`, `natural;`, `clamped(SLOPE, SLOPE);` or `periodic;`";

/// The statement after its first word.
pub(super) fn table(tokens: &mut Tokens<'_>, docs: Vec<String>, start: Span) -> Outcome<Statement> {
    let name = identifier(tokens, "the name of a table")?;
    equals(tokens)?;
    let Some((mut inner, list)) = tokens.group(Delimiter::Bracket) else {
        return Err(tokens.unexpected("`[`", FORM));
    };
    let mut points = Vec::new();
    while !inner.at_end() {
        points.push(coordinates(&mut inner, 2)?.0);
        if inner.mark(',').is_none() && !inner.at_end() {
            let help = "the points of a table are separated with `,`";
            return Err(separator(&inner, "`,` or `]`", help));
        }
    }
    let ends = match tokens.peek_word() {
        Some(_) if !tokens.at_statement() => Some(ends(tokens)?),
        _ => None,
    };
    let span = start.to(semicolon_after_operands(tokens, start)?);
    Ok(Statement::Table(Table {
        docs,
        name,
        points,
        list,
        ends,
        span,
    }))
}

fn ends(tokens: &mut Tokens<'_>) -> Outcome<Ends> {
    let Some(word) = tokens.word() else {
        return Err(tokens.unexpected("how the table ends", ENDS));
    };
    let mut span = word.span;
    let mut slopes = Vec::new();
    if let Some((mut inner, brackets)) = tokens.group(Delimiter::Parenthesis) {
        span = span.to(brackets);
        while !inner.at_end() {
            slopes.push(expression(&mut inner)?);
            if inner.mark(',').is_none() && !inner.at_end() {
                return Err(after_expression(&inner, "an operation, `,` or `)`", ENDS));
            }
        }
    }
    Ok(Ends { word, slopes, span })
}
