//! Parses requests: `output velocity K, phi(c1);`, `transmission K;`, `sensitivity L;`, `reaction P;`, `monitor;`.

use proc_macro2::Delimiter;

use super::document::{Operands, OutputItem, Request, RequestKind, Statement};
use super::formula::Name;
use super::reader::Outcome;
use super::reference::{body_name, identifier, operands, reference};
use super::statement::{listed, semicolon, semicolon_after_operands};
use super::tokens::Tokens;
use crate::diagnostic::Span;

/// Words for the highest level, in order of the derivatives.
pub const LEVELS: [&str; 3] = ["position", "velocity", "acceleration"];

/// Parses a request after its first word.
pub(super) fn request(
    tokens: &mut Tokens<'_>,
    docs: Vec<String>,
    (word, kind, operands): (&'static str, RequestKind, Operands),
    start: Span,
) -> Outcome<Statement> {
    let level = match kind {
        RequestKind::Output => level(tokens),
        _ => None,
    };
    let (mut items, mut names) = (Vec::new(), Vec::new());
    match operands {
        Operands::None => {}
        Operands::Quantities => items = listed(tokens, item)?,
        Operands::Parameters => {
            names = listed(tokens, |it| identifier(it, "the name of a parameter"))?;
        }
        Operands::Joints => names = listed(tokens, |it| body_name(it, "the name of a joint"))?,
    }
    let end = match operands {
        Operands::None => semicolon(tokens, start)?,
        _ => semicolon_after_operands(tokens, start)?,
    };
    Ok(Statement::Request(Request {
        kind,
        word,
        operands,
        docs,
        level,
        items,
        names,
        span: start.to(end),
    }))
}

/// Parses the level of an `output` statement; `None` if it names none.
fn level(tokens: &mut Tokens<'_>) -> Option<Name> {
    match tokens.peek_word() {
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
    }
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
