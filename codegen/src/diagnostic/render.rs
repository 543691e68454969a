//! *One finding → a frame as rustc prints it.*

use super::Diagnostic;
use super::source::Lines;

/// The frame of one finding, ending in a line break.
pub(super) fn one(diagnostic: &Diagnostic, lines: &Lines<'_>) -> String {
    let position = lines.position(diagnostic.primary.span.start as usize);
    format!(
        "{}[{}]: {}\n  --> {}:{}:{}\n",
        diagnostic.severity.word(),
        diagnostic.code,
        diagnostic.message,
        lines.name(),
        position.line,
        position.column
    )
}
