//! Collects findings of all stages and prints them with their source locations.
//!
//! Every stage pushes its findings into one [`Diagnostics`]; the pipeline stops at the boundary of a stage with an error.
//! Findings are then ordered by position and printed once each. Printing never panics, whatever the spans.
//!
//! This module handles text, byte offsets and finished sentences, independently of the language. Messages are in lower case,
//! with names in backticks and without a full stop. The message states the fault, and `help` the remedy.

mod code;
#[doc(hidden)]
pub mod internal;
mod merge;
mod render;
mod sink;
mod source;
mod spelling;
mod suggestion;

pub use code::Code;
pub use merge::merged;
pub use sink::Diagnostics;
pub use source::{Attachment, Position, Source, Span};
pub use suggestion::{Suggestions, nearest};

/// Severity of a finding.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Fatal: nothing is generated.
    Error,
    /// Output is generated, but should be reviewed.
    Warning,
}

impl Severity {
    /// Returns the word that opens the printed finding: `error` or `warning`.
    pub fn word(self) -> &'static str {
        match self {
            Severity::Error => "error",
            Severity::Warning => "warning",
        }
    }
}

/// A marked location with its text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Label {
    /// Marked location.
    pub span: Span,
    /// Text beside the marks; may be empty.
    pub text: String,
}

/// A finding: its fault, location and remedy.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostic {
    /// Severity; an error stops the pipeline.
    #[doc(hidden)]
    pub severity: Severity,
    /// Class of the finding, printed as `K07`.
    pub code: Code,
    /// Fault in lower case, with names in backticks and without a full stop.
    pub message: String,
    /// Location of the cause, marked `^^^`.
    #[doc(hidden)]
    pub primary: Label,
    /// Further locations that explain the cause, such as a first declaration or an opening bracket, marked `---`.
    #[doc(hidden)]
    pub secondary: Vec<Label>,
    /// Remedies, one sentence each.
    pub help: Vec<String>,
    /// Background that is neither cause nor remedy.
    pub notes: Vec<String>,
}

impl Diagnostic {
    /// Creates an error at `span`.
    #[doc(hidden)]
    pub fn error(code: Code, span: Span, message: impl Into<String>) -> Self {
        Self::new(Severity::Error, code, span, message.into())
    }

    /// Creates a warning at `span`.
    #[doc(hidden)]
    pub fn warning(code: Code, span: Span, message: impl Into<String>) -> Self {
        Self::new(Severity::Warning, code, span, message.into())
    }

    fn new(severity: Severity, code: Code, span: Span, message: String) -> Self {
        let primary = Label {
            span,
            text: String::new(),
        };
        Self {
            severity,
            code,
            message,
            primary,
            secondary: Vec::new(),
            help: Vec::new(),
            notes: Vec::new(),
        }
    }

    /// Sets the text beside the marks of the primary location.
    #[doc(hidden)]
    pub fn label(mut self, text: impl Into<String>) -> Self {
        self.primary.text = text.into();
        self
    }

    /// Marks a further location.
    #[doc(hidden)]
    pub fn also(mut self, span: Span, text: impl Into<String>) -> Self {
        self.secondary.push(Label {
            span,
            text: text.into(),
        });
        self
    }

    /// Adds a remedy.
    #[doc(hidden)]
    pub fn help(mut self, text: impl Into<String>) -> Self {
        self.help.push(text.into());
        self
    }

    /// Replaces all remedies by this one.
    #[doc(hidden)]
    pub fn instead(mut self, text: impl Into<String>) -> Self {
        self.help = vec![text.into()];
        self
    }

    /// Adds background.
    #[doc(hidden)]
    pub fn note(mut self, text: impl Into<String>) -> Self {
        self.notes.push(text.into());
        self
    }

    /// True for an error, false for a warning.
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }

    /// Returns the first position of the cause in the source, and the one behind its last character.
    pub fn range(&self, source: &Source) -> [Position; 2] {
        let span = self.primary.span.range();
        let lines = source::Lines::of(source);
        [span.start, span.end].map(|offset| lines.position(offset))
    }

    /// Returns the text for an editor that marks the place itself, a line each: message, label, background, help.
    #[doc(hidden)]
    pub fn words(&self) -> String {
        let mut lines = vec![self.message.clone()];
        lines.extend((!self.primary.text.is_empty()).then(|| self.primary.text.clone()));
        lines.extend(self.notes.iter().map(|note| format!("note: {note}")));
        lines.extend(self.help.iter().map(|help| format!("help: {help}")));
        lines.join("\n")
    }

    /// Renders the finding in the format of rustc, without color, ending in a line break.
    pub fn render(&self, source: &Source) -> String {
        render::one(self, &source::Lines::of(source))
    }
}
