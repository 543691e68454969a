//! `units`, as written: the units in which values are reported.

use crate::diagnostic::Span;
use crate::syntax::formula::Name;

/// `units mm, deg;`: units of tables, pictures and messages.
#[derive(Debug, Clone, PartialEq)]
pub struct Units {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// The units, at least one; the text is without blanks. Their meaning is not checked here.
    pub units: Vec<Name>,
    /// The whole statement with its semicolon.
    pub span: Span,
}
