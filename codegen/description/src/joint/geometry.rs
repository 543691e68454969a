//! Computes global vectors of frames and marked points.
//!
//! A body's frame has the origin r = (x, y) and the rotation matrix R(φ); a mark is a point fixed in it. All vectors are pairs
//! of expressions, either symbols or constants, so the ground is a frame like any other.

use crate::expr::{ExprId, Graph};

/// Index of a body; the ground is body 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct BodyId(pub usize);

impl BodyId {
    /// Ground, the fixed body.
    pub const GROUND: BodyId = BodyId(0);
}

/// Components along x and y.
pub type Vector = [ExprId; 2];

/// Frame of one body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyFrame {
    /// Body of the frame.
    pub body: BodyId,
    /// Origin, in m.
    pub origin: Vector,
    /// Angle in rad, counterclockwise from the global x axis.
    pub angle: ExprId,
}

/// A point fixed in a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mark {
    /// Frame in which the point is fixed.
    pub frame: BodyFrame,
    /// Coordinates in that frame, in m.
    pub local: Vector,
    /// R s: the local vector in global components.
    pub arm: Vector,
}

impl BodyFrame {
    /// Returns R(φ) v: a vector of this frame in global components.
    pub fn rotate(&self, v: Vector, graph: &mut Graph) -> Vector {
        let (sine, cosine) = (graph.sin(self.angle), graph.cos(self.angle));
        tidied(turned(cosine, sine, v, graph), graph)
    }

    /// Returns Rᵀ(φ) v: a global vector in the components of this frame.
    pub fn unrotate(&self, v: Vector, graph: &mut Graph) -> Vector {
        let opposite = BodyFrame {
            angle: graph.negate(self.angle),
            ..*self
        };
        opposite.rotate(v, graph)
    }
}

impl Mark {
    /// Creates the point with these coordinates in a frame.
    pub fn new(frame: BodyFrame, local: Vector, graph: &mut Graph) -> Mark {
        let arm = frame.rotate(local, graph);
        Mark { frame, local, arm }
    }

    /// Returns r + R s: the global position.
    pub fn position(&self, graph: &mut Graph) -> Vector {
        add(self.frame.origin, self.arm, graph)
    }
}

/// Rotates `v` by the angle with this cosine and sine.
pub fn turned(cosine: ExprId, sine: ExprId, v: Vector, graph: &mut Graph) -> Vector {
    let [c0, s1] = [graph.multiply(cosine, v[0]), graph.multiply(sine, v[1])];
    let [s0, c1] = [graph.multiply(sine, v[0]), graph.multiply(cosine, v[1])];
    [graph.subtract(c0, s1), graph.add(s0, c1)]
}

/// Returns a + b.
pub fn add(a: Vector, b: Vector, graph: &mut Graph) -> Vector {
    [graph.add(a[0], b[0]), graph.add(a[1], b[1])]
}

/// Returns a − b.
pub fn subtract(a: Vector, b: Vector, graph: &mut Graph) -> Vector {
    [graph.subtract(a[0], b[0]), graph.subtract(a[1], b[1])]
}

/// Returns `a` with constant components in their shortest form.
pub fn tidied(a: Vector, graph: &mut Graph) -> Vector {
    a.map(|component| graph.tidied(component))
}

/// Returns |a|.
pub fn length(a: Vector, graph: &mut Graph) -> ExprId {
    let square = dot(a, a, graph);
    let square = graph.tidied(square);
    graph.sqrt(square)
}

/// Returns a · b.
pub fn dot(a: Vector, b: Vector, graph: &mut Graph) -> ExprId {
    let [first, second] = [graph.multiply(a[0], b[0]), graph.multiply(a[1], b[1])];
    graph.add(first, second)
}

/// Returns `a` rotated counterclockwise by a right angle.
pub fn perpendicular(a: Vector, graph: &mut Graph) -> Vector {
    [graph.negate(a[1]), a[0]]
}

/// Returns (R_i u)ᵀ (r_j + R_j s_j − r_i) − uᵀ s_i: the component of the vector from mark i to mark j along the unit vector
/// `direction` u of frame i. `turned` is R_i u.
///
/// The local vector s_i needs no rotation, since s_i and u are fixed in the same frame.
pub fn offset_along(
    direction: Vector,
    turned: Vector,
    i: &Mark,
    j: &Mark,
    graph: &mut Graph,
) -> ExprId {
    let target = j.position(graph);
    let reach = subtract(target, i.frame.origin, graph);
    let along = dot(turned, reach, graph);
    let start = dot(direction, i.local, graph);
    let start = graph.tidied(start);
    graph.subtract(along, start)
}
