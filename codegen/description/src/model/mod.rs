//! Document → Mechanism, one for each of its motions.
//!
//! Afterwards every name is an id, every number an exact expression in SI units, every point a local vector in the frame of
//! its body, and every joint knows its operands. Deliberately unknown here: rows, derivatives, and whether the equations
//! determine the motion.

mod angles;
mod bodies;
mod bounds;
mod call;
mod carriers;
mod choice;
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
mod joints;
mod kinematic;
mod law;
mod lines;
mod linkage;
mod live_direction;
mod live_distance;
mod live_name;
mod loads;
mod marks;
mod motions;
mod namespace;
mod naming;
mod not_finite;
mod operands;
mod parameters;
mod points;
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
mod transmission;
mod units;
mod wanted_forces;
mod weights;

pub use bounds::beyond_bounds;
pub use call::FUNCTIONS;
pub use dimension::{Dimension, unit};
pub use forces::{Forces, Mass};
pub use law::LAWS;
pub use motions::resolve;
pub use naming::Naming;
pub use parameters::field_name;
pub use setting::{follow_points, set};
pub use table::ENDS_OF_TABLES;
pub use teeth::{Bearing, PressureAngle, Teeth, WheelAxis};

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
    /// Its name as written; an identifier in snake case by custom.
    pub name: String,
    /// Which of its motions this is, where it has several.
    pub motion: Option<Motion>,
    /// Documentation lines of the file and of the mechanism.
    pub docs: Vec<String>,
    /// Where the name stands.
    pub span: Span,
    /// What names must be like.
    pub naming: &'static Naming,
    /// The arena of every expression below.
    pub graph: Graph,
    /// The time t, in s.
    pub time: SymbolId,
    /// The values that have a name, in written order.
    pub constants: Vec<Constant>,
    /// What can be changed at run time, in written order.
    pub parameters: Vec<Parameter>,
    /// The signals that are supplied at run time, in written order.
    pub inputs: Vec<Input>,
    /// The tables, in written order.
    pub tables: Vec<Table>,
    /// The bodies; the first is the ground.
    pub bodies: Vec<Body>,
    /// Joints and drivers in written order.
    pub joints: Vec<Joint>,
    /// The declared points whose motion can be asked for, each once.
    pub points: Vec<Point>,
    /// What the generated code is asked for; empty means everything.
    pub requests: Vec<Request>,
    /// What the drivers move and how fast: the quantities of `transmission` statements, each once.
    pub transmissions: Vec<Requested>,
    /// Along which parameters the motion is differentiated: indices into the parameters, each once, as `sensitivity` statements
    /// name them.
    pub sensitivities: Vec<usize>,
    /// What bodies weigh, what acts on them, and which forces are wanted.
    pub forces: Forces,
    /// Whether a `monitor` statement asks how close every loop is to a singular pose.
    pub monitor: bool,
    /// Whether an `unguarded` statement leaves out what shows that frames lie on the path of the last one.
    pub is_unguarded: bool,
    /// Units in which values are printed and written; expressions are in SI units.
    pub units: ReportUnits,
    /// How names are written that are called otherwise.
    pub spellings: Arc<Spellings>,
    /// The largest coordinate of an origin or of a point that a joint holds, in m: what lengths are measured against. Never zero.
    pub characteristic_length: f64,
}

/// A value that has a name.
#[derive(Clone, Debug)]
pub struct Constant {
    /// Its name as written.
    pub name: String,
    /// What it is, of numbers and parameters, in SI units.
    pub value: ExprId,
    /// What it measures.
    pub dimension: Dimension,
    /// Where its name is declared.
    pub span: Span,
}

/// A value that stays changeable at run time.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Name as written.
    pub name: String,
    /// Documentation lines.
    pub docs: Vec<String>,
    /// What stands for it in expressions; the graph knows its default as the symbol's nominal value.
    pub symbol: SymbolId,
    /// Its default, a constant in SI units.
    pub nominal: ExprId,
    /// What it measures.
    pub dimension: Dimension,
    /// Whether a statement mentions it.
    pub used: bool,
    /// Source location of the declaration.
    pub span: Span,
}

/// A signal that is supplied at run time with its rate and acceleration.
#[derive(Clone, Debug)]
pub struct Input {
    /// Name as written.
    pub name: String,
    /// Documentation lines.
    pub docs: Vec<String>,
    /// What stands for its value, its rate and its acceleration in expressions.
    pub symbols: [SymbolId; 3],
    /// Its value at assembly unless another is given, a constant in SI units.
    pub initial: ExprId,
    /// What it does where nobody supplies it, as when a description is interpreted: its value, rate and acceleration as
    /// expressions of t. At rest at its initial value unless it is set.
    pub signal: [ExprId; 3],
    /// What its value measures.
    pub dimension: Dimension,
    /// Whether a statement mentions it.
    pub used: bool,
    /// Source location of the declaration.
    pub span: Span,
}

/// A function through points.
#[derive(Clone, Debug)]
pub struct Table {
    /// Name as written.
    pub name: String,
    /// Documentation lines.
    pub docs: Vec<String>,
    /// Its pieces, in the graph.
    pub spline: SplineId,
    /// What its argument measures.
    pub argument: Dimension,
    /// What its value measures.
    pub value: Dimension,
    /// Whether a statement mentions it.
    pub used: bool,
    /// Source location of the declaration.
    pub span: Span,
}

