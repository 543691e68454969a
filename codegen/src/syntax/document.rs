//! *What was written, as written.* The tree of a description: every node has its place, nothing is resolved or computed.
//!
//! The tree does not know joint kinds, quantities, functions or units. Its formulas are those of [`super::formula`].

use super::forces::{Element, Force, Gravity, Mass, Reaction, Torque};
use super::formula::{Direction, Expression, Name, Pair, Reference};
use super::scope::Spellings;
use crate::diagnostic::{Attachment, Span};

/// A file: its inner documentation and its mechanism.
#[derive(Debug, Clone, PartialEq)]
pub struct Document {
    /// The `//!` lines at the top of the file, without the slashes.
    pub docs: Vec<String>,
    /// The files that it names, as far as they could be read.
    pub attachments: Vec<Attachment>,
    /// The mechanism that the file describes, its last one; its parts are written out.
    pub mechanism: MechanismItem,
    /// How names are written that are called otherwise.
    pub spellings: Spellings,
}

/// `mechanism NAME { statements }`.
#[derive(Debug, Clone, PartialEq)]
pub struct MechanismItem {
    /// The `///` lines above it, and the `//!` lines at the top of its braces.
    pub docs: Vec<String>,
    /// Its name.
    pub name: Name,
    /// The statements in written order.
    pub statements: Vec<Statement>,
    /// From the word `mechanism` to the closing brace.
    pub span: Span,
}

/// One statement of a mechanism.
#[derive(Debug, Clone, PartialEq)]
pub enum Statement {
    /// `const NAME = EXPRESSION;`
    Constant(Constant),
    /// `param NAME = EXPRESSION;`: a constant that can be changed at run time.
    Parameter(Constant),
    /// `input NAME = EXPRESSION;`: a signal that is supplied at run time, with its value at assembly.
    Input(Constant),
    /// `table NAME = [(X, Y), (X, Y)];`
    Table(Table),
    /// `point A = (X, Y), B = (X, Y);`
    Points(Points),
    /// `body NAME at (X, Y, ANGLE) { members }`
    Body(Body),
    /// `angle NAME = EXPRESSION;`: an angle that needs no body, as drawn.
    Angle(Constant),
    /// `revolute P(1, 2);` and every other constraint that does not depend on time.
    Joint(Joint),
    /// `drive phi(1) = EXPRESSION;`, `drive K.x = EXPRESSION;`
    Drive(Drive),
    /// `free swing: phi(1) = 0.2 rate 1.5;`
    Free(Free),
    /// `equation [NAME:] EXPRESSION = EXPRESSION;`
    Equation(Equation),
    /// `curve rim(a) on cam = polar RADIUS;`
    Curve(Curve),
    /// `output K, phi(1);`
    Output(Output),
    /// `transmission K, phi(1);`
    Transmission(Transmission),
    /// `sensitivity L2, L3;`
    Sensitivity(Sensitivity),
    /// `mass crank = 2kg;`
    Mass(Mass),
    /// `gravity = (0, -9.81);`
    Gravity(Gravity),
    /// `spring (1.P, 2.Q) = STIFFNESS;`, `damper (1.P, 2.Q) = DAMPING;`
    Element(Element),
    /// `force on 1.P = (X, Y);`
    Force(Force),
    /// `torque on 1 = VALUE;`
    Torque(Torque),
    /// `reaction P;`
    Reaction(Reaction),
    /// `monitor;`, `unguarded;`, `effort;`, `reactions;`, `least_norm;`, `energy;`
    Wish(Wish),
    /// `motion NAME { statements }`
    Motion(Motion),
}

impl MechanismItem {
    /// The motions in written order.
    pub fn motions(&self) -> impl Iterator<Item = &Motion> {
        self.statements
            .iter()
            .filter_map(|statement| match statement {
                Statement::Motion(motion) => Some(motion),
                _ => None,
            })
    }
}

impl Statement {
    /// Its place, from the first word to the semicolon or the closing brace.
    pub fn span(&self) -> Span {
        match self {
            Statement::Constant(statement)
            | Statement::Parameter(statement)
            | Statement::Input(statement)
            | Statement::Angle(statement) => statement.span,
            Statement::Table(statement) => statement.span,
            Statement::Points(statement) => statement.span,
            Statement::Body(statement) => statement.span,
            Statement::Joint(statement) => statement.span,
            Statement::Drive(statement) => statement.span,
            Statement::Free(statement) => statement.drive.span,
            Statement::Equation(statement) => statement.span,
            Statement::Curve(statement) => statement.span,
            Statement::Output(statement) => statement.span,
            Statement::Transmission(statement) => statement.span,
            Statement::Sensitivity(statement) => statement.span,
            Statement::Mass(statement) => statement.span,
            Statement::Gravity(statement) => statement.span,
            Statement::Element(statement) => statement.span,
            Statement::Force(statement) => statement.span,
            Statement::Torque(statement) => statement.span,
            Statement::Reaction(statement) => statement.span,
            Statement::Wish(statement) => statement.span,
            Statement::Motion(statement) => statement.span,
        }
    }
}

