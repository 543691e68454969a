//! Lines of documentation.

use super::markdown::inert;
use crate::emit::module;
use crate::emit::module::wrapped::wrapped;
use crate::system::System;

/// Documentation of a mechanism in its description, line by line.
pub fn documentation(system: &System) -> Vec<String> {
    doc_lines(module::documentation::of_mechanism(system))
}

/// The lines of a text as they stand after the slashes: with a space before them, as a person writes it.
pub(super) fn doc_lines<S: AsRef<str>>(lines: impl IntoIterator<Item = S>) -> Vec<String> {
    let spaced = |line: String| match line.is_empty() {
        true => line,
        false => format!(" {line}"),
    };
    wrapped(inert(lines)).into_iter().map(spaced).collect()
}
