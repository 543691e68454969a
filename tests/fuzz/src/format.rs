//! *A description* → *the same, formatted, or refused*. It has the words, marks and comments that it had, means the same, and is not
//! changed when it is formatted again.

use linkwright_codegen::diagnostic::{Diagnostics, Source};
use linkwright_codegen::stages::syntax::{Document, parse};

/// Formats; says whether the text can be read.
///
/// # Panics
/// Where the formatted text is not what it should be.
pub fn run(source: &Source) -> bool {
    let mut found = Diagnostics::new();
    let document = parse(source, &mut found);
    let formatted = linkwright_codegen::format(source);
    let Some(document) = document.filter(|_| !found.has_errors()) else {
        assert!(formatted.is_err_and(|found| found.has_errors()));
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
    let mut found = Diagnostics::new();
    let other = parse(&again, &mut found).expect("a formatted description");
    assert!(!found.has_errors(), "{}", found.render(&again));
    assert_eq!(meaning(&other), meaning(&document), "{}", again.text);
    let twice = linkwright_codegen::format(&again).expect("a formatted description");
    assert_eq!(twice, again.text, "formatting again changes the text");
    true
}

/// All characters of a text but its blanks and line breaks.
fn bare(text: &str) -> String {
    let is_part = |it: &char| !it.is_whitespace() && *it != '\u{feff}';
    text.chars().filter(is_part).collect()
}

/// The lines that are comments alone.
fn comments(text: &str) -> Vec<&str> {
    let lines = text.lines().map(str::trim);
    lines.filter(|it| it.starts_with("//")).collect()
}

/// A document without its places.
fn meaning(document: &Document) -> String {
    let shown = format!("{document:?}");
    let mut parts = shown.split("Span { ");
    let first = parts.next().unwrap_or_default().to_string();
    parts.fold(first, |meaning, part| {
        meaning + part.split_once('}').map_or(part, |(_, rest)| rest)
    })
}
