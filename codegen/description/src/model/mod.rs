//! Resolves a document into one mechanism for each of its motions, with the pool of its expressions.
//!
//! In a [`Mechanism`], every name is an id, every number an exact expression in SI units, and every point a local vector in its
//! body's frame. Every joint has its operands.

mod angles;
mod bodies;
mod bounds;
mod call;
mod carriers;
mod choice;
mod clearance;
mod contact;
mod curve;
mod declarations;
mod declared;
mod dimension;
mod directive;
mod elements;
mod equation;
mod expression;
mod forces;
mod formulas;
mod free;
mod friction;
mod joints;
mod kinematic;
mod law;
mod limit;
mod lines;
mod linkage;
mod live_direction;
mod live_distance;
mod live_name;
mod loads;
mod marks;
mod measure;
mod measure_angles;
mod measure_drivers;
mod measure_functions;
mod measured_element;
mod measurement;
mod mention;
mod motions;
mod motor;
mod namespace;
mod naming;
mod not_finite;
mod operands;
mod parameters;
mod points;
mod ranges;
mod rates;
mod request;
mod resolve;
mod search;
mod sensitivity;
mod setting;
mod slug;
mod synonyms;
mod table;
mod teeth;
mod tolerance;
mod transmission;
mod units;
mod wanted_forces;
mod weights;

pub use bounds::beyond_bounds;
pub use call::FUNCTIONS;
pub use clearance::Clearance;
pub use dimension::{Dimension, unit};
pub use forces::{Forces, Mass};
pub use friction::{Friction, Surfaces};
pub use law::LAWS;
pub use limit::Limit;
pub use measure_functions::MEASURE_FUNCTIONS;
pub use measurement::{ForceTerm, MeasureTerm, Measurement, ReactionPart};
pub use mention::Mention;
pub use motions::{mentions, resolve};
pub use motor::Motor;
pub use naming::Naming;
pub use parameters::field_name;
pub use ranges::{range_text, si_unit, value_text};
pub use setting::{follow_points, set};
pub use table::ENDS_OF_TABLES;
pub use teeth::{Bearing, PressureAngle, Teeth, WheelAxis};
pub use tolerance::Distribution;

use std::ops::Range;
use std::sync::Arc;

use crate::diagnostic::Span;
use crate::expr::{ExprId, Graph, SplineId, SymbolId};
use crate::joint::geometry::{BodyFrame, Mark, Vector};
use crate::joint::{Kind, Resolved};
use crate::syntax::Spellings;
use crate::units::ReportUnits;

/// A resolved mechanism.
#[derive(Clone, Debug)]
pub struct Mechanism {
    /// Name as written; snake case by convention.
    pub name: String,
    /// The motion, if the description has several; `None` otherwise.
    pub motion: Option<Motion>,
    /// Documentation lines of the file and of the mechanism.
    pub docs: Vec<String>,
    /// Source location of the name.
    pub span: Span,
    /// Rules for names in the target language.
    pub naming: &'static Naming,
    /// Time t, in s.
    pub time: SymbolId,
    /// Named values, in source order.
    pub constants: Vec<Constant>,
    /// Values that can be changed at run time, in source order.
    pub parameters: Vec<Parameter>,
    /// Signals supplied at run time, in source order.
    pub inputs: Vec<Input>,
    /// Tables, in source order.
    pub tables: Vec<Table>,
    /// Bodies; the first is the ground.
    pub bodies: Vec<Body>,
    /// Joints and drivers, in source order.
    pub joints: Vec<Joint>,
    /// Declared points whose motion can be requested, without duplicates.
    pub points: Vec<Point>,
    /// Quantities of `measure` statements, in source order.
    pub measurements: Vec<Measurement>,
    /// Ranges of measures, in source order; at most one for each measure.
    pub limits: Vec<Limit>,
    /// Motors of drivers, in source order.
    pub motors: Vec<Motor>,
    /// Clearances of pins.
    pub clearances: Vec<Clearance>,
    /// Requested outputs; all quantities if empty.
    pub requests: Vec<Request>,
    /// Quantities of `transmission` statements, without duplicates.
    pub transmissions: Vec<Requested>,
    /// Indices of the parameters of `sensitivity` statements, without duplicates: the motion is differentiated with respect to
    /// them.
    pub sensitivities: Vec<usize>,
    /// Masses, loads and requested forces.
    pub forces: Forces,
    /// True if a `monitor` statement requests the distance of every loop from a singular pose.
    pub monitor: bool,
    /// True if an `unguarded` statement omits the verification that frames stay on the path of the previous one.
    pub is_unguarded: bool,
    /// Units of printed and written values; expressions are in SI units.
    pub units: ReportUnits,
    /// Spellings in the source of names that differ from the resolved ones.
    pub spellings: Arc<Spellings>,
    /// Largest coordinate of a body origin or of a point of a joint, in m: the scale of lengths. Never zero.
    pub characteristic_length: f64,
}

