//! Formats documentation for `rustdoc`.

use super::markdown::inert;
use crate::emit::module;
use crate::emit::module::wrapped::wrapped;
use crate::system::System;

/// Returns the documentation of a mechanism in its description, line by line.
pub fn documentation(system: &System) -> Vec<String> {
    doc_lines(module::documentation::of_mechanism(system))
}

/// Returns the lines that follow the slashes, each with its space.
pub(super) fn doc_lines<S: AsRef<str>>(lines: impl IntoIterator<Item = S>) -> Vec<String> {
    let spaced = |line: String| match line.is_empty() {
        true => line,
        false => format!(" {line}"),
    };
    wrapped(inert(lines)).into_iter().map(spaced).collect()
}
