//! Parses names, references and directions: `A`, `c1.A`, `1.P`, `N -> M`, and lists of references in parentheses.

use proc_macro2::Delimiter;

use super::formula::{Direction, Name, Reference};
use super::indexed::qualified;
use super::reader::Outcome;
use super::tokens::Tokens;
use crate::diagnostic::{Code, Diagnostic, Span};

/// Help for a missing name.
const NAME: &str = "a name is made of letters, digits and `_`, and begins with a letter";

/// Parses an identifier; `wanted` names it in messages.
pub(super) fn identifier(tokens: &mut Tokens<'_>, wanted: &str) -> Outcome<Name> {
    let mut ahead = *tokens;
    if let Some(number) = ahead.number() {
        let message = format!("expected {wanted}, found `{}`", number.text);
        let finding = Diagnostic::error(Code::NameNotAllowed, number.span, message)
            .label("a name starts with a letter or `_`")
            .help("put a letter before it; only bodies and joints may be named by an integer");
        return Err(Box::new(finding));
    }
    let Some(name) = tokens.word() else {
        return Err(tokens.unexpected(wanted, NAME));
    };
    qualified(tokens, check_word(name)?)
}

/// Parses an identifier or an integer.
pub(super) fn body_name(tokens: &mut Tokens<'_>, wanted: &str) -> Outcome<Name> {
    if let Some(name) = tokens.word() {
        return qualified(tokens, check_word(name)?);
    }
    let Some(name) = tokens.number() else {
        return Err(tokens.unexpected(wanted, NAME));
    };
    integer(name)
}

/// Rejects names that consist of `_` only.
pub(super) fn check_word(name: Name) -> Outcome<Name> {
    if name.text.bytes().all(|byte| byte == b'_') {
        let finding = Diagnostic::error(
            Code::NameNotAllowed,
            name.span,
            format!("`{}` is not a name", name.text),
        )
        .label("a name has a letter or a digit")
        .help("choose a name with a letter");
        return Err(Box::new(finding));
    }
    Ok(name)
}

/// Parses the integer that names a body. Only plain digits are allowed, so that a body has one name.
fn integer(name: Name) -> Outcome<Name> {
    let plain = name.text.bytes().all(|byte| byte.is_ascii_digit());
    if plain && (name.text == "0" || !name.text.starts_with('0')) {
        return Ok(name);
    }
    let finding = Diagnostic::error(
        Code::NameNotAllowed,
        name.span,
        format!("`{}` does not name a body", name.text),
    )
    .label("a body is named by an identifier or a plain integer");
    let digits = name.text.trim_start_matches('0');
    let help = if plain && !digits.is_empty() {
        format!("write `{digits}`")
    } else {
        "write an integer such as `1`, or a name that begins with a letter".to_string()
    };
    Err(Box::new(finding.help(help)))
}

/// Parses `NAME` or `BODY.NAME`; `wanted` names it in messages.
pub(super) fn reference(tokens: &mut Tokens<'_>, wanted: &str) -> Outcome<Reference> {
    let reference = one_or_two_names(tokens, wanted)?;
    if reference.body.is_some() && tokens.peek_mark('.') {
        return Err(tokens.unexpected("no second `.`", "a point is written `body.point`"));
    }
    Ok(reference)
}

/// Parses `NAME`, `BODY.NAME`, or `BODY.NAME.COMPONENT` with its component.
pub(super) fn reference_or_component(
    tokens: &mut Tokens<'_>,
    wanted: &str,
) -> Outcome<(Reference, Option<Name>)> {
    let reference = one_or_two_names(tokens, wanted)?;
    if reference.body.is_none() || tokens.mark('.').is_none() {
        return Ok((reference, None));
    }
    let axis = identifier(tokens, "`x` or `y`")?;
    if tokens.peek_mark('.') {
        let help = "a component of a point is written `point.x` or `body.point.x`";
        return Err(tokens.unexpected("no third `.`", help));
    }
    Ok((reference, Some(axis)))
}

