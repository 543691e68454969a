//! `table NAME = …`, as written: a function through points that are listed or stand in a file.

use crate::diagnostic::Span;
use crate::syntax::formula::{Expression, Name, Pair};

/// `table NAME = [(X, Y), (X, Y)] ENDS;` or `table NAME = "FILE" columns (X, Y) in (UNIT, UNIT) ENDS;`: a function that goes through these points.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// Its name.
    pub name: Name,
    /// Its points.
    pub points: TablePoints,
    /// Where these are written.
    pub place: Span,
    /// How it ends, where that is written.
    pub ends: Option<Ends>,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// Where the points of a table are.
#[derive(Debug, Clone, PartialEq)]
pub enum TablePoints {
    /// `[(X, Y), (X, Y)]`: here, in written order.
    Listed(Vec<Pair>),
    /// `"FILE" columns (X, Y) in (UNIT, UNIT)`: in a file.
    InFile {
        /// The path between the quotes.
        path: Name,
        /// The columns, by their names or their numbers from 1, where they are chosen.
        columns: Option<[Name; 2]>,
        /// The units of both columns, where they are written; whether such units exist is not checked here.
        units: Option<[Name; 2]>,
    },
}

/// `periodic`, `clamped(SLOPE, SLOPE)`: how a table ends.
#[derive(Debug, Clone, PartialEq)]
pub struct Ends {
    /// The word; whether it has a meaning is not checked here.
    pub word: Name,
    /// What stands in the parentheses.
    pub slopes: Vec<Expression>,
    /// Both.
    pub span: Span,
}
