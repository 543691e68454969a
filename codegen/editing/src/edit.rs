//! Represents changes of a text.

use linkwright_codegen::diagnostic::Span;

/// Replacement of a part of a text. The spans of several edits are those of the text before all of them, and do not overlap.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edit {
    /// Replaced bytes.
    pub span: Span,
    /// New text.
    pub text: String,
}