fn one_or_two_names(tokens: &mut Tokens<'_>, wanted: &str) -> Outcome<Reference> {
    let mut ahead = *tokens;
    if let Some(number) = ahead.number()
        && let Some(text) = number.text.strip_suffix('.')
        && ahead.peek_word().is_some()
    {
        // `1. P` with a blank is the number `1.` and a word.
        *tokens = ahead;
        let span = Span {
            start: number.span.start,
            end: number.span.end - 1,
        };
        let body = integer(Name {
            text: text.to_string(),
            span,
        })?;
        return member_of(tokens, body);
    }
    let name = body_name(tokens, wanted)?;
    if tokens.mark('.').is_some() {
        return member_of(tokens, name);
    }
    let span = name.span;
    Ok(Reference {
        body: None,
        name,
        span,
    })
}

fn member_of(tokens: &mut Tokens<'_>, body: Name) -> Outcome<Reference> {
    let name = identifier(tokens, "the name of a point")?;
    let name = point_of(tokens, &body, name);
    let span = body.span.to(name.span);
    Ok(Reference {
        body: Some(body),
        name,
        span,
    })
}

/// Returns the resolved name of a point on a body; points of a part have its prefix, too.
fn point_of(tokens: &Tokens<'_>, body: &Name, point: Name) -> Name {
    let called = tokens
        .reader
        .known(|scope| scope.point_of_part(&body.text, &point.text));
    Name {
        text: called.unwrap_or(point.text),
        span: point.span,
    }
}

/// Parses `K.x`, `c1.K.x` or `1.x` into the operand and its coordinate; `None` without consuming tokens if neither follows.
pub(super) fn driven_coordinate(tokens: &mut Tokens<'_>) -> Outcome<Option<(Reference, Name)>> {
    let mut ahead = *tokens;
    let named = ahead.word().is_some() || ahead.number().is_some();
    ahead.skip_indices();
    if !named || !ahead.peek_mark('.') {
        return Ok(None);
    }
    let start = *tokens;
    let mut parts = vec![body_name(tokens, "a point or a body")?];
    while parts.len() < 3 && tokens.mark('.').is_some() {
        parts.push(identifier(tokens, "a coordinate")?);
    }
    if tokens.peek_mark('.') {
        return Err(tokens.unexpected(
            "no further `.`",
            "the coordinate of a point is written `point.x` or `body.point.x`",
        ));
    }
    let coordinate = parts.pop();
    let name = parts.pop();
    let (Some(coordinate), Some(name)) = (coordinate, name) else {
        // The dots belong to a part: `leg.knee` is one name.
        *tokens = start;
        return Ok(None);
    };
    let body = parts.pop();
    let name = match &body {
        Some(body) => point_of(tokens, body, name),
        None => name,
    };
    let span = body
        .as_ref()
        .map_or(name.span, |body| body.span.to(name.span));
    Ok(Some((Reference { body, name, span }, coordinate)))
}

/// Parses `A -> B`.
pub(super) fn direction(tokens: &mut Tokens<'_>) -> Outcome<Direction> {
    let from = reference(tokens, "a point")?;
    if tokens.arrow().is_none() {
        return Err(tokens.unexpected("`->`", "a direction is written `A -> B`"));
    }
    let to = reference(tokens, "a point")?;
    let span = from.span.to(to.span);
    Ok(Direction { from, to, span })
}

/// Parses `(A, 1.P, …)`.
pub(super) fn operands(tokens: &mut Tokens<'_>) -> Outcome<Vec<Reference>> {
    let Some((mut inner, _)) = tokens.group(Delimiter::Parenthesis) else {
        return Err(tokens.unexpected("`(`", "write the joined bodies in parentheses: `(1, 2)`"));
    };
    let mut operands = Vec::new();
    while !inner.at_end() {
        operands.push(reference(&mut inner, "a body or a point")?);
        if inner.mark(',').is_none() && !inner.at_end() {
            return Err(separator(
                &inner,
                "`,` or `)`",
                "name bodies or points, `(1, 2)` or `(1.P, 2.Q)`",
            ));
        }
    }
    Ok(operands)
}

/// Returns the finding for a missing comma between items, or for a token that does not continue the list.
pub(super) fn separator(tokens: &Tokens<'_>, wanted: &str, help: &str) -> Box<Diagnostic> {
    if tokens.peek_word().is_none() && !tokens.peek_number() {
        return tokens.unexpected(wanted, help);
    }
    let place = Span {
        start: tokens.previous().end,
        end: tokens.previous().end,
    };
    let message = format!("expected {wanted}, found {}", tokens.found());
    let finding = Diagnostic::error(Code::UnexpectedToken, place, message).label("missing `,`");
    Box::new(finding.help("separate them with `,`"))
}
