//! Defines the syntax of `table`: a function through points that are listed or in a file.

use crate::diagnostic::Span;
use crate::syntax::formula::{Expression, Name, Pair};

/// `table NAME = [(X, Y), (X, Y)] ENDS;` or `table NAME = "FILE" columns (X, Y) in (UNIT, UNIT) ENDS;`: a function that goes through these points.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// Name of the table.
    pub name: Name,
    /// Interpolated points.
    pub points: TablePoints,
    /// Location of the points.
    pub place: Span,
    /// End conditions; `None` if not written.
    pub ends: Option<Ends>,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// Points of a table.
#[derive(Debug, Clone, PartialEq)]
pub enum TablePoints {
    /// `[(X, Y), (X, Y)]`: listed, in source order.
    Listed(Vec<Pair>),
    /// `"FILE" columns (X, Y) in (UNIT, UNIT)`: in a file.
    InFile {
        /// Path between the quotes.
        path: Name,
        /// Columns by name or number, counted from 1; `None` if not written.
        columns: Option<[Name; 2]>,
        /// Units of both columns, not checked against the known units; `None` if not written.
        units: Option<[Name; 2]>,
    },
}

/// `periodic`, `clamped(SLOPE, SLOPE)`: end conditions of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Ends {
    /// Keyword; any word is accepted.
    pub word: Name,
    /// Arguments in the parentheses.
    pub slopes: Vec<Expression>,
    /// Location of the keyword with its arguments.
    pub span: Span,
}
