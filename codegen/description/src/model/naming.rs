//! What an output asks of the names of a description, as functions that the front end hands over.
//!
//! The model knows no output language. It asks for a finding where a name must not be used, and for a name that is not in use.

use crate::diagnostic::Diagnostic;
use crate::syntax::Name;

/// What names must be like for an output.
#[derive(Clone, Copy, Debug)]
pub struct Naming {
    /// What is wrong with the name of a mechanism.
    pub mechanism: fn(&Name) -> Option<Diagnostic>,
    /// What is wrong with the name of a motion.
    pub motion: fn(&Name) -> Option<Diagnostic>,
    /// A name itself, or with this prefix and `_` where the output has something else of that name. Names that begin with the prefix
    /// must not be in use for anything else.
    pub apart: fn(name: &str, prefix: &str) -> String,
}
