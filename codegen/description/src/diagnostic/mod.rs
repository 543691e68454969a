//! *Findings of any stage → text for a person.* The place in the source, the code, the severity and the sink.
//!
//! Every stage pushes what it finds into one [`Diagnostics`]; the pipeline stops at the border of a stage that found an error.
//! Afterwards the findings are ordered by position, each is printed once, and printing never panics whatever the spans are.
//! This room does not know the language: it sees text, byte offsets and sentences made elsewhere.
//!
//! Messages are lower case, put names in backticks and have no full stop: the message says what is, `help` says what to do.

mod code;
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

/// How serious a finding is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Nothing is generated.
    Error,
    /// The output is generated, but a person should look.
    Warning,
}

impl Severity {
    /// The word that opens the printed finding: `error` or `warning`.
    pub fn word(self) -> &'static str {
        match self {
            Severity::Error => "error",
            Severity::Warning => "warning",
        }
    }
}

/// A place in the source with what is to be said about it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Label {
    /// The marked place.
    pub span: Span,
    /// The words beside the marks; may be empty.
    pub text: String,
}

/// One finding: what is wrong, where, and what to do about it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostic {
    /// Whether it stops the pipeline.
    pub severity: Severity,
    /// The class of the finding, printed as `K07`.
    pub code: Code,
    /// What is wrong: lower case, names in backticks, no full stop.
    pub message: String,
    /// The place of the cause, marked `^^^`.
    pub primary: Label,
    /// Other places that explain the cause (a first declaration, an opening bracket), marked `---`.
    pub secondary: Vec<Label>,
    /// What to do about it, one sentence each.
    pub help: Vec<String>,
    /// Background that is neither the cause nor a remedy.
    pub notes: Vec<String>,
}

impl Diagnostic {
    /// An error at `span`.
    pub fn error(code: Code, span: Span, message: impl Into<String>) -> Self {
        Self::new(Severity::Error, code, span, message.into())
    }

    /// A warning at `span`.
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

    /// Puts words beside the carets of the primary place.
    pub fn label(mut self, text: impl Into<String>) -> Self {
        self.primary.text = text.into();
        self
    }

    /// Marks a second place.
    pub fn also(mut self, span: Span, text: impl Into<String>) -> Self {
        self.secondary.push(Label {
            span,
            text: text.into(),
        });
        self
    }

    /// Adds a line that says what to do.
    pub fn help(mut self, text: impl Into<String>) -> Self {
        self.help.push(text.into());
        self
    }

    /// Says what to do in place of what was said about it.
    pub fn instead(mut self, text: impl Into<String>) -> Self {
        self.help = vec![text.into()];
        self
    }

    /// Adds a line of background.
    pub fn note(mut self, text: impl Into<String>) -> Self {
        self.notes.push(text.into());
        self
    }

    /// The finding as rustc would print it, without color, ending in a line break.
    pub fn render(&self, source: &Source) -> String {
        render::one(self, &source::Lines::of(source))
    }
}
