//! Converts findings to diagnostics of the protocol, with the texts and places of the command line.

use linkwright_codegen::diagnostic::{Code, Diagnostic, Diagnostics, Severity};
use lsp_types::{
    self as lsp, DiagnosticRelatedInformation, DiagnosticSeverity, DiagnosticTag, Location,
    NumberOrString, Uri,
};

use super::text::Text;

/// Source of the diagnostics.
const SOURCE: &str = "linkwright";

/// Capabilities of a client.
#[derive(Clone, Copy, Debug, Default)]
pub struct Shown {
    /// True if the client shows other places that explain a finding.
    pub related_places: bool,
    /// True if the client shows that something is unused.
    pub unused: bool,
}

/// Returns all findings, by place.
pub fn diagnostics(
    found: &Diagnostics,
    uri: &Uri,
    text: &Text,
    shown: Shown,
) -> Vec<lsp::Diagnostic> {
    let sorted = found.clone().into_sorted();
    let each = sorted.iter().map(|it| diagnostic(it, uri, text, shown));
    each.collect()
}

fn diagnostic(found: &Diagnostic, uri: &Uri, text: &Text, shown: Shown) -> lsp::Diagnostic {
    let severity = match found.severity {
        Severity::Error => DiagnosticSeverity::ERROR,
        Severity::Warning => DiagnosticSeverity::WARNING,
    };
    let places = found.secondary.iter().map(|label| {
        let location = Location::new(uri.clone(), text.range(label.span));
        // A place without words is marked as on the command line.
        let words = match label.text.is_empty() {
            true => found.message.clone(),
            false => label.text.clone(),
        };
        (location, words)
    });
    let mut message = found.words();
    let related = match shown.related_places {
        true => Some(
            places
                .map(|(location, message)| DiagnosticRelatedInformation { location, message })
                .collect(),
        ),
        false => {
            for (location, words) in places {
                let line = location.range.start.line + 1;
                message.push_str(&format!("\nline {line}: {words}"));
            }
            None
        }
    };
    let is_unused = shown.unused && found.code == Code::UnusedName;
    lsp::Diagnostic {
        range: text.range(found.primary.span),
        severity: Some(severity),
        code: Some(NumberOrString::String(found.code.to_string())),
        source: Some(SOURCE.to_string()),
        message,
        related_information: related,
        tags: is_unused.then(|| vec![DiagnosticTag::UNNECESSARY]),
        ..lsp::Diagnostic::default()
    }
}
