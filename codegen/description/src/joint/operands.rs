//! Defines the written form of operands and their resolved values.

use super::curve::Curve;
use super::geometry::{BodyFrame, Mark, Vector, dot, perpendicular, subtract};
use super::{Kind, Quantity};
use crate::expr::{ExprId, Graph, SymbolId};

/// Operands of a kind: the slots in the parentheses, and the line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Operands {
    /// Slots in the parentheses, in order.
    pub slots: &'static [Slot],
    /// Line of the statement.
    pub line: Line,
}

/// One operand in the parentheses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slot {
    /// A body, for its frame: `1`.
    Body,
    /// A body or an angle, for its orientation: `1`.
    Turning,
    /// A body, for its point at the other operand in the design configuration: `1`.
    Counterpart,
    /// A point of a body, or a body for its origin: `1.P`, `1`.
    Point,
    /// A point of a body, or a body for its point with the joint's name: `P(1, …)`, `(1.P, …)`.
    Pin,
    /// A global point, fixed to the ground: `A`.
    GroundPoint,
    /// The name of a curve, for the frame of its body: `rim`.
    Curve,
    /// An optional body at the end of the list; the ground if omitted.
    Carrier,
}

/// Line of a statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Line {
    /// No line.
    None,
    /// `along P -> Q`, with P on the first body and Q on the second.
    Between,
    /// `along P -> Q`, with both points on the body of this operand.
    On(usize),
    /// The two operands name the line of an earlier joint: `(P, Q)`.
    Existing,
}

impl Line {
    /// Returns the indices of the operands whose bodies have the ends of the line.
    pub fn owners(self) -> [usize; 2] {
        match self {
            Line::On(owner) => [owner; 2],
            Line::None | Line::Between | Line::Existing => [0, 1],
        }
    }
}

impl Operands {
    /// One body or angle: `absolute_angle(1)`.
    pub const ANGLE: Operands = Operands::of(&[Slot::Turning]);
    /// One point of a body, or a body for its origin: `absolute_x(1.P)`, `absolute_x(1)`.
    pub const POINT: Operands = Operands::of(&[Slot::Point]);
    /// A point of each of two bodies, or bodies for their origins: `relative_x(1.P, 2)`.
    pub const POINTS: Operands = Operands::of(&[Slot::Point, Slot::Point]);
    /// A point name on two bodies, `P(1, 2)`, or a point of each, `(1.P, 2.Q)`.
    pub const PINS: Operands = Operands::of(&[Slot::Pin, Slot::Pin]);
    /// Two bodies or angles: `(1, 2)`.
    pub const ANGLES: Operands = Operands::of(&[Slot::Turning, Slot::Turning]);
    /// Two bodies that rotate on a third one, or on the ground: `(1, 2, 3)`, `(1, 2)`.
    pub const BODIES_ON_CARRIER: Operands = Operands::of(&[Slot::Body, Slot::Body, Slot::Carrier]);
    /// Two bodies and the line on which they slide: `(1, 2) along P -> Q`.
    pub const BODIES_ALONG: Operands = Operands {
        slots: &[Slot::Body, Slot::Body],
        line: Line::Between,
    };
    /// A point of a body and a line of another: `(2.Q, 1) along P -> R`.
    pub const POINT_ON_LINE: Operands = Operands {
        slots: &[Slot::Point, Slot::Body],
        line: Line::On(1),
    };
    /// A point of a body and a curve of another: `(2.P, rim)`.
    pub const POINT_AND_CURVE: Operands = Operands::of(&[Slot::Point, Slot::Curve]);
    /// A body, a curve of another, and the face of the body that touches it: `(2, rim) along A -> B`.
    pub const FACE_AND_CURVE: Operands = Operands {
        slots: &[Slot::Body, Slot::Curve],
        line: Line::On(0),
    };
    /// The two points of the line of an earlier joint: `(P, Q)`.
    pub const LINE_OF_JOINT: Operands = Operands {
        slots: &[Slot::Point, Slot::Point],
        line: Line::Existing,
    };

    /// Creates operands without a line.
    pub const fn of(slots: &'static [Slot]) -> Operands {
        Operands {
            slots,
            line: Line::None,
        }
    }

    /// Returns the minimum number of operands.
    pub fn fewest(&self) -> usize {
        let needed = |slot: &&Slot| **slot != Slot::Carrier;
        self.slots.iter().filter(needed).count()
    }

    /// True if `along P -> Q` is required after the parentheses.
    pub fn is_along(&self) -> bool {
        matches!(self.line, Line::Between | Line::On(_))
    }
}

/// Value after `=`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Value {
    /// Not permitted.
    None,
    /// Required, of this quantity.
    Required(Quantity),
    /// Optional, of this quantity; the default follows from the design configuration.
    OrAsDrawn(Quantity),
}

impl Value {
    /// Returns the quantity of the value; `None` if a value is not permitted.
    pub fn quantity(self) -> Option<Quantity> {
        match self {
            Value::None => None,
            Value::Required(quantity) | Value::OrAsDrawn(quantity) => Some(quantity),
        }
    }
}

/// An unknown of a vector form beyond the coordinates, absent from the textbook formulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Auxiliary {
    /// Signed distance ℓ, in m, from the mark on the body of the line to the other mark, along the line.
    Displacement,
    /// Offset of the other mark to the left of the line, in m.
    Offset,
    /// Distance ℓ, in m, from the first mark to the second.
    Distance,
    /// Angle φ, in rad, of the direction from the first mark to the second, as of a link without a body.
    LinkAngle,
}

