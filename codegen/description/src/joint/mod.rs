//! Operands of a joint or driver → its rows of Φ.
//!
//! One file per kind, and one line in [`CONSTRAINTS`] or [`DRIVERS`]. A kind says how it is written and drawn and states its
//! residuals; the Jacobian, Φ_t, γ, the printing and the diagnostics follow from these. Afterwards every row is a scalar
//! expression of the coordinates and t that vanishes when the joint is satisfied.
//!
//! Deliberately unknown here: names, spans, other joints, and everything that happens to a row.

mod absolute_angle;
mod absolute_distance;
mod absolute_position;
mod angle_driver;
mod curve;
mod equation;
mod feature;
mod flat;
mod gear;
pub mod geometry;
mod length_driver;
mod link;
mod operands;
mod pin_on_arm;
mod point_on_curve;
mod point_on_line;
mod position_driver;
mod quantity;
mod rack;
mod relative_angle;
mod relative_distance;
mod relative_position;
mod revolute;
mod roller;
mod translational;
mod weld;

pub use curve::Curve;
pub use feature::{Feature, Follower, Mesh};
pub use operands::{
    Auxiliary, AuxiliaryUnknown, Axis, Drawn, Formula, Line, Operands, Resolved, Slot, Value,
};
pub use quantity::Quantity;

use crate::expr::{ExprId, Graph};
use geometry::{BodyFrame, Vector};

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

/// Where a body touches a curve of another body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// The unit vector along which they press on one another, in global components.
    pub normal: Vector,
    /// The frame of the body that is pushed.
    pub follower: BodyFrame,
    /// The point of that body whose motion the pressure angle is measured against.
    pub place: Vector,
    /// An expression of the curve's parameter that keeps its sign wherever the contact is possible, and what is wrong where
    /// it does not.
    pub fit: Option<(ExprId, &'static str)>,
}

/// Why operands make no joint of a kind.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// What is wrong, as a sentence without a full stop.
    pub problem: String,
    /// What to write instead.
    pub help: String,
}

/// A kind of joint or driver.
pub trait Kind: Sync {
    /// The word a statement begins with, or for a driver the driven quantity.
    fn keyword(&self) -> &'static str;
    /// What must stand in the parentheses.
    fn operands(&self) -> Operands;
    /// What stands right of `=`. A driver's value must, and may depend on t.
    fn value(&self) -> Value;
    /// Statements of this kind as they are written, for help lines.
    fn example(&self) -> &'static str;
    /// What a drawing shows of it; `None` where its operands are not complete.
    fn feature(&self, operands: &Resolved, graph: &mut Graph) -> Option<Feature>;
    /// Whether the joint keeps its two marks at one place, so that they are one point of the mechanism.
    fn joins_points(&self) -> bool {
        false
    }
    /// The joint that says what is left where this row of it, by its component, is not wanted.
    fn without(&self, _component: &str) -> Option<&'static str> {
        None
    }
    /// Whether it speaks of the global origin or axes, so that it means something else where its bodies are drawn elsewhere;
    /// `on_ground` says whether one of them is the ground.
    fn is_global(&self, _on_ground: bool) -> bool {
        false
    }
    /// True if its teeth have a pressure angle that may be written.
    fn has_pressure_angle(&self) -> bool {
        false
    }
    /// The unknowns of its vector form beyond the coordinates.
    fn auxiliaries(&self) -> &'static [Auxiliary] {
        &[]
    }
    /// Why these operands make no joint of this kind, where they do not: a length that is not positive, a ratio that is zero.
    fn refusal(&self, _operands: &Resolved, _graph: &mut Graph) -> Option<Refusal> {
        None
    }
    /// What must be positive for these operands to make a joint of this kind whatever the parameters are, and what it is called.
    fn positive(&self, _operands: &Resolved, _graph: &mut Graph) -> Option<(ExprId, &'static str)> {
        None
    }
    /// The rows of the vector form: as many more as the kind has [auxiliaries](Kind::auxiliaries), and linear in the positions, the
    /// turned vectors and their products with a displacement. The textbook's rows, where they are that already.
    fn vector_rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
        self.rows(operands, graph)
    }
    /// Where the bodies touch, for kinds that let them press on one another along a curve.
    fn contact(&self, _operands: &Resolved, _graph: &mut Graph) -> Option<Contact> {
        None
    }
    /// True if the vector form with its auxiliaries says what is left where the textbook's rows that are `dropped` are not solved.
    fn keeps_vector_rows(&self, dropped: &[bool]) -> bool {
        !dropped.contains(&true)
    }
    /// The kind that states the same along and across an arm of a body that turns about another point, for joints that may be redundant.
    fn on_arm(&self) -> Option<&'static dyn Kind> {
        None
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
    &absolute_distance::AbsoluteDistance,
    &relative_position::RelativeX,
    &relative_position::RelativeY,
    &relative_angle::RelativeAngle,
    &relative_distance::RelativeDistance,
    &relative_distance::RevoluteRevolute,
    &point_on_line::RevoluteTranslational,
    &point_on_line::PointOnLine,
    &weld::Weld,
    &gear::EXTERNAL_GEAR,
    &gear::INTERNAL_GEAR,
    &gear::BELT,
    &gear::CROSSED_BELT,
    &rack::Rack,
    &point_on_curve::PointOnCurve,
    &roller::Roller,
    &flat::Flat,
];

/// The equation that a description writes out.
pub static EQUATION: &dyn Kind = &equation::Equation;

/// Every quantity that a `drive` statement can prescribe.
pub static DRIVERS: &[&dyn Kind] = &[
    &angle_driver::AngleDriver,
    &length_driver::LengthDriver,
    &position_driver::XDriver,
    &position_driver::YDriver,
    &relative_position::RelativeX,
    &relative_position::RelativeY,
    &relative_angle::RelativeAngle,
    &relative_distance::DistanceDriver,
];
