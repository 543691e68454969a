//! `point`, `curve` and `body`, as written: what the drawing shows.

use crate::diagnostic::Span;
use crate::syntax::formula::{Direction, Expression, Name, Pair, Reference};

/// `point A = (X, Y), B = (X, Y);`: points in the global frame, as drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Points {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// The points in written order; at least one.
    pub points: Vec<DrawnPoint>,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// One point of a `point` statement.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnPoint {
    /// Its name.
    pub name: Name,
    /// Its global position as drawn.
    pub position: Pair,
}

/// `curve NAME(s) on BODY = (X, Y);`: a curve fixed in the frame of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// Its name.
    pub name: Name,
    /// What runs along it.
    pub parameter: Name,
    /// From where to where it is drawn, where that is written: `(s from 0 to 200mm)`.
    pub range: Option<[Expression; 2]>,
    /// The body that carries it.
    pub body: Name,
    /// Its points.
    pub shape: Shape,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// The points of a curve in terms of its parameter.
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
    /// An identifier or an integer.
    pub name: Name,
    /// Where the body's frame is estimated to be.
    pub origin: Origin,
    /// How the body's frame is estimated to be turned.
    pub orientation: Orientation,
    /// The points it carries, in written order.
    pub members: Vec<Member>,
    /// The whole statement.
    pub span: Span,
}

/// The place of a body's frame.
#[derive(Debug, Clone, PartialEq)]
pub enum Origin {
    /// `at (X, Y)`, or the first two of `at (X, Y, ANGLE)`.
    Coordinates(Pair),
    /// `at P`.
    Point(Reference),
}

/// The angle of a body's frame.
#[derive(Debug, Clone, PartialEq)]
pub enum Orientation {
    /// Nothing written: parallel to the global frame.
    Aligned,
    /// `at (X, Y, ANGLE)` or `turned ANGLE`.
    Angle(Expression),
    /// `facing A -> B`: the x axis points from `A` to `B` as drawn.
    Facing(Direction),
}

/// A point of a body.
#[derive(Debug, Clone, PartialEq)]
pub enum Member {
    /// `P: (X, Y)`, in the body's frame.
    Local {
        /// The `///` lines above it.
        docs: Vec<String>,
        /// Its name.
        name: Name,
        /// Its position in the body's frame.
        position: Pair,
    },
    /// `A`: the body carries the point drawn globally under this name.
    Carried {
        /// The `///` lines above it.
        docs: Vec<String>,
        /// The name of the drawn point.
        name: Name,
    },
}
