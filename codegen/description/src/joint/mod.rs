//! Defines the kinds of joints and drivers with their rows of Φ.
//!
//! Each kind is one value and one line in [`CONSTRAINTS`] or [`DRIVERS`]. A kind defines its syntax, its symbol and its
//! residuals. The Jacobian, Φ_t, γ, the printing and the diagnostics follow from these. Every row is a scalar expression of the
//! coordinates and t that vanishes if the joint is satisfied.

mod absolute_angle;
mod absolute_distance;
mod absolute_position;
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

impl Row {
    /// Creates the row of a length in m.
    fn length(residual: ExprId, component: &'static str) -> Row {
        Row {
            residual,
            quantity: Quantity::Length,
            component,
        }
    }

    /// Creates the rows of both components of a gap in m.
    fn gap([x, y]: Vector) -> Vec<Row> {
        vec![Row::length(x, "x"), Row::length(y, "y")]
    }
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
pub struct Kind {
    /// Keyword of the statement, or for a driver the driven quantity.
    pub keyword: &'static str,
    /// Form of the operands.
    pub operands: Operands,
    /// Form of the value after `=`. A driver requires a value, which may depend on t.
    pub value: Value,
    /// Example statements for help lines.
    pub example: &'static str,
    /// True if the joint keeps its two marks coincident, so that they are one point of the mechanism.
    pub joins_points: bool,
    /// True if a pressure angle of its teeth may be written.
    pub has_pressure_angle: bool,
    /// Auxiliary unknowns of the vector form.
    pub auxiliaries: &'static [Auxiliary],
    /// Equivalent kind along and across the line from a body's pivot to the joint, for joints that may be redundant; `None` if
    /// there is none.
    pub on_arm: Option<&'static Kind>,
    /// Components of rows, each with the example of the joint that remains without the row.
    remainders: &'static [(&'static str, &'static str)],
    /// Global reference, by whether one of the bodies is the ground.
    is_global: fn(bool) -> bool,
    feature: Derived<Option<Feature>>,
    refusal: Derived<Option<Refusal>>,
    positive: Derived<Option<(ExprId, &'static str)>>,
    contact: Derived<Option<Contact>>,
    keeps_vector_rows: fn(&[bool]) -> bool,
    rows: Derived<Vec<Row>>,
    vector_rows: Option<Derived<Vec<Row>>>,
}

/// Derivation from resolved operands.
type Derived<T> = fn(&Resolved, &mut Graph) -> T;

impl Kind {
    /// Kind without operands and rows, for the fields that a kind does not state.
    const UNSET: Kind = Kind {
        keyword: "",
        operands: Operands::of(&[]),
        value: Value::None,
        example: "",
        joins_points: false,
        has_pressure_angle: false,
        auxiliaries: &[],
        on_arm: None,
        remainders: &[],
        is_global: |_| false,
        feature: |_, _| None,
        refusal: |_, _| None,
        positive: |_, _| None,
        contact: |_, _| None,
        keeps_vector_rows: |dropped| !dropped.contains(&true),
        rows: |_, _| Vec::new(),
        vector_rows: None,
    };

    /// Returns the symbol in pictures; `None` if operands are missing.
    pub fn feature(&self, operands: &Resolved, graph: &mut Graph) -> Option<Feature> {
        (self.feature)(operands, graph)
    }

    /// Returns an example of the joint that remains without the row of this component; `None` if there is none.
    pub fn without(&self, component: &str) -> Option<&'static str> {
        let mut remainders = self.remainders.iter();
        remainders.find(|it| it.0 == component).map(|it| it.1)
    }

    /// True if the joint refers to the global origin or axes, so that moving its bodies in the design configuration changes its
    /// meaning. `on_ground` is true if one of the bodies is the ground.
    pub fn is_global(&self, on_ground: bool) -> bool {
        (self.is_global)(on_ground)
    }

    /// Checks the operands: returns, for example, the refusal of a length that is not positive or of a ratio that is zero;
    /// `None` if they are valid.
    pub fn refusal(&self, operands: &Resolved, graph: &mut Graph) -> Option<Refusal> {
        (self.refusal)(operands, graph)
    }

    /// Returns an expression that must be positive for all values of the parameters, and its name; `None` without such a
    /// condition.
    pub fn positive(
        &self,
        operands: &Resolved,
        graph: &mut Graph,
    ) -> Option<(ExprId, &'static str)> {
        (self.positive)(operands, graph)
    }

    /// Returns the contact of a kind whose bodies touch along a curve; `None` for other kinds.
    pub fn contact(&self, operands: &Resolved, graph: &mut Graph) -> Option<Contact> {
        (self.contact)(operands, graph)
    }

    /// Returns the rows, in the order of the textbook.
    pub fn rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
        (self.rows)(operands, graph)
    }

    /// Returns the rows of the vector form: the textbook's number of rows plus that of the [auxiliaries](Kind::auxiliaries).
    /// The rows are linear in positions, rotated local vectors and their products with a displacement. Textbook rows of this
    /// form are returned unchanged.
    pub fn vector_rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
        self.vector_rows.unwrap_or(self.rows)(operands, graph)
    }

    /// True if the vector form with its auxiliaries remains equivalent to the textbook's rows without the `dropped` ones.
    pub fn keeps_vector_rows(&self, dropped: &[bool]) -> bool {
        (self.keeps_vector_rows)(dropped)
    }
}

impl std::fmt::Debug for Kind {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(self.keyword)
    }
}

/// All kinds of joints, in the order of help lines.
pub static CONSTRAINTS: &[&Kind] = &[
    &revolute::REVOLUTE,
    &translational::TRANSLATIONAL,
    &absolute_position::ABSOLUTE_X,
    &absolute_position::ABSOLUTE_Y,
    &absolute_angle::ABSOLUTE_ANGLE,
    &absolute_distance::ABSOLUTE_DISTANCE,
    &relative_position::RELATIVE_X,
    &relative_position::RELATIVE_Y,
    &relative_angle::RELATIVE_ANGLE,
    &relative_distance::RELATIVE_DISTANCE,
    &relative_distance::REVOLUTE_REVOLUTE,
    &point_on_line::REVOLUTE_TRANSLATIONAL,
    &point_on_line::POINT_ON_LINE,
    &weld::WELD,
    &gear::EXTERNAL_GEAR,
    &gear::INTERNAL_GEAR,
    &gear::BELT,
    &gear::CROSSED_BELT,
    &rack::RACK,
    &point_on_curve::POINT_ON_CURVE,
    &roller::ROLLER,
    &flat::FLAT,
];

/// Equation written by a description.
pub static EQUATION: &Kind = &equation::EQUATION;

/// All quantities of `drive` statements.
pub static DRIVERS: &[&Kind] = &[
    &absolute_angle::ANGLE_DRIVER,
    &length_driver::LENGTH_DRIVER,
    &absolute_position::X_DRIVER,
    &absolute_position::Y_DRIVER,
    &relative_position::RELATIVE_X,
    &relative_position::RELATIVE_Y,
    &relative_angle::RELATIVE_ANGLE,
    &relative_distance::DISTANCE_DRIVER,
];
