//! How the operands of a kind are written, and what they are once resolved.

use super::curve::Curve;
use super::geometry::{BodyFrame, Mark, Vector, dot, perpendicular, subtract};
use super::{Kind, Quantity};
use crate::expr::{ExprId, Graph, SymbolId};

/// What a statement of a kind must give beside its keyword: what stands in the parentheses, and its line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Operands {
    /// What stands in the parentheses, in order.
    pub slots: &'static [Slot],
    /// The line that the statement names.
    pub line: Line,
}

/// One operand in the parentheses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slot {
    /// A body, for its frame: `1`.
    Body,
    /// A body or an angle, for how it is turned: `1`.
    Turning,
    /// A body, for the point of it that lies in the drawing where the other operand is: `1`.
    Counterpart,
    /// A point of a body, or a body for its origin: `1.P`, `1`.
    Point,
    /// A point of a body, or a body for its point of the joint's name: `P(1, …)`, `(1.P, …)`.
    Pin,
    /// A point of the drawing, fixed to the ground: `A`.
    GroundPoint,
    /// A curve by its name, for the frame of the body that carries it: `rim`.
    Curve,
    /// A body at the end of the list that need not be written; the ground where it is not.
    Carrier,
}

/// The line that a statement names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Line {
    /// None.
    None,
    /// `along P -> Q`, with P on the first body and Q on the second.
    Between,
    /// `along P -> Q`, with both points on the body of this operand.
    On(usize),
    /// The two operands name the line of a joint written before: `(P, Q)`.
    Existing,
}

impl Operands {
    /// One body or angle: `absolute_angle(1)`.
    pub const ANGLE: Operands = Operands::of(&[Slot::Turning]);
    /// One point of a body, or a body for its origin: `absolute_x(1.P)`, `absolute_x(1)`.
    pub const POINT: Operands = Operands::of(&[Slot::Point]);
    /// A point of each of two bodies, or bodies for their origins: `relative_x(1.P, 2)`.
    pub const POINTS: Operands = Operands::of(&[Slot::Point, Slot::Point]);
    /// The same named point on two bodies, `P(1, 2)`, or a point of each, `(1.P, 2.Q)`.
    pub const PINS: Operands = Operands::of(&[Slot::Pin, Slot::Pin]);
    /// Two bodies or angles: `(1, 2)`.
    pub const ANGLES: Operands = Operands::of(&[Slot::Turning, Slot::Turning]);
    /// Two bodies that turn on a third one, or on the ground: `(1, 2, 3)`, `(1, 2)`.
    pub const BODIES_ON_CARRIER: Operands = Operands::of(&[Slot::Body, Slot::Body, Slot::Carrier]);
    /// Two bodies and the line on which they slide: `(1, 2) along P -> Q`.
    pub const BODIES_ALONG: Operands = Operands {
        slots: &[Slot::Body, Slot::Body],
        line: Line::Between,
    };
    /// A point of a body and a curve of another: `(2.P, rim)`.
    pub const POINT_AND_CURVE: Operands = Operands::of(&[Slot::Point, Slot::Curve]);
    /// A body, a curve of another, and the face of the body that touches it: `(2, rim) along A -> B`.
    pub const FACE_AND_CURVE: Operands = Operands {
        slots: &[Slot::Body, Slot::Curve],
        line: Line::On(0),
    };
    /// The two points of the line of a joint written before: `(P, Q)`.
    pub const LINE_OF_JOINT: Operands = Operands {
        slots: &[Slot::Point, Slot::Point],
        line: Line::Existing,
    };

    /// Operands without a line.
    pub const fn of(slots: &'static [Slot]) -> Operands {
        Operands {
            slots,
            line: Line::None,
        }
    }

    /// How many operands must be written at least.
    pub fn fewest(&self) -> usize {
        let needed = |slot: &&Slot| **slot != Slot::Carrier;
        self.slots.iter().filter(needed).count()
    }

    /// Whether `along P -> Q` must stand behind the parentheses.
    pub fn is_along(&self) -> bool {
        matches!(self.line, Line::Between | Line::On(_))
    }
}

/// What stands right of `=`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Value {
    /// Nothing may.
    None,
    /// A value of this quantity must.
    Required(Quantity),
    /// A value of this quantity may; where it does not, the drawing says it.
    OrAsDrawn(Quantity),
}

impl Value {
    /// What a value is measured in, where there may be one.
    pub fn quantity(self) -> Option<Quantity> {
        match self {
            Value::None => None,
            Value::Required(quantity) | Value::OrAsDrawn(quantity) => Some(quantity),
        }
    }
}

/// An unknown that a vector form has beyond the coordinates; no equation of the textbook knows it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Auxiliary {
    /// The signed distance ℓ, in m, from the mark on the body of the line to the other mark, along the line.
    Displacement,
    /// How far the other mark lies to the left of the line, in m.
    Offset,
    /// The distance ℓ, in m, from the first mark to the second.
    Distance,
    /// The angle ψ, in rad, of the direction from the first mark to the second: that of a link without a body of its own.
    LinkAngle,
}

