//! Errors in the text made of tokens equal those in the original text, at the same tokens.

use linkwright_codegen::diagnostic::{Diagnostic, Label, Source, Span};
use linkwright_codegen::{Options, generate};
use proc_macro2::LineColumn;

use super::{descriptions, tokens};
use crate::written::Written;

/// Errors of a description, or its warnings if it has no error.
fn findings(source: &Source) -> Vec<Diagnostic> {
    match generate(source, &Options::default()) {
        Ok(generated) => generated.warnings.into_sorted(),
        Err(found) => found.into_sorted(),
    }
}

/// Finding without its locations.
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
        // The compiler refuses text that is not made of tokens.
        let Some(tokens) = tokens(&source.text) else {
            continue;
        };
        let written = Written::of(&tokens);
        let expected = findings(&source);
        let from_tokens = findings(&Source {
            text: written.text.clone(),
            ..source.clone()
        });
        let all_words =
            |from_tokens: &[Diagnostic]| from_tokens.iter().map(words).collect::<Vec<_>>();
        assert_eq!(
            all_words(&from_tokens),
            all_words(&expected),
            "{}",
            source.name
        );
        for (from_tokens, expected) in from_tokens.iter().zip(&expected) {
            let labels = |finding: &Diagnostic| {
                let labels = std::iter::once(&finding.primary).chain(&finding.secondary);
                labels.map(|label| label.span).collect::<Vec<_>>()
            };
            for (place, expected) in labels(from_tokens).into_iter().zip(labels(expected)) {
                let [first, last] = written.tokens_at(place);
                let position = source.position(expected.start);
                let position = LineColumn {
                    line: position.line,
                    column: position.column - 1,
                };
                if expected.range().is_empty() {
                    // Between two tokens, or at the end of the file.
                    assert!(
                        first.start() <= position,
                        "{}: {from_tokens:?}",
                        source.name
                    );
                } else {
                    let within = first.start() <= position && position < first.end();
                    assert!(within, "{}: {position:?} {from_tokens:?}", source.name);
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
