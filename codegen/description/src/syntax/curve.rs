//! Parses a curve fixed in a body: `curve rim(s) on cam = (X, Y);`, `curve rim(a) on cam = polar R;`.

use proc_macro2::Delimiter;

use super::document::{Curve, Shape, Statement};
use super::expression::{coordinates, expression};
use super::reader::Outcome;
use super::reference::{body_name, identifier};
use super::statement::{equals, semicolon};
use super::tokens::Tokens;
use crate::diagnostic::Span;

/// Form of the statement, for help lines.
const FORM: &str = "a curve is written `curve NAME(s) on BODY = (X, Y);` or `curve NAME(a) on BODY = polar RADIUS;`";

/// Parses the statement after its first word.
pub(super) fn curve(tokens: &mut Tokens<'_>, docs: Vec<String>, start: Span) -> Outcome<Statement> {
    let name = identifier(tokens, "the name of a curve")?;
    let Some((mut inner, _)) = tokens.group(Delimiter::Parenthesis) else {
        return Err(tokens.unexpected("`(` and the parameter of the curve", FORM));
    };
    let parameter = identifier(&mut inner, "the parameter of the curve")?;
    let range = match inner.keyword("from") {
        Some(_) => {
            let from = expression(&mut inner)?;
            if inner.keyword("to").is_none() {
                return Err(inner.unexpected("`to`", "a range is written `(s from 0 to 200mm)`"));
            }
            Some([from, expression(&mut inner)?])
        }
        None => None,
    };
    if !inner.at_end() {
        return Err(inner.unexpected("`)` or `from`", "a range is written `(s from 0 to 200mm)`"));
    }
    if tokens.keyword("on").is_none() {
        return Err(tokens.unexpected("`on` and the body that carries the curve", FORM));
    }
    let body = body_name(tokens, "the body that carries the curve")?;
    equals(tokens)?;
    let shape = match tokens.keyword("polar") {
        Some(_) => Shape::Polar(expression(tokens)?),
        None => Shape::Parametric(coordinates(tokens, 2)?.0),
    };
    let span = start.to(semicolon(tokens, start)?);
    Ok(Statement::Curve(Curve {
        docs,
        name,
        parameter,
        range,
        body,
        shape,
        span,
    }))
}
