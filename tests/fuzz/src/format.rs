//! Checks that a description is refused, or formatted without loss: its words, marks, comments and meaning are
//! unchanged, and formatting again changes nothing.

use linkwright_codegen::diagnostic::{Diagnostics, Source};
use linkwright_codegen::stages::syntax::{Document, parse};

/// Formats; true if the text can be read.
///
/// # Panics
/// If the formatted text is not as it should be.
pub fn run(source: &Source) -> bool {
    let mut diagnostics = Diagnostics::new();
    let document = parse(source, &mut diagnostics);
    let formatted = linkwright_codegen::format(source);
    let Some(document) = document.filter(|_| !diagnostics.has_errors()) else {
        assert!(formatted.is_err_and(|diagnostics| diagnostics.has_errors()));
        return false;
    };
    let formatted = formatted.expect("what can be read can be formatted");
    assert_eq!(bare(&formatted), bare(&source.text), "other characters");
    assert_eq!(
        comments(&formatted),
        comments(&source.text),
        "other comments"
    );
    let mut again = source.clone();
    again.text = formatted;
    let mut diagnostics = Diagnostics::new();
    let other = parse(&again, &mut diagnostics).expect("a formatted description");
    assert!(!diagnostics.has_errors(), "{}", diagnostics.render(&again));
    assert_eq!(meaning(&other), meaning(&document), "{}", again.text);
    let twice = linkwright_codegen::format(&again).expect("a formatted description");
    assert_eq!(twice, again.text, "formatting again changes the text");
    true
}

/// All characters of a text except for its blanks and line breaks.
fn bare(text: &str) -> String {
    let is_part = |it: &char| !it.is_whitespace() && *it != '\u{feff}';
    text.chars().filter(is_part).collect()
}

/// Lines that are comments alone.
fn comments(text: &str) -> Vec<&str> {
    let lines = text.lines().map(str::trim);
    lines.filter(|it| it.starts_with("//")).collect()
}

/// Document without its places.
fn meaning(document: &Document) -> String {
    let debug_text = format!("{document:?}");
    let mut parts = debug_text.split("Span { ");
    let first = parts.next().unwrap_or_default().to_string();
    parts.fold(first, |meaning, part| {
        meaning + part.split_once('}').map_or(part, |(_, rest)| rest)
    })
}
