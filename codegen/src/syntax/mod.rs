//! *Source → Document.* The only room that parses.

mod document;

pub use document::*;

use crate::diagnostic::{Diagnostics, Source};

/// The deepest nesting that is read: brackets, signs, powers and calls inside one another.
pub const DEEPEST: usize = 128;

/// Reads a description. `None` when there is no mechanism to speak of; errors are in `diagnostics` either way.
pub fn parse(_source: &Source, _diagnostics: &mut Diagnostics) -> Option<Document> {
    None
}