/// `motion NAME { statements }`: one of several ways in which the mechanism is driven.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// The `///` lines above it, and the `//!` lines at the top of its braces.
    pub docs: Vec<String>,
    /// Its name; empty where it is missing, which has been reported.
    pub name: Name,
    /// The statements in written order: no bodies, no points and no motions.
    pub statements: Vec<Statement>,
    /// From the word `motion` to the closing brace.
    pub span: Span,
}

/// `const NAME = EXPRESSION;`, and `param`, `input` and `angle` in the same form.
#[derive(Debug, Clone, PartialEq)]
pub struct Constant {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// Its name.
    pub name: Name,
    /// Its value.
    pub value: Expression,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// `table NAME = [(X, Y), (X, Y)] ENDS;` or `table NAME = "FILE" columns (X, Y) in (UNIT, UNIT) ENDS;`: a function that goes through these points.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// Its name.
    pub name: Name,
    /// Its points.
    pub points: TablePoints,
    /// Where these are written.
    pub place: Span,
    /// How it ends, where that is written.
    pub ends: Option<Ends>,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// Where the points of a table are.
#[derive(Debug, Clone, PartialEq)]
pub enum TablePoints {
    /// `[(X, Y), (X, Y)]`: here, in written order.
    Listed(Vec<Pair>),
    /// `"FILE" columns (X, Y) in (UNIT, UNIT)`: in a file.
    InFile {
        /// The path between the quotes.
        path: Name,
        /// The columns, by their names or their numbers from 1, where they are chosen.
        columns: Option<[Name; 2]>,
        /// The units of both columns, where they are written; whether such units exist is not checked here.
        units: Option<[Name; 2]>,
    },
}

/// `periodic`, `clamped(SLOPE, SLOPE)`: how a table ends.
#[derive(Debug, Clone, PartialEq)]
pub struct Ends {
    /// The word; whether it has a meaning is not checked here.
    pub word: Name,
    /// What stands in the parentheses.
    pub slopes: Vec<Expression>,
    /// Both.
    pub span: Span,
}

/// `point A = (X, Y), B = (X, Y);`: points in the global frame, as drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Points {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// The points in written order; at least one.
    pub points: Vec<DrawnPoint>,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// One point of a `point` statement.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnPoint {
    /// Its name.
    pub name: Name,
    /// Its global position as drawn.
    pub position: Pair,
}

/// `curve NAME(s) on BODY = (X, Y);`: a curve fixed in the frame of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// Its name.
    pub name: Name,
    /// What runs along it.
    pub parameter: Name,
    /// From where to where it is drawn, where that is written: `(s from 0 to 200mm)`.
    pub range: Option<[Expression; 2]>,
    /// The body that carries it.
    pub body: Name,
    /// Its points.
    pub shape: Shape,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// The points of a curve in terms of its parameter.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// `(X, Y)` in the frame of the body.
    Parametric(Pair),
    /// `polar RADIUS`: the parameter is the angle around the origin of the frame.
    Polar(Expression),
}

/// `body NAME at … { members }`.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// An identifier or an integer.
    pub name: Name,
    /// Where the body's frame is estimated to be.
    pub origin: Origin,
    /// How the body's frame is estimated to be turned.
    pub orientation: Orientation,
    /// The points it carries, in written order.
    pub members: Vec<Member>,
    /// The whole statement.
    pub span: Span,
}

/// The place of a body's frame.
#[derive(Debug, Clone, PartialEq)]
pub enum Origin {
    /// `at (X, Y)`, or the first two of `at (X, Y, ANGLE)`.
    Coordinates(Pair),
    /// `at P`.
    Point(Reference),
}

/// The angle of a body's frame.
#[derive(Debug, Clone, PartialEq)]
pub enum Orientation {
    /// Nothing written: parallel to the global frame.
    Aligned,
    /// `at (X, Y, ANGLE)` or `turned ANGLE`.
    Angle(Expression),
    /// `facing A -> B`: the x axis points from `A` to `B` as drawn.
    Facing(Direction),
}

