//! Operands of a joint or driver → its rows of Φ.
//!
//! One file per kind, and one line in [`CONSTRAINTS`] or [`DRIVERS`]. A kind says how it is written and states its
//! residuals; the Jacobian, Φ_t, γ, the printing and the diagnostics follow from these. Afterwards every row is a scalar
//! expression of the coordinates and t that vanishes when the joint is satisfied.
//!
//! Deliberately unknown here: names, spans, other joints, and everything that happens to a row.

mod absolute_angle;
mod absolute_position;
mod angle_driver;
pub mod geometry;
mod length_driver;
mod revolute;
mod translational;

use crate::expr::{ExprId, Graph};
use geometry::{Mark, Vector};

/// What a statement of a kind must give beside its keyword.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operands {
    /// One body: `absolute_angle(1)`.
    Body,
    /// One point of a body, or a body for its origin: `absolute_x(1.P)`, `absolute_x(1)`.
    Point,
    /// The same named point on two bodies, `P(1, 2)`, or a point of each, `(1.P, 2.Q)`.
    PointPair,
    /// Two bodies and the line on which they slide: `(1, 2) along P -> Q`.
    BodiesAlong,
    /// The two points of the axis of a joint written before: `(P, Q)`.
    AxisOf,
}

/// What a value is measured in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Metres.
    Length,
    /// Radians.
    Angle,
}

/// The operands of one joint, resolved: which fields are filled follows from the kind's [`Operands`].
#[derive(Clone, Debug, PartialEq)]
pub struct Resolved {
    /// The points concerned, in written order; one or two.
    pub marks: Vec<Mark>,
    /// The sliding axis.
    pub axis: Option<Axis>,
    /// The right-hand side.
    pub value: Option<ExprId>,
}

/// The line on which two bodies slide along one another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// Unit vector u from the first mark towards the second, in the frame of the first mark's body.
    pub direction: Vector,
    /// R_i u: the same in global components.
    pub turned: Vector,
    /// The signed distance ℓ from the first mark to the second along u, as an unknown of the vector form.
    pub displacement: ExprId,
    /// φ_i − φ_j in the drawing, which the joint preserves.
    pub relative_angle: ExprId,
}

/// One scalar constraint equation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// The residual, zero when satisfied.
    pub residual: ExprId,
    /// What the residual is measured in.
    pub quantity: Quantity,
    /// Which row of the joint this is: `x`, `angle`, …; empty when it has only one.
    pub component: &'static str,
}

/// A kind of joint or driver.
pub trait Kind: Sync {
    /// The word a statement begins with, or for a driver the driven quantity.
    fn keyword(&self) -> &'static str;
    /// What must stand in the parentheses.
    fn operands(&self) -> Operands;
    /// What stands right of `=`, where something must. A driver's value may depend on t.
    fn value(&self) -> Option<Quantity>;
    /// Statements of this kind as they are written, for help lines.
    fn example(&self) -> &'static str;
    /// Whether the joint keeps its two marks at one place, so that they are one point of the mechanism.
    fn joins_points(&self) -> bool {
        false
    }
    /// The rows of the vector form: as many more as the joint has displacements, and linear in the positions, the turned local
    /// vectors and their products with a displacement. The textbook's rows, where they are that already.
    fn vector_rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
        self.rows(operands, graph)
    }
    /// The rows, in the order of the textbook.
    fn rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row>;
}

impl std::fmt::Debug for dyn Kind {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(self.keyword())
    }
}

/// Every joint, in the order in which help lines list them.
pub static CONSTRAINTS: &[&dyn Kind] = &[
    &revolute::Revolute,
    &translational::Translational,
    &absolute_position::AbsoluteX,
    &absolute_position::AbsoluteY,
    &absolute_angle::AbsoluteAngle,
];

/// Every quantity that a `drive` statement can prescribe.
pub static DRIVERS: &[&dyn Kind] = &[&angle_driver::AngleDriver, &length_driver::LengthDriver];
