//! Defines the rules for names in an output language, as functions that the front end supplies.
//!
//! The functions report names that are not permitted, and supply unused names.

use crate::diagnostic::Diagnostic;
use crate::syntax::Name;

/// Rules for names in an output language.
#[derive(Clone, Copy, Debug)]
pub struct Naming {
    /// Checks the name of a mechanism; `None` if it is valid.
    pub mechanism: fn(&Name) -> Option<Diagnostic>,
    /// Checks the name of a motion; `None` if it is valid.
    pub motion: fn(&Name) -> Option<Diagnostic>,
    /// Returns the name itself, or the name with this prefix and `_` if the output uses the name otherwise. Names with this
    /// prefix must be unused for other purposes.
    pub apart: fn(name: &str, prefix: &str) -> String,
}
