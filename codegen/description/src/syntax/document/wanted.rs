//! Defines the syntax of `output`, `transmission`, `sensitivity` and statements of one word.

use crate::diagnostic::Span;
use crate::syntax::formula::{Name, Reference};

/// `output velocity K, phi(1);`: quantities for the generated code to return.
#[derive(Debug, Clone, PartialEq)]
pub struct Output {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// Highest level, one of [`LEVELS`](crate::syntax::LEVELS); `None` for all levels.
    pub level: Option<Name>,
    /// Requested quantities; at least one.
    pub items: Vec<OutputItem>,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// `transmission K, phi(1);`: quantities whose rates per driver are requested.
#[derive(Debug, Clone, PartialEq)]
pub struct Transmission {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// Quantities; at least one.
    pub items: Vec<OutputItem>,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// `sensitivity L2, L3;`: parameters with respect to which the motion is differentiated.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensitivity {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// Parameters; at least one.
    pub names: Vec<Name>,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// A statement of one word.
#[derive(Debug, Clone, PartialEq)]
pub struct Directive {
    /// Kind of the statement.
    pub kind: DirectiveKind,
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// Kinds of statements of one word.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DirectiveKind {
    /// `monitor`: every frame reports the distance from a singular pose.
    Monitor,
    /// `unguarded`: frames are not verified to stay on the path of the previous one.
    Unguarded,
    /// `effort`: every frame reports the driving forces and torques.
    Effort,
    /// `reactions`: every frame reports the reactions of all joints.
    Reactions,
    /// `least_norm`: redundant joints have the reactions of least norm.
    LeastNorm,
    /// `energy`: every frame reports the stored energy.
    Energy,
}

/// One requested quantity.
#[derive(Debug, Clone, PartialEq)]
pub enum OutputItem {
    /// Motion of a point.
    Point(Reference),
    /// `phi(1)`: a coordinate of a body.
    Coordinate {
        /// `x`, `y` or `phi`; the parser accepts any word.
        axis: Name,
        /// Operands in the parentheses; one body if valid.
        bodies: Vec<Reference>,
        /// Location of the whole item.
        span: Span,
    },
}
