//! Defines the symbols of joints in pictures.
//!
//! A kind states its symbol in terms of its operands. The picture decides on appearance, and merges symbols at one position. A
//! driver has the symbol of the driven quantity.

use crate::expr::ExprId;

/// Symbol of a joint. Marks and line are those of its operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Feature {
    /// The two marks coincide in a pin.
    Pin,
    /// The two bodies are welded together at the marks.
    Weld,
    /// The body of the mark beside the line slides along the line without rotation.
    Slide,
    /// The mark beside the line slides along it, at this offset to its left, and its body rotates.
    Slot(ExprId),
    /// A component of the first mark is constant: 0 for x, 1 for y.
    Coordinate(usize),
    /// The angle of the first mark's body is constant.
    Orientation,
    /// The distance of the two marks is constant, as with a link.
    Link,
    /// A component of the vector from the first mark to the second is constant.
    Offset(usize),
    /// The angle between the two bodies is constant.
    RelativeOrientation,
    /// Wheels of the first two bodies on the third, with this ratio of radii.
    Wheels(Mesh, ExprId),
    /// A wheel of this radius about the mark beside the line rolls on the line.
    Pinion(ExprId),
    /// The first mark's body touches the curve.
    Contact(Follower),
    /// An equation, which has no symbol.
    Written,
}

/// Connection of two wheels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mesh {
    /// External teeth.
    External,
    /// Internal and external teeth.
    Internal,
    /// Open belt.
    Belt,
    /// Crossed belt.
    CrossedBelt,
}

/// Part of a body that touches a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Follower {
    /// The mark itself.
    Point,
    /// A roller of this radius about the mark.
    Roller(ExprId),
    /// The face along the line.
    Face,
}
