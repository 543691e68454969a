//! Parses requests for results: `output K;`, `output velocity K, phi(c1);`, `transmission K;`, `sensitivity L;`, `monitor;`,
//! `unguarded;`.

use proc_macro2::Delimiter;

use super::document::{
    Directive, DirectiveKind, Output, OutputItem, Sensitivity, Statement, Transmission,
};
use super::reader::Outcome;
use super::reference::{identifier, operands, reference};
use super::statement::{listed, semicolon, semicolon_after_operands};
use super::tokens::Tokens;
use crate::diagnostic::Span;

/// Words for the highest level, in order of the derivatives.
pub const LEVELS: [&str; 3] = ["position", "velocity", "acceleration"];

/// Parses an `output` statement after its first word.
pub(super) fn output(
    tokens: &mut Tokens<'_>,
    docs: Vec<String>,
    start: Span,
) -> Outcome<Statement> {
    let level = match tokens.peek_word() {
        Some(word) if LEVELS.contains(&word) => {
            // A point may have the name of a level; no item follows it then.
            let mut ahead = *tokens;
            let level = ahead.word();
            let item_follows = ahead.peek_word().is_some() || ahead.peek_number();
            if item_follows {
                *tokens = ahead;
            }
            level.filter(|_| item_follows)
        }
        _ => None,
    };
    let items = listed(tokens, item)?;
    let span = start.to(semicolon_after_operands(tokens, start)?);
    Ok(Statement::Output(Output {
        docs,
        level,
        items,
        span,
    }))
}

/// Parses a `transmission` statement after its first word.
pub(super) fn transmission(
    tokens: &mut Tokens<'_>,
    docs: Vec<String>,
    start: Span,
) -> Outcome<Statement> {
    let items = listed(tokens, item)?;
    let span = start.to(semicolon_after_operands(tokens, start)?);
    Ok(Statement::Transmission(Transmission { docs, items, span }))
}

/// Parses a `sensitivity` statement after its first word.
pub(super) fn sensitivity(
    tokens: &mut Tokens<'_>,
    docs: Vec<String>,
    start: Span,
) -> Outcome<Statement> {
    let names = listed(tokens, |it| identifier(it, "the name of a parameter"))?;
    let span = start.to(semicolon_after_operands(tokens, start)?);
    Ok(Statement::Sensitivity(Sensitivity { docs, names, span }))
}

/// Parses a statement of one word, after that word.
pub(super) fn directive(
    tokens: &mut Tokens<'_>,
    docs: Vec<String>,
    kind: DirectiveKind,
    start: Span,
) -> Outcome<Statement> {
    let span = start.to(semicolon(tokens, start)?);
    Ok(Statement::Directive(Directive { kind, docs, span }))
}

/// Parses a point, or a coordinate of a body.
fn item(tokens: &mut Tokens<'_>) -> Outcome<OutputItem> {
    let mut ahead = *tokens;
    if ahead.word().is_some() && ahead.peek_group(Delimiter::Parenthesis) {
        let axis = identifier(tokens, "`x`, `y` or `phi`")?;
        let bodies = operands(tokens)?;
        let span = axis.span.to(tokens.previous());
        return Ok(OutputItem::Coordinate { axis, bodies, span });
    }
    Ok(OutputItem::Point(reference(
        tokens,
        "a point, or a coordinate such as `phi(1)`",
    )?))
}
