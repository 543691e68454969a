//! Parses a body statement: `body NAME at PLACE [ANGLE] { members }`, or `;` instead of the braces.

use proc_macro2::Delimiter;

use super::document::{Body, Member, Orientation, Origin};
use super::expression::{after_expression, coordinates, expression};
use super::reader::Outcome;
use super::reference::{body_name, direction, identifier, reference, separator};
use super::tokens::Tokens;
use crate::diagnostic::{Code, Diagnostic, Span};

/// Parses a body from the word `body` to its braces or semicolon.
pub(super) fn body(tokens: &mut Tokens<'_>, docs: Vec<String>, start: Span) -> Outcome<Body> {
    let name = body_name(tokens, "the name of a body")?;
    if tokens.keyword("at").is_none() {
        let help = format!("write `body {} at (X, Y) {{ … }}`", name.text);
        return Err(tokens.unexpected("`at`", &help));
    }
    let (origin, angle) = if tokens.peek_group(Delimiter::Parenthesis) {
        let (pair, angle) = coordinates(tokens, 3)?;
        (Origin::Coordinates(pair), angle)
    } else {
        (
            Origin::Point(reference(tokens, "`(X, Y)` or a point")?),
            None,
        )
    };
    let mut written = angle.map(|angle| (angle.span, Orientation::Angle(angle)));
    loop {
        let before = tokens.next_span();
        let Some(another) = orientation(tokens)? else {
            break;
        };
        let span = before.to(tokens.previous());
        if let Some((first, _)) = written {
            let message = "the angle of a body is given twice";
            let finding = Diagnostic::error(Code::WrongForm, span, message)
                .also(first, "first given here")
                .help("keep one of them: `(X, Y, ANGLE)`, `turned ANGLE` or `facing A -> B`");
            return Err(Box::new(finding));
        }
        written = Some((span, another));
    }
    let orientation = written.map_or(Orientation::Aligned, |(_, orientation)| orientation);
    let members = match tokens.group(Delimiter::Brace) {
        Some((inner, _)) => {
            // A semicolon after the braces is redundant but common.
            let _ = tokens.mark(';');
            members(inner)
        }
        None if tokens.mark(';').is_some() => Vec::new(),
        None if tokens.at_line_start() => {
            let place = Span {
                start: tokens.previous().end,
                end: tokens.previous().end,
            };
            let finding = Diagnostic::error(
                Code::MissingSemicolon,
                place,
                "missing `{ … }` or `;` after a body",
            )
            .label("expected `{` or `;`")
            .help("a body that carries no points ends in `;`");
            tokens.reader.report(finding, start.start, place.end);
            Vec::new()
        }
        None => {
            let help = if tokens.peek_mark(',') {
                "write the angle as `turned ANGLE`"
            } else {
                "a body ends in `{ … }` with its points, or in `;`"
            };
            return Err(after_expression(tokens, "`{` or `;`", help));
        }
    };
    Ok(Body {
        docs,
        name,
        origin,
        orientation,
        members,
        span: start.to(tokens.previous()),
    })
}

/// Parses `turned ANGLE` or `facing A -> B`; `None` if neither follows.
fn orientation(tokens: &mut Tokens<'_>) -> Outcome<Option<Orientation>> {
    if tokens.keyword("turned").is_some() {
        return Ok(Some(Orientation::Angle(expression(tokens)?)));
    }
    if tokens.keyword("facing").is_some() {
        return Ok(Some(Orientation::Facing(direction(tokens)?)));
    }
    Ok(None)
}

/// Parses the members between braces. Each malformed member is reported and skipped.
pub(super) fn members(mut tokens: Tokens<'_>) -> Vec<Member> {
    let mut members = Vec::new();
    while !tokens.at_end() && !tokens.reader.is_full() {
        let start = tokens.next_span();
        let docs = tokens.reader.docs(start.start, false);
        let failure = match member(&mut tokens, docs) {
            Ok(member) => {
                members.push(member);
                if tokens.mark(',').is_some() || tokens.at_end() {
                    continue;
                }
                // A member that follows without a comma is still read.
                let semicolon = tokens.mark(';');
                let failure = match semicolon {
                    Some(semicolon) => Box::new(
                        Diagnostic::error(
                            Code::UnexpectedToken,
                            semicolon,
                            "expected `,` or `}`, found `;`",
                        )
                        .help("the points of a body are separated with `,`"),
                    ),
                    None => separator(
                        &tokens,
                        "`,` or `}`",
                        "a point of a body is written `P: (X, Y)`, or `P` if a `point` above declares it",
                    ),
                };
                if semicolon.is_some() || tokens.peek_word().is_some() {
                    tokens
                        .reader
                        .report(*failure, start.start, tokens.previous().end);
                    continue;
                }
                failure
            }
            Err(failure) => failure,
        };
        while !tokens.at_end() && tokens.mark(',').is_none() {
            tokens.skip();
        }
        tokens
            .reader
            .report(*failure, start.start, tokens.previous().end);
    }
    members
}

fn member(tokens: &mut Tokens<'_>, docs: Vec<String>) -> Outcome<Member> {
    let name = identifier(tokens, "the name of a point")?;
    if tokens.mark(':').is_some() {
        let (position, _) = coordinates(tokens, 2)?;
        return Ok(Member::Local {
            docs,
            name,
            position,
        });
    }
    if tokens.peek_mark('=') || tokens.peek_group(Delimiter::Parenthesis) {
        let help = format!(
            "a point in the body's frame is written `{}: (X, Y)`",
            name.text
        );
        return Err(tokens.unexpected("`:`, `,` or `}`", &help));
    }
    Ok(Member::Carried { docs, name })
}
