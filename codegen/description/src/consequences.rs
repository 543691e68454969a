//! Filters errors of a partly read document that only follow from the unread parts.
//!
//! A body in an unreadable statement is missing later; reporting each of its uses would bury the relevant error. An unknown
//! name is therefore reported only if it does not occur in the unread text.

use crate::diagnostic::{Code, Diagnostic, Diagnostics, Source, Span};
use crate::syntax::{Document, Statement};

/// Adds the errors of `resolving` to those of the syntax, except for those that the unread text explains.
pub fn add_independent(
    resolving: Diagnostics,
    document: &Document,
    source: &Source,
    diagnostics: &mut Diagnostics,
) {
    let unread = unread_text(document, source, diagnostics);
    let words: Vec<&str> = unread.iter().flat_map(|text| words(text)).collect();
    for diagnostic in resolving.into_sorted() {
        if !may_follow(&diagnostic, source, &words) {
            diagnostics.push(diagnostic);
        }
    }
}

/// True if an error may follow from unread text.
fn may_follow(diagnostic: &Diagnostic, source: &Source, unread_words: &[&str]) -> bool {
    match diagnostic.code {
        Code::UnknownName | Code::PointNotOnBody => {
            text_of(diagnostic.primary.span, source).is_none_or(|word| unread_words.contains(&word))
        }
        // The statement of the table may be unread.
        Code::UnknownFunction => text_of(diagnostic.primary.span, source).is_none_or(|name| {
            let mut pairs = unread_words.windows(2);
            pairs.any(|pair| pair == ["table", name])
        }),
        // A length driver requires a translational joint, and the force of teeth requires revolute joints.
        Code::WrongForm => {
            let mut beside = diagnostic.secondary.iter();
            let is_of_teeth = beside.any(|label| {
                let text = text_of(label.span, source);
                text.is_some_and(|text| text.contains("pressure_angle"))
            });
            unread_words.contains(&"along") || is_of_teeth && unread_words.contains(&"revolute")
        }
        // The body may be declared in unread text.
        Code::NoBodies => true,
        _ => false,
    }
}

/// Returns the text between the statements that were read, and every line with an error.
fn unread_text<'a>(document: &Document, source: &'a Source, syntax: &Diagnostics) -> Vec<&'a str> {
    let mut texts = Vec::new();
    let mut position = document.mechanism.span.start;
    for span in read_places(&document.mechanism.statements) {
        texts.extend(text_of(
            Span {
                start: position,
                end: span.start.max(position),
            },
            source,
        ));
        position = span.end.max(position);
    }
    let rest = Span {
        start: position,
        end: u32::try_from(source.text.len()).unwrap_or(u32::MAX),
    };
    texts.extend(text_of(rest, source));
    for diagnostic in syntax.iter() {
        let at = (diagnostic.primary.span.start as usize).min(source.text.len());
        let bytes = source.text.as_bytes();
        let start = bytes[..at]
            .iter()
            .rposition(|&byte| byte == b'\n')
            .map_or(0, |found| found + 1);
        let end = bytes[at..]
            .iter()
            .position(|&byte| byte == b'\n')
            .map_or(bytes.len(), |found| at + found);
        texts.extend(source.text.get(start..end));
    }
    texts
}

/// Returns the locations of the statements that were read; for a motion, of those in its braces.
fn read_places(statements: &[Statement]) -> Vec<Span> {
    let places = statements.iter().flat_map(|statement| match statement {
        Statement::Motion(motion) => read_places(&motion.statements),
        other => vec![other.span()],
    });
    places.collect()
}

fn text_of(span: Span, source: &Source) -> Option<&str> {
    source.text.get(span.start as usize..span.end as usize)
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|character: char| !character.is_alphanumeric() && character != '_')
        .filter(|word| !word.is_empty())
}