/// A point of a body.
#[derive(Debug, Clone, PartialEq)]
pub enum Member {
    /// `P: (X, Y)`, in the body's frame.
    Local {
        /// The `///` lines above it.
        docs: Vec<String>,
        /// Its name.
        name: Name,
        /// Its position in the body's frame.
        position: Pair,
    },
    /// `A`: the body carries the point drawn globally under this name.
    Carried {
        /// The `///` lines above it.
        docs: Vec<String>,
        /// The name of the drawn point.
        name: Name,
    },
}

/// `[redundant] KIND NAME? (OPERANDS) [along REFERENCE -> REFERENCE] [= EXPRESSION];`
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// The word `redundant`, where it is written.
    pub redundant: Option<Span>,
    /// The word it starts with; whether such a kind exists is not checked here.
    pub kind: Name,
    /// The joint's own name, which for some kinds is that of a point.
    pub name: Option<Name>,
    /// What stands in the parentheses.
    pub operands: Vec<Reference>,
    /// The direction after `along`.
    pub along: Option<Direction>,
    /// The value after `=`.
    pub value: Option<Expression>,
    /// Where the part that it comes from is given a place.
    pub placed: Option<Span>,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// `drive [NAME:] QUANTITY(OPERANDS) = EXPRESSION;`, `drive [NAME:] POINT.COORDINATE = EXPRESSION;` or `drive [NAME:] ANGLE = EXPRESSION;`
#[derive(Debug, Clone, PartialEq)]
pub struct Drive {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// The driver's own name.
    pub name: Option<Name>,
    /// The driven quantity; whether such a quantity exists is not checked here. `phi` at the place of an angle that is named alone.
    pub quantity: Name,
    /// What stands in the parentheses, or before the coordinate, or alone.
    pub operands: Vec<Reference>,
    /// How both are written.
    pub form: DrivenForm,
    /// The prescribed motion, an expression of `t`.
    pub value: Expression,
    /// Where the part that it comes from is given a place.
    pub placed: Option<Span>,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// How a driven quantity is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DrivenForm {
    /// `phi(BODY)`
    Called,
    /// `K.x`
    Dotted,
    /// `ANGLE`
    Bare,
}

/// `free NAME: QUANTITY(OPERANDS) = START [rate RATE];`: a quantity that forces move.
#[derive(Debug, Clone, PartialEq)]
pub struct Free {
    /// Its own name.
    pub name: Name,
    /// What would drive it: its value is where the quantity starts.
    pub drive: Drive,
    /// How fast it starts, where that is written.
    pub rate: Option<Expression>,
}

/// `[redundant] equation [NAME:] EXPRESSION = EXPRESSION;`
#[derive(Debug, Clone, PartialEq)]
pub struct Equation {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// The word `redundant`, where it is written.
    pub redundant: Option<Span>,
    /// The equation's own name.
    pub name: Option<Name>,
    /// What stands left of `=`.
    pub left: Expression,
    /// What stands right of `=`.
    pub right: Expression,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// `output velocity K, phi(1);`: what the generated code is asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct Output {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// Up to which level, if not all: one of [`LEVELS`](super::LEVELS).
    pub level: Option<Name>,
    /// What is wanted; at least one.
    pub items: Vec<OutputItem>,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// `transmission K, phi(1);`: what the drivers move, and how fast.
#[derive(Debug, Clone, PartialEq)]
pub struct Transmission {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// What is moved; at least one.
    pub items: Vec<OutputItem>,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// `sensitivity L2, L3;`: the parameters along which the motion is differentiated.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensitivity {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// The parameters; at least one.
    pub names: Vec<Name>,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// A statement of one word.
#[derive(Debug, Clone, PartialEq)]
pub struct Wish {
    /// What is wished.
    pub kind: WishKind,
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// What a statement of one word wishes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WishKind {
    /// `monitor`: every frame says how close the mechanism is to a singular pose.
    Monitor,
    /// `unguarded`: no frame is shown to lie on the path of the last one.
    Unguarded,
    /// `effort`: every frame says what the drivers exert.
    Effort,
    /// `reactions`: every frame says what every joint carries.
    Reactions,
    /// `least_norm`: where joints repeat one another, they carry what is smallest.
    LeastNorm,
    /// `energy`: every frame says how much work is stored.
    Energy,
}

/// One wanted quantity.
#[derive(Debug, Clone, PartialEq)]
pub enum OutputItem {
    /// The motion of a point.
    Point(Reference),
    /// `phi(1)`: a coordinate of a body.
    Coordinate {
        /// `x`, `y` or `phi`, as far as the parser knows any word.
        axis: Name,
        /// What stands in the parentheses: one body, if it is right.
        bodies: Vec<Reference>,
        /// The whole item.
        span: Span,
    },
}
