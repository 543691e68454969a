//! The findings in the text that is made of tokens are those in the text that was written, at the same tokens.

use linkwright_codegen::diagnostic::{Diagnostic, Label, Source, Span};
use linkwright_codegen::generate;
use proc_macro2::LineColumn;

use super::{descriptions, tokens};
use crate::written::Written;

/// The errors of a description, or its warnings where it has no error.
fn findings(source: &Source) -> Vec<Diagnostic> {
    match generate(source) {
        Ok(generated) => generated.warnings.into_sorted(),
        Err(found) => found.into_sorted(),
    }
}

/// A finding without its places.
fn words(finding: &Diagnostic) -> Diagnostic {
    let words = |label: &Label| Label {
        span: Span::empty(0),
        text: label.text.clone(),
    };
    Diagnostic {
        primary: words(&finding.primary),
        secondary: finding.secondary.iter().map(words).collect(),
        ..finding.clone()
    }
}

#[test]
fn every_finding_is_at_its_token() {
    let (mut files, mut places) = (0, 0);
    for source in descriptions("tests/cases/errors") {
        // What is not made of tokens is refused by the compiler.
        let Some(tokens) = tokens(&source.text) else {
            continue;
        };
        let written = Written::of(&tokens);
        let expected = findings(&source);
        let found = findings(&Source {
            text: written.text.clone(),
            ..source.clone()
        });
        let all_words = |found: &[Diagnostic]| found.iter().map(words).collect::<Vec<_>>();
        assert_eq!(all_words(&found), all_words(&expected), "{}", source.name);
        for (found, expected) in found.iter().zip(&expected) {
            let labels = |finding: &Diagnostic| {
                let labels = std::iter::once(&finding.primary).chain(&finding.secondary);
                labels.map(|label| label.span).collect::<Vec<_>>()
            };
            for (place, expected) in labels(found).into_iter().zip(labels(expected)) {
                let [first, last] = written.tokens_at(place);
                let position = source.position(expected.start);
                let position = LineColumn {
                    line: position.line,
                    column: position.column - 1,
                };
                if expected.range().is_empty() {
                    // Between two tokens, or at the end of the file.
                    assert!(first.start() <= position, "{}: {found:?}", source.name);
                } else {
                    let within = first.start() <= position && position < first.end();
                    assert!(within, "{}: {position:?} {found:?}", source.name);
                    let end = source.position(expected.end);
                    let end = (end.line, end.column - 1);
                    let last = last.end();
                    assert!(end <= (last.line, last.column), "{}", source.name);
                }
                places += 1;
            }
        }
        files += 1;
    }
    assert!(
        files > 100 && places > 500,
        "{files} files, {places} places"
    );
}
