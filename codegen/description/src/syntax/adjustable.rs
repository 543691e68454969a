//! Parses parameters and inputs: `NAME = EXPRESSION from LOW to HIGH tolerance EXTENT;`.

use super::document::{Adjustable, StatedTolerance};
use super::expression::{after_expression, expression};
use super::reader::Outcome;
use super::reference::identifier;
use super::statement::{completed, equals};
use super::tokens::Tokens;
use crate::diagnostic::{Code, Diagnostic, Span};

/// Parses `NAME = EXPRESSION from LOW to HIGH tolerance EXTENT;` after the first word of a parameter or an input; range and
/// tolerance are optional.
pub(super) fn adjustable(
    tokens: &mut Tokens<'_>,
    docs: Vec<String>,
    start: Span,
    is_parameter: bool,
) -> Outcome<Adjustable> {
    let what = match is_parameter {
        true => "a parameter",
        false => "an input",
    };
    let name = identifier(tokens, &format!("the name of {what}"))?;
    equals(tokens)?;
    let value = expression(tokens)?;
    let range = match tokens.keyword("from") {
        Some(_) => {
            let low = expression(tokens)?;
            if tokens.keyword("to").is_none() {
                return Err(after_expression(
                    tokens,
                    "an operation or `to`",
                    "a range has two ends: `from 80mm to 160mm`",
                ));
            }
            Some([low, expression(tokens)?])
        }
        None => None,
    };
    if !is_parameter && at_tolerance(tokens) {
        return Err(no_tolerance(tokens, what));
    }
    let tolerance = tolerance(tokens)?;
    let constant = completed(tokens, docs, start, name, value)?;
    Ok(Adjustable {
        constant,
        range,
        tolerance,
    })
}

/// True at a word that begins a tolerance.
pub(super) fn at_tolerance(tokens: &Tokens<'_>) -> bool {
    matches!(tokens.peek_word(), Some("tolerance" | "sigma"))
}

/// Returns the error of a tolerance of something else than a parameter.
pub(super) fn no_tolerance(tokens: &Tokens<'_>, what: &str) -> Box<Diagnostic> {
    let message = format!("{what} has no tolerance");
    let finding = Diagnostic::error(Code::UnexpectedToken, tokens.next_span(), message)
        .label("expected `;`")
        .help("write a tolerance behind the value of a `param`");
    Box::new(finding)
}

/// Parses `tolerance EXTENT` or `sigma EXTENT`; `None` if neither is written.
fn tolerance(tokens: &mut Tokens<'_>) -> Outcome<Option<StatedTolerance>> {
    let is_normal = match (tokens.keyword("tolerance"), tokens.keyword("sigma")) {
        (None, None) => return Ok(None),
        (_, sigma) => sigma.is_some(),
    };
    let extent = expression(tokens)?;
    let help = match tokens.peek_word() {
        Some("from") => "write the range in front: `from 80mm to 160mm tolerance 0.1mm`",
        _ if at_tolerance(tokens) => "write one of them: `tolerance 0.1mm` or `sigma 0.03mm`",
        _ => return Ok(Some(StatedTolerance { is_normal, extent })),
    };
    Err(tokens.unexpected("`;`", help))
}
