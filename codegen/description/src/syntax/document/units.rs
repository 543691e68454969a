//! Defines the syntax of `units`: the units of reported values.

use crate::diagnostic::Span;
use crate::syntax::formula::Name;

/// `units mm, deg;`: units of tables, pictures and messages.
#[derive(Debug, Clone, PartialEq)]
pub struct Units {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// Units, at least one; the text is without blanks. They are not checked.
    pub units: Vec<Name>,
    /// The whole statement with its semicolon.
    pub span: Span,
}
