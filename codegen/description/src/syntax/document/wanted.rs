//! Defines the syntax of requests: `output K;`, `transmission K;`, `sensitivity L;`, `reaction P;`, and statements of one word.
//!
//! A request differs from others in its kind alone.

use crate::diagnostic::Span;
use crate::syntax::formula::{Name, Reference};

/// `output velocity K, phi(1);`, `sensitivity L2;`, `monitor;`: request to the generated code.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// Kind of the statement.
    pub kind: RequestKind,
    /// First word.
    pub word: &'static str,
    /// Kind of the operands.
    pub operands: Operands,
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// Highest level, one of [`LEVELS`](crate::syntax::LEVELS); `None` for all levels.
    pub level: Option<Name>,
    /// Points and coordinates; at least one if the kind has [`Operands::Quantities`], otherwise none.
    pub items: Vec<OutputItem>,
    /// Parameters or joints; at least one if the kind has such operands, otherwise none.
    pub names: Vec<Name>,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// Kinds of requests.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RequestKind {
    /// `output`: quantities for the generated code to return.
    Output,
    /// `transmission`: quantities whose rates per driver are requested.
    Transmission,
    /// `sensitivity`: parameters with respect to which the motion is differentiated.
    Sensitivity,
    /// `monitor`: every frame reports the distance from a singular pose.
    Monitor,
    /// `unguarded`: frames are not verified to stay on the path of the previous one.
    Unguarded,
    /// `effort`: every frame reports the driving forces and torques.
    Effort,
    /// `reaction`: every frame reports the reactions of these joints.
    Reaction,
    /// `reactions`: every frame reports the reactions of all joints.
    Reactions,
    /// `least_norm`: redundant joints have the reactions of least norm.
    LeastNorm,
    /// `energy`: every frame reports the stored energy.
    Energy,
}

/// Operands of a request.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Operands {
    /// None: the statement is one word.
    None,
    /// Points and coordinates.
    Quantities,
    /// Names of parameters.
    Parameters,
    /// Names of joints.
    Joints,
}

/// Requests by their first words.
pub(in crate::syntax) const REQUESTS: [(&str, RequestKind, Operands); 10] = [
    ("output", RequestKind::Output, Operands::Quantities),
    (
        "transmission",
        RequestKind::Transmission,
        Operands::Quantities,
    ),
    (
        "sensitivity",
        RequestKind::Sensitivity,
        Operands::Parameters,
    ),
    ("monitor", RequestKind::Monitor, Operands::None),
    ("unguarded", RequestKind::Unguarded, Operands::None),
    ("effort", RequestKind::Effort, Operands::None),
    ("reaction", RequestKind::Reaction, Operands::Joints),
    ("reactions", RequestKind::Reactions, Operands::None),
    ("least_norm", RequestKind::LeastNorm, Operands::None),
    ("energy", RequestKind::Energy, Operands::None),
];

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
