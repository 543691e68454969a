//! What a drawing shows of a joint.
//!
//! A kind says which of the draughtsman's signs is its own, in terms of its operands; how a sign looks, and how several of them at
//! one place become one, is for the drawing to say. A driver has the sign of what it drives.

use crate::expr::ExprId;

/// The sign of a joint. Marks are those of its operands, and so is the line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Feature {
    /// The two marks are one pin.
    Pin,
    /// The two bodies are one, joined where the marks are.
    Weld,
    /// The body of the mark beside the line slides along it and does not turn against it.
    Slide,
    /// The mark beside the line slides along it, this far to its left, and its body turns.
    Slot(ExprId),
    /// A component of the first mark is kept: 0 for x, 1 for y.
    Coordinate(usize),
    /// The angle of the first mark's body is kept.
    Orientation,
    /// The distance of the two marks is kept, as by a link.
    Link,
    /// A component of the vector from the first mark to the second is kept.
    Offset(usize),
    /// The angle between the two bodies is kept.
    RelativeOrientation,
    /// Wheels of the first two bodies, seen from the third, whose radii have this ratio.
    Wheels(Mesh, ExprId),
    /// A wheel of this radius about the mark beside the line rolls on it.
    Pinion(ExprId),
    /// The first mark's body touches the curve.
    Contact(Follower),
    /// What an equation says of its marks has no sign.
    Written,
}

/// How two wheels move one another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mesh {
    /// By teeth outside.
    External,
    /// By teeth, one inside the other.
    Internal,
    /// By a belt.
    Belt,
    /// By a belt that crosses itself.
    CrossedBelt,
}

/// With what a body touches a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Follower {
    /// The mark itself.
    Point,
    /// A roller of this radius about the mark.
    Roller(ExprId),
    /// The face along the line.
    Face,
}