/// A named value.
#[derive(Clone, Debug)]
pub struct Constant {
    /// Name as written.
    pub name: String,
    /// Value in numbers and parameters, in SI units.
    pub value: ExprId,
    /// Dimension of the value.
    pub dimension: Dimension,
    /// Source location of the name.
    pub span: Span,
}

/// A value that can be changed at run time.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Name as written.
    pub name: String,
    /// Documentation lines.
    pub docs: Vec<String>,
    /// Symbol in expressions; its nominal value in the graph is the default.
    pub symbol: SymbolId,
    /// Default, a constant in SI units.
    pub nominal: ExprId,
    /// Both ends of its range, in SI units; `None` if it is not limited.
    pub range: Option<[f64; 2]>,
    /// Distribution about the default; `None` without a tolerance.
    pub tolerance: Option<Distribution>,
    /// Dimension of the value.
    pub dimension: Dimension,
    /// True if a statement refers to the parameter.
    pub used: bool,
    /// Source location of the declaration.
    pub span: Span,
}

/// A signal supplied at run time with its rate and acceleration.
#[derive(Clone, Debug)]
pub struct Input {
    /// Name as written.
    pub name: String,
    /// Documentation lines.
    pub docs: Vec<String>,
    /// Symbols of value, rate and acceleration in expressions.
    pub symbols: [SymbolId; 3],
    /// Default value at assembly, a constant in SI units.
    pub initial: ExprId,
    /// Both ends of the range of its values, in SI units; `None` if it is not limited.
    pub range: Option<[f64; 2]>,
    /// Value, rate and acceleration as expressions of t, used where no caller supplies the signal, as in the interpreter.
    /// Constant at the initial value unless set.
    pub signal: [ExprId; 3],
    /// Dimension of the value.
    pub dimension: Dimension,
    /// True if a statement refers to the input.
    pub used: bool,
    /// Source location of the declaration.
    pub span: Span,
}

/// A function interpolated through points.
#[derive(Clone, Debug)]
pub struct Table {
    /// Name as written.
    pub name: String,
    /// Documentation lines.
    pub docs: Vec<String>,
    /// Interpolating spline in the graph.
    pub spline: SplineId,
    /// Dimension of the argument.
    pub argument: Dimension,
    /// Dimension of the value.
    pub value: Dimension,
    /// True if a statement refers to the table.
    pub used: bool,
    /// Source location of the declaration.
    pub span: Span,
}

/// One set of drivers of a mechanism.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Motion {
    /// Name as written, which is also the name of the generated module.
    pub name: String,
    /// Documentation lines.
    pub docs: Vec<String>,
    /// Source location of the motion.
    pub span: Span,
}

/// A rigid body, or an angle without one.
#[derive(Clone, Debug)]
pub struct Body {
    /// Name as written: an identifier or an integer.
    pub name: String,
    /// Documentation lines.
    pub docs: Vec<String>,
    /// Source location of the name.
    pub span: Span,
    /// Frame in terms of the coordinates; constants for the ground.
    pub frame: BodyFrame,
    /// Coordinates x, y, φ; `None` for all of the ground, and for x and y of an angle.
    pub coordinates: [Option<Coordinate>; 3],
    /// Estimated pose (x, y, φ) in the design configuration.
    pub drawn: BodyFrame,
    /// Points on this body, in source order.
    pub marks: Vec<NamedMark>,
}

/// A coordinate of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Coordinate {
    /// Symbol in expressions.
    pub symbol: SymbolId,
    /// Index in q.
    pub place: usize,
}

/// A named point on one body.
#[derive(Clone, Debug)]
pub struct NamedMark {
    /// Name as written on the body.
    pub name: String,
    /// Documentation lines.
    pub docs: Vec<String>,
    /// Body frame and local vector.
    pub mark: Mark,
    /// Global coordinates in the design configuration; exactly as written for a point given in global coordinates.
    pub drawn: Vector,
    /// Source location of the declaration on the body.
    pub span: Span,
}

/// Role of a joint: constraint or driver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Part of Φᴷ.
    Constraint,
    /// Part of Φᴰ.
    Driver,
}

