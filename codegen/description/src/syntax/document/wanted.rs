//! `output`, `transmission`, `sensitivity` and statements of one word, as written: what the generated code is asked for.

use crate::diagnostic::Span;
use crate::syntax::formula::{Name, Reference};

/// `output velocity K, phi(1);`: what the generated code is asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct Output {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// Up to which level, if not all: one of [`LEVELS`](crate::syntax::LEVELS).
    pub level: Option<Name>,
    /// What is wanted; at least one.
    pub items: Vec<OutputItem>,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// `transmission K, phi(1);`: what the drivers move, and how fast.
#[derive(Debug, Clone, PartialEq)]
pub struct Transmission {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// What is moved; at least one.
    pub items: Vec<OutputItem>,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// `sensitivity L2, L3;`: the parameters along which the motion is differentiated.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensitivity {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// The parameters; at least one.
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
    /// `monitor`: every frame says how close the mechanism is to a singular pose.
    Monitor,
    /// `unguarded`: no frame is shown to lie on the path of the last one.
    Unguarded,
    /// `effort`: every frame says what the drivers exert.
    Effort,
    /// `reactions`: every frame says what every joint carries.
    Reactions,
    /// `least_norm`: where joints repeat one another, they carry what is smallest.
    LeastNorm,
    /// `energy`: every frame says how much work is stored.
    Energy,
}

/// One wanted quantity.
#[derive(Debug, Clone, PartialEq)]
pub enum OutputItem {
    /// The motion of a point.
    Point(Reference),
    /// `phi(1)`: a coordinate of a body.
    Coordinate {
        /// `x`, `y` or `phi`, as far as the parser knows any word.
        axis: Name,
        /// What stands in the parentheses: one body, if it is right.
        bodies: Vec<Reference>,
        /// The whole item.
        span: Span,
    },
}