impl Auxiliary {
    /// What it is measured in.
    pub fn quantity(self) -> Quantity {
        match self {
            Auxiliary::Displacement | Auxiliary::Offset | Auxiliary::Distance => Quantity::Length,
            Auxiliary::LinkAngle => Quantity::Angle,
        }
    }
}

/// The operands of one joint, resolved: which fields are filled follows from the kind's [`Operands`].
#[derive(Clone, Debug, PartialEq)]
pub struct Resolved {
    /// The points concerned, one per slot; where the line lies on a body, that body's is the point at which it begins.
    pub marks: Vec<Mark>,
    /// Each of the marks in the drawing.
    pub drawn: Vec<Drawn>,
    /// The line.
    pub axis: Option<Axis>,
    /// The curve that is touched.
    pub curve: Option<Curve>,
    /// The right-hand side; `None` where it was left to the drawing.
    pub value: Option<ExprId>,
    /// The unknowns of the vector form, as the kind lists them; those of the joint whose line this is, where it names one.
    pub auxiliaries: Vec<AuxiliaryUnknown>,
    /// The formula of an equation that the description writes out.
    pub formula: Option<Formula>,
}

impl Resolved {
    /// The length of a rod that an equation holds.
    pub fn length(&self) -> Option<ExprId> {
        self.formula.as_ref().and(self.value)
    }
}

/// An equation as a description writes it, with both sides on the left.
#[derive(Clone, Debug, PartialEq)]
pub struct Formula {
    /// The residual, of coordinates, t and the symbols of `arms`.
    pub residual: ExprId,
    /// For each of the marks the symbols that stand for the components of its arm R s; `None` where nothing mentions the arm.
    pub arms: Vec<Option<[SymbolId; 2]>>,
    /// What the residual is measured in.
    pub quantity: Quantity,
}

/// A mark in the drawing: constants.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drawn {
    /// The frame it is fixed in.
    pub frame: BodyFrame,
    /// Where it is, in m.
    pub position: Vector,
}

/// The line that a joint is along.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// The mark that the line is fixed with and begins at: an index.
    pub owner: usize,
    /// The mark of the other body: an index.
    pub other: usize,
    /// Unit vector u along the line, in the frame of its body.
    pub direction: Vector,
    /// R u: the same in global components.
    pub turned: Vector,
    /// The angle of the line's body less that of the other body, in the drawing.
    pub relative_angle: ExprId,
}

/// An auxiliary unknown of one joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AuxiliaryUnknown {
    /// Which it is.
    pub kind: Auxiliary,
    /// The unknown itself.
    pub value: ExprId,
    /// For a link angle ψ the unit vector (cos ψ, sin ψ), otherwise zero.
    pub turned: Vector,
}

impl AuxiliaryUnknown {
    /// Symbols for the unknowns that the vector form of the joint with this number has beyond the coordinates.
    pub fn of(kind: &dyn Kind, joint: usize, graph: &mut Graph) -> Vec<AuxiliaryUnknown> {
        let unknown = |(number, &kind): (usize, &Auxiliary)| {
            // No coordinate can have such a name: it begins with a digit.
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
        kind.auxiliaries().iter().enumerate().map(unknown).collect()
    }
}

impl Resolved {
    /// How far the other mark lies along the line in the drawing.
    pub fn along_in_drawing(&self, graph: &mut Graph) -> Option<ExprId> {
        let (direction, gap) = self.line_in_drawing(graph)?;
        Some(dot(direction, gap, graph))
    }

    /// How far the other mark lies to the left of the line in the drawing.
    pub fn across_in_drawing(&self, graph: &mut Graph) -> Option<ExprId> {
        let (direction, gap) = self.line_in_drawing(graph)?;
        let across = perpendicular(direction, graph);
        Some(dot(across, gap, graph))
    }

    /// The line's direction in the drawing, and the vector to the other mark.
    fn line_in_drawing(&self, graph: &mut Graph) -> Option<(Vector, Vector)> {
        let axis = self.axis?;
        let [line, other] = [axis.owner, axis.other].map(|side| self.drawn[side]);
        let direction = line.frame.rotate(axis.direction, graph);
        Some((direction, subtract(other.position, line.position, graph)))
    }

    /// The vector from the first mark to the second in the drawing.
    pub fn drawn_gap(&self, graph: &mut Graph) -> Vector {
        subtract(self.drawn[1].position, self.drawn[0].position, graph)
    }

    /// The line, the mark that it is fixed with, and the other one.
    pub fn along(&self) -> Option<(Axis, Mark, Mark)> {
        let axis = self.axis?;
        Some((axis, self.marks[axis.owner], self.marks[axis.other]))
    }
}
