//! Parses a motion of a mechanism: `motion forward { drive phi(1) = t; output K; }`.
//!
//! A motion may contain all statements of a mechanism except for bodies and points, which all motions share, and for motions.

use proc_macro2::Delimiter;

use super::document::{Motion, Statement};
use super::formula::Name;
use super::reader::Outcome;
use super::recovery;
use super::reference::identifier;
use super::tokens::Tokens;
use crate::diagnostic::{Code, Diagnostic, Span};

/// Help for missing braces.
const HELP: &str = "a motion is written `motion NAME { drive phi(BODY) = FORMULA; }`";

/// Parses the statement after its first word. If only the name is wrong, the statements are still read.
pub(super) fn motion(
    tokens: &mut Tokens<'_>,
    mut docs: Vec<String>,
    start: Span,
) -> Outcome<Statement> {
    let reader = tokens.reader;
    let at = tokens.next_span();
    let name = match identifier(tokens, "the name of the motion") {
        Ok(name) => name,
        Err(failure) if tokens.peek_number() || tokens.peek_group(Delimiter::Brace) => {
            reader.report(*failure, start.start, at.end);
            if tokens.peek_number() {
                tokens.skip();
            }
            Name {
                text: String::new(),
                span: at,
            }
        }
        Err(failure) => return Err(failure),
    };
    let Some((mut inner, braces)) = tokens.group(Delimiter::Brace) else {
        return Err(tokens.unexpected("`{`", HELP));
    };
    docs.extend(reader.docs(inner.next_span().start, true));
    let mut statements = recovery::statements(&mut inner);
    statements.retain(|statement| match shared(statement) {
        Some(what) => {
            let span = statement.span();
            reader.report(misplaced(what, span, start), span.start, span.end);
            false
        }
        None => true,
    });
    Ok(Statement::Motion(Motion {
        docs,
        name,
        statements,
        span: start.to(braces),
    }))
}

/// Returns the kind of declaration that all motions share; `None` for other statements.
fn shared(statement: &Statement) -> Option<&'static str> {
    match statement {
        Statement::Points(_) => Some("point"),
        Statement::Body(_) => Some("body"),
        Statement::Motion(_) => Some("motion"),
        _ => None,
    }
}

fn misplaced(what: &str, span: Span, motion: Span) -> Diagnostic {
    let word = Span {
        start: span.start,
        end: span.start + what.len() as u32,
    };
    let finding = Diagnostic::error(
        Code::UnexpectedToken,
        word,
        format!("a {what} inside a motion"),
    )
    .also(motion, "the motion starts here");
    match what {
        "motion" => finding.help("close the braces of the first motion before the second"),
        _ => finding.help("all motions have the same bodies and points: move it above the motions"),
    }
}
