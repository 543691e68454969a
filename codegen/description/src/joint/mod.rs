//! Defines the kinds of joints and drivers with their rows of Φ.
//!
//! Each kind is one file and one line in [`CONSTRAINTS`] or [`DRIVERS`]. A kind defines its syntax, its symbol and its
//! residuals. The Jacobian, Φ_t, γ, the printing and the diagnostics follow from these. Every row is a scalar expression of the
//! coordinates and t that vanishes if the joint is satisfied.

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
    /// Residual, zero if the row is satisfied.
    pub residual: ExprId,
    /// Quantity of the residual.
    pub quantity: Quantity,
    /// Name of the row within the joint: `x`, `angle`, …; empty for a single row.
    pub component: &'static str,
}

/// Contact of a body with a curve of another body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Unit vector of the contact force, in global components.
    pub normal: Vector,
    /// Frame of the follower.
    pub follower: BodyFrame,
    /// Point of the follower whose velocity defines the pressure angle.
    pub place: Vector,
    /// Expression of the curve's parameter that keeps its sign wherever contact is possible, and the fault otherwise. `None` if
    /// contact is always possible.
    pub fit: Option<(ExprId, &'static str)>,
}

/// Reason why operands are invalid for a kind.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// Fault, as a sentence without a full stop.
    pub problem: String,
    /// Remedy.
    pub help: String,
}

/// A kind of joint or driver.
pub trait Kind: Sync {
    /// Returns the keyword of the statement, or for a driver the driven quantity.
    fn keyword(&self) -> &'static str;
    /// Returns the form of the operands.
    fn operands(&self) -> Operands;
    /// Returns the form of the value after `=`. A driver requires a value, which may depend on t.
    fn value(&self) -> Value;
    /// Returns example statements for help lines.
    fn example(&self) -> &'static str;
    /// Returns the symbol in pictures; `None` if operands are missing.
    fn feature(&self, operands: &Resolved, graph: &mut Graph) -> Option<Feature>;
    /// True if the joint keeps its two marks coincident, so that they are one point of the mechanism.
    fn joins_points(&self) -> bool {
        false
    }
    /// Returns the keyword of the joint that remains without the row of this component; `None` if there is none.
    fn without(&self, _component: &str) -> Option<&'static str> {
        None
    }
    /// True if the joint refers to the global origin or axes, so that moving its bodies in the design configuration changes its
    /// meaning. `on_ground` is true if one of the bodies is the ground.
    fn is_global(&self, _on_ground: bool) -> bool {
        false
    }
    /// True if a pressure angle of its teeth may be written.
    fn has_pressure_angle(&self) -> bool {
        false
    }
    /// Returns the auxiliary unknowns of the vector form.
    fn auxiliaries(&self) -> &'static [Auxiliary] {
        &[]
    }
    /// Checks the operands: returns, for example, the refusal of a length that is not positive or of a ratio that is zero;
    /// `None` if they are valid.
    fn refusal(&self, _operands: &Resolved, _graph: &mut Graph) -> Option<Refusal> {
        None
    }
    /// Returns an expression that must be positive for all values of the parameters, and its name; `None` without such a
    /// condition.
    fn positive(&self, _operands: &Resolved, _graph: &mut Graph) -> Option<(ExprId, &'static str)> {
        None
    }
    /// Returns the rows of the vector form: the textbook's number of rows plus that of the [auxiliaries](Kind::auxiliaries).
    /// The rows are linear in positions, rotated local vectors and their products with a displacement. Textbook rows of this
    /// form are returned unchanged.
    fn vector_rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
        self.rows(operands, graph)
    }
    /// Returns the contact of a kind whose bodies touch along a curve; `None` for other kinds.
    fn contact(&self, _operands: &Resolved, _graph: &mut Graph) -> Option<Contact> {
        None
    }
    /// True if the vector form with its auxiliaries remains equivalent to the textbook's rows without the `dropped` ones.
    fn keeps_vector_rows(&self, dropped: &[bool]) -> bool {
        !dropped.contains(&true)
    }
    /// Returns the equivalent kind along and across the line from a body's pivot to the joint, for joints that may be
    /// redundant; `None` if there is none.
    fn on_arm(&self) -> Option<&'static dyn Kind> {
        None
    }
    /// Returns the rows, in the order of the textbook.
    fn rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row>;
}

impl std::fmt::Debug for dyn Kind {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(self.keyword())
    }
}

/// All kinds of joints, in the order of help lines.
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

/// Equation written by a description.
pub static EQUATION: &dyn Kind = &equation::Equation;

/// All quantities of `drive` statements.
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