/// One way in which a mechanism is driven.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Motion {
    /// Its name as written: the name of its generated module.
    pub name: String,
    /// Documentation lines.
    pub docs: Vec<String>,
    /// Source location of the motion.
    pub span: Span,
}

/// A rigid body, or an angle without one.
#[derive(Clone, Debug)]
pub struct Body {
    /// The name as written: an identifier or an integer.
    pub name: String,
    /// Its documentation lines.
    pub docs: Vec<String>,
    /// Where its name is declared.
    pub span: Span,
    /// Its frame in terms of its coordinates; constants for the ground.
    pub frame: BodyFrame,
    /// Its coordinates x, y, φ; none for the ground, and φ alone for an angle.
    pub coordinates: [Option<Coordinate>; 3],
    /// Its estimated pose (x, y, φ) in the drawing.
    pub drawn: BodyFrame,
    /// The points it carries, in written order.
    pub marks: Vec<NamedMark>,
}

/// A coordinate of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Coordinate {
    /// What stands for it in expressions.
    pub symbol: SymbolId,
    /// Its place in q.
    pub place: usize,
}

/// A point as one body carries it.
#[derive(Clone, Debug)]
pub struct NamedMark {
    /// Name as written on the body.
    pub name: String,
    /// Documentation lines.
    pub docs: Vec<String>,
    /// The body's frame and the local vector.
    pub mark: Mark,
    /// Where it is in the drawing, in global components: for a point given there, as it was written.
    pub drawn: Vector,
    /// Where it is declared on the body.
    pub span: Span,
}

/// Whether a joint restricts the mechanism or moves it.
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
    /// What it is.
    pub kind: &'static dyn Kind,
    /// Constraint or driver.
    pub role: Role,
    /// The word `redundant` before it, which allows its rows to repeat what others say.
    pub redundant: Option<Span>,
    /// The name behind its word, where it has one.
    pub name: Option<String>,
    /// How messages name it, as the description does: `revolute P(1, 2)`.
    pub label: String,
    /// What its rows are named after in generated code: `p`, `drive_phi_1`; unique.
    pub slug: String,
    /// Its documentation lines.
    pub docs: Vec<String>,
    /// What it acts on.
    pub operands: Resolved,
    /// The pressure angle of its teeth; `None` where bearings do not carry their force.
    pub pressure_angle: Option<PressureAngle>,
    /// Its statement.
    pub span: Span,
}

/// A point whose motion can be asked for.
#[derive(Clone, Debug)]
pub struct Point {
    /// `K`, or `K_c1` where bodies carry different points of one name.
    pub name: String,
    /// Documentation lines.
    pub docs: Vec<String>,
    /// The first body that carries it.
    pub mark: Mark,
    /// Where it is declared.
    pub span: Span,
}

/// One quantity that an `output` statement asks for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Request {
    /// What is wanted.
    pub quantity: Requested,
    /// Up to which level: 0 position, 1 velocity, 2 acceleration.
    pub level: usize,
}

/// What an `output` or a `transmission` statement can name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Requested {
    /// The motion of a point: an index into the mechanism's points.
    Point(usize),
    /// A coordinate of a body: its place in q.
    Coordinate(usize),
}

impl Mechanism {
    /// How every symbol moves that no equation determines: t by one a second, an input by its rate, which moves by its
    /// acceleration.
    pub fn explicit_rates(&mut self) -> Vec<(SymbolId, ExprId)> {
        let mut rates = vec![(self.time, self.graph.one())];
        for input in &self.inputs {
            let [value, rate, acceleration] = input.symbols;
            rates.push((value, self.graph.variable(rate)));
            rates.push((rate, self.graph.variable(acceleration)));
        }
        rates
    }

    /// Place of its name, or of that of its motion.
    pub fn place(&self) -> Span {
        self.motion.as_ref().map_or(self.span, |motion| motion.span)
    }

    /// How a person names it: `excavator`, and of several motions `excavator, motion reach`.
    pub fn title(&self) -> String {
        match &self.motion {
            Some(motion) => format!("{}, motion {}", self.name, motion.name),
            None => self.name.clone(),
        }
    }

    /// How a person counts what moves: `4 bodies`, `1 body and 2 angles`.
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

    /// The moving bodies, in written order.
    pub fn moving_bodies(&self) -> &[Body] {
        &self.bodies[1..]
    }
}

impl Body {
    /// Its estimated pose as expressions x, y, φ.
    pub fn estimate(&self) -> [ExprId; 3] {
        [self.drawn.origin[0], self.drawn.origin[1], self.drawn.angle]
    }

    /// The places of its coordinates in q: three in a row, one for an angle, none for the ground.
    pub fn places(&self) -> Range<usize> {
        let own = || self.coordinates.iter().flatten();
        match own().next() {
            Some(first) => first.place..first.place + own().count(),
            None => 0..0,
        }
    }

    /// Whether it is an angle and no body.
    pub fn is_angle(&self) -> bool {
        matches!(self.coordinates, [None, _, Some(_)])
    }
}
