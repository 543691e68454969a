//! Defines the syntax tree of a description.
//!
//! Every node has its source location. Nothing is resolved or computed. Formulas are in [`super::formula`].

mod constraint;
mod drawn;
mod table;
mod units;
mod wanted;

pub use constraint::{Drive, DrivenForm, Equation, Free, Joint};
pub use drawn::{Body, Curve, DrawnPoint, Member, Orientation, Origin, Points, Shape};
pub use table::{Ends, Table, TablePoints};
pub use units::Units;
pub(super) use wanted::REQUESTS;
pub use wanted::{Operands, OutputItem, Request, RequestKind};

use std::sync::Arc;

use super::forces::{Element, Force, Gravity, Mass, Torque};
use super::formula::{Expression, Name};
use super::friction::Friction;
use super::limit::Limit;
use super::motor::Motor;
use super::scope::{Expansion, Spellings};
use crate::diagnostic::{Attachment, Span};
use crate::units::OutputUnits;

/// A file: inner documentation and a mechanism.
#[derive(Debug, Clone, PartialEq)]
pub struct Document {
    /// Lines of `//!` at the top of the file, without the slashes.
    pub docs: Vec<String>,
    /// Attached files, read as far as possible.
    pub attachments: Vec<Attachment>,
    /// Units of reported values, which override the statements; `None` if the statements decide.
    pub units: Option<OutputUnits>,
    /// Described mechanism, the last of the file, with expanded parts.
    pub mechanism: MechanismItem,
    /// Source spellings of resolved names; shared by all motions.
    pub spellings: Arc<Spellings>,
    /// Names that expanded statements no longer contain.
    pub expansion: Expansion,
}

/// `mechanism NAME { statements }`.
#[derive(Debug, Clone, PartialEq)]
pub struct MechanismItem {
    /// Lines of `///` above the mechanism, and of `//!` at the top of its braces.
    pub docs: Vec<String>,
    /// Name of the mechanism.
    pub name: Name,
    /// Statements in source order.
    pub statements: Vec<Statement>,
    /// From the word `mechanism` to the closing brace.
    pub span: Span,
}

/// A statement of a mechanism.
#[derive(Debug, Clone, PartialEq)]
pub enum Statement {
    /// `const NAME = EXPRESSION;`
    Constant(Constant),
    /// Parameter with a range, in a part whose use gives it another value: a constant in that range.
    Given(Adjustable),
    /// `param NAME = EXPRESSION;`: a constant that can be changed at run time.
    Parameter(Adjustable),
    /// `input NAME = EXPRESSION;`: a signal supplied at run time, with its value at assembly.
    Input(Adjustable),
    /// `table NAME = [(X, Y), (X, Y)];`
    Table(Table),
    /// `point A = (X, Y), B = (X, Y);`
    Points(Points),
    /// `body NAME at (X, Y, ANGLE) { members }`
    Body(Body),
    /// `angle NAME = EXPRESSION;`: an angle without a body, as estimated in the design configuration.
    Angle(Constant),
    /// `revolute P(1, 2);` and all other constraints that are independent of time.
    Joint(Joint),
    /// `drive phi(1) = EXPRESSION;`, `drive K.x = EXPRESSION;`
    Drive(Drive),
    /// `free swing: phi(1) = 0.2 rate 1.5;`
    Free(Free),
    /// `equation [NAME:] EXPRESSION = EXPRESSION;`
    Equation(Equation),
    /// `curve rim(a) on cam = polar RADIUS;`
    Curve(Curve),
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
    /// `measure stroke = distance(A, B);`: a named quantity of the motion.
    Measure(Constant),
    /// `limit stroke from 20mm to 80mm;`: range of a measure.
    Limit(Limit),
    /// `clearance P = 0.05mm;`: radial clearance of a pin.
    Clearance(Constant),
    /// `friction P = 0.1 radius 6mm;`: Coulomb friction in a joint.
    Friction(Friction),
    /// `motor crank gear 50 inertia 2e-5kg*m^2 efficiency 0.8;`: motor of a driver.
    Motor(Motor),
    /// `output K, phi(1);`, `sensitivity L2;`, `reaction P;`, `monitor;`
    Request(Request),
    /// `units mm, deg;`
    Units(Units),
    /// `motion NAME { statements }`
    Motion(Motion),
}

impl MechanismItem {
    /// Returns the motions in source order.
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
    /// Returns the request of this kind; `None` for other statements.
    pub fn request(&self, kind: RequestKind) -> Option<&Request> {
        match self {
            Statement::Request(request) if request.kind == kind => Some(request),
            _ => None,
        }
    }

    /// Returns the location from the first word to the semicolon or the closing brace.
    pub fn span(&self) -> Span {
        match self {
            Statement::Constant(statement)
            | Statement::Angle(statement)
            | Statement::Measure(statement)
            | Statement::Clearance(statement) => statement.span,
            Statement::Given(statement)
            | Statement::Parameter(statement)
            | Statement::Input(statement) => statement.constant.span,
            Statement::Table(statement) => statement.span,
            Statement::Points(statement) => statement.span,
            Statement::Body(statement) => statement.span,
            Statement::Joint(statement) => statement.span,
            Statement::Drive(statement) => statement.span,
            Statement::Free(statement) => statement.drive.span,
            Statement::Equation(statement) => statement.span,
            Statement::Curve(statement) => statement.span,
            Statement::Mass(statement) => statement.span,
            Statement::Gravity(statement) => statement.span,
            Statement::Element(statement) => statement.span,
            Statement::Force(statement) => statement.span,
            Statement::Torque(statement) => statement.span,
            Statement::Limit(statement) => statement.span,
            Statement::Friction(statement) => statement.span,
            Statement::Motor(statement) => statement.span,
            Statement::Request(statement) => statement.span,
            Statement::Units(statement) => statement.span,
            Statement::Motion(statement) => statement.span,
        }
    }
}

/// `motion NAME { statements }`: one set of drivers of the mechanism.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// Lines of `///` above the motion, and of `//!` at the top of its braces.
    pub docs: Vec<String>,
    /// Name of the motion; empty if missing, which has been reported.
    pub name: Name,
    /// Statements in source order, without bodies, points and motions.
    pub statements: Vec<Statement>,
    /// From the word `motion` to the closing brace.
    pub span: Span,
}

/// `const NAME = EXPRESSION;`, and `angle` and `measure` in the same form.
#[derive(Debug, Clone, PartialEq)]
pub struct Constant {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// Name of the constant.
    pub name: Name,
    /// Value of the constant.
    pub value: Expression,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// `param NAME = EXPRESSION from LOW to HIGH tolerance EXTENT;`, and `input` in the same form without a tolerance.
#[derive(Debug, Clone, PartialEq)]
pub struct Adjustable {
    /// Name and value.
    pub constant: Constant,
    /// Both ends of its range; `None` if it is not limited.
    pub range: Option<[Expression; 2]>,
    /// Tolerance; `None` if its value is exact.
    pub tolerance: Option<StatedTolerance>,
}

/// `tolerance EXTENT` or `sigma EXTENT` behind a value.
#[derive(Debug, Clone, PartialEq)]
pub struct StatedTolerance {
    /// True for `sigma`: the extent is the standard deviation of a normal distribution. False for `tolerance`: the largest
    /// distance to both sides.
    pub is_normal: bool,
    /// Extent.
    pub extent: Expression,
}
