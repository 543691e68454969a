//! Parses a table with listed points or a file: `table lift = [(0deg, 0mm), (90deg, 12mm), (360deg, 0mm)] periodic;`, `table
//! lift = "lift.csv" in (deg, mm) periodic;`.

use proc_macro2::Delimiter;

use super::document::{Ends, Statement, Table, TablePoints};
use super::expression::{after_expression, coordinates, expression};
use super::formula::Name;
use super::reader::Outcome;
use super::reference::{identifier, separator};
use super::statement::{equals, semicolon_after_operands};
use super::tokens::Tokens;
use crate::diagnostic::Span;

/// Form of the statement, for help lines.
const FORM: &str = "a table is written `table NAME = [(X, Y), (X, Y), …];` or `table NAME = \"FILE\" in (UNIT, UNIT);`";

/// Form of the units of a file, for help lines.
const UNITS: &str =
    "the units of both columns are written `in (deg, mm)`, with `1` for a plain number";

/// Form of the column selection, for help lines.
const COLUMNS: &str = "the columns of a file are chosen by their names or their numbers: `columns (angle, lift)`, `columns (1, 3)`";

/// Forms of the ends of a table, for help lines.
const ENDS: &str = "a table ends in `;`, `natural;`, `clamped(SLOPE, SLOPE);` or `periodic;`";

/// Parses the statement after its first word.
pub(super) fn table(tokens: &mut Tokens<'_>, docs: Vec<String>, start: Span) -> Outcome<Statement> {
    let name = identifier(tokens, "the name of a table")?;
    equals(tokens)?;
    let (points, place) = match tokens.text() {
        Some(path) => {
            let place = path.span;
            let columns = match tokens.keyword("columns") {
                Some(_) => Some(pair(tokens, "`(COLUMN, COLUMN)`", "a column", COLUMNS)?),
                None => None,
            };
            let units = match tokens.keyword("in") {
                Some(_) => Some(pair(tokens, "`(UNIT, UNIT)`", "a unit", UNITS)?),
                None => None,
            };
            let points = TablePoints::InFile {
                path,
                columns,
                units,
            };
            (points, place)
        }
        None => listed(tokens)?,
    };
    let ends = match tokens.peek_word() {
        Some(_) if !tokens.at_statement() => Some(ends(tokens)?),
        _ => None,
    };
    let span = start.to(semicolon_after_operands(tokens, start)?);
    Ok(Statement::Table(Table {
        docs,
        name,
        points,
        place,
        ends,
        span,
    }))
}

/// Parses `[(X, Y), (X, Y)]`.
fn listed(tokens: &mut Tokens<'_>) -> Outcome<(TablePoints, Span)> {
    let Some((mut inner, place)) = tokens.group(Delimiter::Bracket) else {
        return Err(tokens.unexpected("`[` or the name of a file in quotes", FORM));
    };
    let mut points = Vec::new();
    while !inner.at_end() {
        points.push(coordinates(&mut inner, 2)?.0);
        if inner.mark(',').is_none() && !inner.at_end() {
            let help = "the points of a table are separated with `,`";
            return Err(separator(&inner, "`,` or `]`", help));
        }
    }
    Ok((TablePoints::Listed(points), place))
}

/// Parses a pair of names or numbers: `(deg, mm)` after `in`, with `1` for a plain number; `(angle, lift)` after `columns`,
/// with `2` for the second column.
fn pair(
    tokens: &mut Tokens<'_>,
    wanted: &str,
    noun: &str,
    help: &'static str,
) -> Outcome<[Name; 2]> {
    let Some((mut inner, _)) = tokens.group(Delimiter::Parenthesis) else {
        return Err(tokens.unexpected(wanted, help));
    };
    let mut one = |ends: bool| {
        let name = inner.word().or_else(|| inner.number());
        let name = name.ok_or_else(|| inner.unexpected(noun, help))?;
        let closed = if ends {
            inner.at_end()
        } else {
            inner.mark(',').is_some()
        };
        if !closed {
            let expected = if ends { "`)`" } else { "`,`" };
            return Err(inner.unexpected(expected, help));
        }
        Ok(name)
    };
    Ok([one(false)?, one(true)?])
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