/// A joint or driver of the mechanism.
#[derive(Clone, Debug)]
pub struct Joint {
    /// Kind of joint or driver.
    pub kind: &'static Kind,
    /// Constraint or driver.
    pub role: Role,
    /// Source location of the word `redundant`, which permits dependent rows; `None` without it.
    pub redundant: Option<Span>,
    /// Name after the keyword; `None` if it has none.
    pub name: Option<String>,
    /// Source location of the name; `None` if it has none.
    pub name_span: Option<Span>,
    /// Label in messages: `revolute P(1, 2)`.
    pub label: String,
    /// Stem of its row names in generated code: `p`, `drive_phi_1`; unique.
    pub slug: String,
    /// Documentation lines.
    pub docs: Vec<String>,
    /// Resolved operands.
    pub operands: Resolved,
    /// Pressure angle of the teeth; `None` if bearings do not carry their force.
    pub pressure_angle: Option<PressureAngle>,
    /// Source location of the statement.
    pub span: Span,
}

/// A point whose motion can be requested.
#[derive(Clone, Debug)]
pub struct Point {
    /// `K`, or `K_c1` if bodies have different points of one name.
    pub name: String,
    /// Documentation lines.
    pub docs: Vec<String>,
    /// Location on the first body that has the point.
    pub mark: Mark,
    /// Source location of the declaration.
    pub span: Span,
}

/// One quantity requested by an `output` statement.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Request {
    /// Requested quantity.
    pub quantity: Requested,
    /// Highest level: 0 position, 1 velocity, 2 acceleration.
    pub level: usize,
}

/// Operand of an `output` or `transmission` statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Requested {
    /// Motion of a point: an index into the mechanism's points.
    Point(usize),
    /// Coordinate of a body: its index in q.
    Coordinate(usize),
    /// Measure: an index into the mechanism's measurements.
    Measure(usize),
}

impl Mechanism {
    /// Returns the time derivatives of the symbols that no equation determines. The derivative of t is 1, of an input its rate,
    /// and of the rate its acceleration.
    pub fn explicit_rates(&self, graph: &mut Graph) -> Vec<(SymbolId, ExprId)> {
        let mut rates = vec![(self.time, graph.one())];
        for input in &self.inputs {
            let [value, rate, acceleration] = input.symbols;
            rates.push((value, graph.variable(rate)));
            rates.push((rate, graph.variable(acceleration)));
        }
        rates
    }

    /// Returns the source location of the motion's name, or of the mechanism's without motions.
    pub fn place(&self) -> Span {
        self.motion.as_ref().map_or(self.span, |motion| motion.span)
    }

    /// Returns the title for messages: `excavator`, or `excavator, motion reach` if there are several motions.
    pub fn title(&self) -> String {
        match &self.motion {
            Some(motion) => format!("{}, motion {}", self.name, motion.name),
            None => self.name.clone(),
        }
    }

    /// Returns the number of moving bodies and angles as text: `4 bodies`, `1 body and 2 angles`.
    pub fn body_count_label(&self) -> String {
        let angles = self
            .moving_bodies()
            .iter()
            .filter(|it| it.is_angle())
            .count();
        let counted = |count: usize, one: &str, several: &str| match count {
            1 => format!("1 {one}"),
            _ => format!("{count} {several}"),
        };
        let bodies = counted(self.moving_bodies().len() - angles, "body", "bodies");
        let of_angles = counted(angles, "angle", "angles");
        match (angles, self.moving_bodies().len() - angles) {
            (0, _) => bodies,
            (_, 0) => of_angles,
            _ => format!("{bodies} and {of_angles}"),
        }
    }

    /// Returns the moving bodies, in source order.
    pub fn moving_bodies(&self) -> &[Body] {
        &self.bodies[1..]
    }
}

impl Body {
    /// Returns the estimated pose as expressions x, y, φ.
    pub fn estimate(&self) -> [ExprId; 3] {
        [self.drawn.origin[0], self.drawn.origin[1], self.drawn.angle]
    }

    /// Returns the indices of the coordinates in q: three for a body, one for an angle, none for the ground.
    pub fn places(&self) -> Range<usize> {
        let coordinates = || self.coordinates.iter().flatten();
        match coordinates().next() {
            Some(first) => first.place..first.place + coordinates().count(),
            None => 0..0,
        }
    }

    /// True if this is an angle without a body.
    pub fn is_angle(&self) -> bool {
        matches!(self.coordinates, [None, _, Some(_)])
    }
}