impl Auxiliary {
    /// Returns the quantity of the unknown.
    pub fn quantity(self) -> Quantity {
        match self {
            Auxiliary::Displacement | Auxiliary::Offset | Auxiliary::Distance => Quantity::Length,
            Auxiliary::LinkAngle => Quantity::Angle,
        }
    }
}

/// Resolved operands of one joint. The kind's [`Operands`] determine which fields are set.
#[derive(Clone, Debug, PartialEq)]
pub struct Resolved {
    /// Points of the joint, one per slot. If the line lies on a body, the mark of that body is the start of the line.
    pub marks: Vec<Mark>,
    /// Each mark in the design configuration.
    pub drawn: Vec<Drawn>,
    /// Line; `None` for kinds without a line.
    pub axis: Option<Axis>,
    /// Touched curve; `None` for kinds without a curve.
    pub curve: Option<Curve>,
    /// Value after `=`; `None` if it follows from the design configuration.
    pub value: Option<ExprId>,
    /// Unknowns of the vector form, in the order of the kind. If the operands name the line of another joint, the unknowns of
    /// that joint.
    pub auxiliaries: Vec<AuxiliaryUnknown>,
    /// Formula of an equation of the description; `None` for other kinds.
    pub formula: Option<Formula>,
}

impl Resolved {
    /// Returns the length of a rod; `None` for other joints.
    pub fn length(&self) -> Option<ExprId> {
        self.formula.as_ref().and(self.value)
    }
}

/// An equation of the description, with both sides on the left.
#[derive(Clone, Debug, PartialEq)]
pub struct Formula {
    /// Residual in coordinates, t and the symbols of `arms`.
    pub residual: ExprId,
    /// For each mark, the symbols of the components of its rotated local vector R s; `None` if they do not occur.
    pub arms: Vec<Option<[SymbolId; 2]>>,
    /// Quantity of the residual.
    pub quantity: Quantity,
}

/// A mark in the design configuration, as constants.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drawn {
    /// Frame in which the mark is fixed.
    pub frame: BodyFrame,
    /// Global position, in m.
    pub position: Vector,
}

/// Line of a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// Index of the mark at which the line begins, and to whose body it is fixed.
    pub owner: usize,
    /// Index of the mark of the other body.
    pub other: usize,
    /// Unit vector u along the line, in the frame of its body.
    pub direction: Vector,
    /// R u: the unit vector in global components.
    pub turned: Vector,
    /// Angle of the line's body relative to the other body, in the design configuration.
    pub relative_angle: ExprId,
}

/// An auxiliary unknown of one joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AuxiliaryUnknown {
    /// Kind of the unknown.
    pub kind: Auxiliary,
    /// Symbol of the unknown.
    pub value: ExprId,
    /// Unit vector (cos φ, sin φ) of a link angle φ; zero for other unknowns.
    pub turned: Vector,
}

impl AuxiliaryUnknown {
    /// Creates symbols for the auxiliary unknowns of the joint with this number.
    pub fn of(kind: &Kind, joint: usize, graph: &mut Graph) -> Vec<AuxiliaryUnknown> {
        let unknown = |(number, &kind): (usize, &Auxiliary)| {
            // The name begins with a digit, so it differs from all coordinates.
            let name = match number {
                0 => format!("{joint} displacement"),
                _ => format!("{joint} displacement {number}"),
            };
            let symbol = graph.symbol(&name);
            let value = graph.variable(symbol);
            let turned = match kind {
                Auxiliary::LinkAngle => [graph.cos(value), graph.sin(value)],
                Auxiliary::Displacement | Auxiliary::Offset | Auxiliary::Distance => {
                    [graph.zero(); 2]
                }
            };
            AuxiliaryUnknown {
                kind,
                value,
                turned,
            }
        };
        kind.auxiliaries.iter().enumerate().map(unknown).collect()
    }
}

impl Resolved {
    /// Returns the position of the other mark along the line in the design configuration; `None` without a line.
    pub fn along_in_drawing(&self, graph: &mut Graph) -> Option<ExprId> {
        let (direction, gap) = self.line_in_drawing(graph)?;
        Some(dot(direction, gap, graph))
    }

    /// Returns the offset of the other mark to the left of the line in the design configuration; `None` without a line.
    pub fn across_in_drawing(&self, graph: &mut Graph) -> Option<ExprId> {
        let (direction, gap) = self.line_in_drawing(graph)?;
        let across = perpendicular(direction, graph);
        Some(dot(across, gap, graph))
    }

    /// Returns the line's direction and the vector to the other mark in the design configuration; `None` without a line.
    fn line_in_drawing(&self, graph: &mut Graph) -> Option<(Vector, Vector)> {
        let axis = self.axis?;
        let [line, other] = [axis.owner, axis.other].map(|side| self.drawn[side]);
        let direction = line.frame.rotate(axis.direction, graph);
        Some((direction, subtract(other.position, line.position, graph)))
    }

    /// Returns the vector from the first mark to the second in the design configuration.
    pub fn drawn_gap(&self, graph: &mut Graph) -> Vector {
        subtract(self.drawn[1].position, self.drawn[0].position, graph)
    }

    /// Returns the line, the mark at its start, and the other mark; `None` without a line.
    pub fn along(&self) -> Option<(Axis, Mark, Mark)> {
        let axis = self.axis?;
        Some((axis, self.marks[axis.owner], self.marks[axis.other]))
    }
}
