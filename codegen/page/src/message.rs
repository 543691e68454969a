//! Turns findings into messages of a page.

use linkwright_codegen::diagnostic::{Diagnostic, Diagnostics, Severity};
use linkwright_solver::Unopened;
use serde::Serialize;

/// Error or warning, with its place in the description.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Message {
    /// `error` or `warning`.
    pub severity: &'static str,
    /// Code, such as `K32`; `None` for findings about the motion.
    pub code: Option<&'static str>,
    /// Sentence, and its help on lines of their own.
    pub text: String,
    /// Offsets of the marked text, in bytes; `None` without a place.
    pub start: Option<u32>,
    /// End of the marked text.
    pub end: Option<u32>,
}

impl Message {
    /// Creates an error without a place.
    pub fn error(text: impl Into<String>) -> Message {
        Message::unplaced(Severity::Error, text.into())
    }

    /// Creates a warning without a place.
    pub fn warning(text: impl Into<String>) -> Message {
        Message::unplaced(Severity::Warning, text.into())
    }

    fn unplaced(severity: Severity, text: String) -> Message {
        Message {
            severity: severity.word(),
            code: None,
            text,
            start: None,
            end: None,
        }
    }
}

/// Returns all findings as messages.
pub fn messages(findings: &Diagnostics) -> Vec<Message> {
    findings.clone().into_sorted().iter().map(of).collect()
}

/// Returns the messages of a description that cannot be solved.
pub fn refused(reason: &Unopened, name: &str) -> Vec<Message> {
    match reason.message(name) {
        Err(findings) => messages(findings),
        Ok((text, help)) => {
            let help = help.map_or(String::new(), |help| format!("\nhelp: {help}"));
            vec![Message::error(text + &help)]
        }
    }
}

fn of(finding: &Diagnostic) -> Message {
    Message {
        severity: finding.severity.word(),
        code: Some(finding.code.name()),
        text: finding.words(),
        start: Some(finding.primary.span.start),
        end: Some(finding.primary.span.end),
    }
}
