//! Defines the syntax of `point`, `curve` and `body`.

use crate::diagnostic::Span;
use crate::syntax::formula::{Direction, Expression, Name, Pair, Reference};

/// `point A = (X, Y), B = (X, Y);`: points in the global frame, in the design configuration.
#[derive(Debug, Clone, PartialEq)]
pub struct Points {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// Points in source order; at least one.
    pub points: Vec<DrawnPoint>,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// One point of a `point` statement.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnPoint {
    /// Name of the point.
    pub name: Name,
    /// Global position in the design configuration.
    pub position: Pair,
}

/// `curve NAME(s) on BODY = (X, Y);`: a curve fixed in the frame of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// Name of the curve.
    pub name: Name,
    /// Parameter of the curve.
    pub parameter: Name,
    /// Range of the parameter in pictures: `(s from 0 to 200mm)`; `None` if not written.
    pub range: Option<[Expression; 2]>,
    /// Body to which the curve is fixed.
    pub body: Name,
    /// Coordinates of the curve.
    pub shape: Shape,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// Coordinates of a curve in terms of its parameter.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// `(X, Y)` in the frame of the body.
    Parametric(Pair),
    /// `polar RADIUS`: the parameter is the angle around the origin of the frame.
    Polar(Expression),
}

/// `body NAME at … { members }`.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// Name: an identifier or an integer.
    pub name: Name,
    /// Estimated origin of the body's frame.
    pub origin: Origin,
    /// Estimated orientation of the body's frame.
    pub orientation: Orientation,
    /// Points of the body, in source order.
    pub members: Vec<Member>,
    /// The whole statement.
    pub span: Span,
}

/// Origin of a body's frame.
#[derive(Debug, Clone, PartialEq)]
pub enum Origin {
    /// `at (X, Y)`, or the first two of `at (X, Y, ANGLE)`.
    Coordinates(Pair),
    /// `at P`.
    Point(Reference),
}

/// Orientation of a body's frame.
#[derive(Debug, Clone, PartialEq)]
pub enum Orientation {
    /// Not written: parallel to the global frame.
    Aligned,
    /// `at (X, Y, ANGLE)` or `turned ANGLE`.
    Angle(Expression),
    /// `facing A -> B`: the x axis points from `A` to `B` in the design configuration.
    Facing(Direction),
}

/// A point of a body.
#[derive(Debug, Clone, PartialEq)]
pub enum Member {
    /// `P: (X, Y)`, in the body's frame.
    Local {
        /// The `///` lines above it.
        docs: Vec<String>,
        /// Name of the point.
        name: Name,
        /// Position in the body's frame.
        position: Pair,
    },
    /// `A`: the global point of this name, fixed to the body.
    Carried {
        /// The `///` lines above it.
        docs: Vec<String>,
        /// Name of the global point.
        name: Name,
    },
}
