//! *What was written, as written.* The tree of a description: every node has its place, nothing is resolved or computed.
//!
//! The tree does not know joint kinds, quantities, functions or units. Its formulas are those of [`super::formula`].

mod constraint;
mod drawn;
mod table;
mod units;
mod wanted;

pub use constraint::{Drive, DrivenForm, Equation, Free, Joint};
pub use drawn::{Body, Curve, DrawnPoint, Member, Orientation, Origin, Points, Shape};
pub use table::{Ends, Table, TablePoints};
pub use units::Units;
pub use wanted::{Directive, DirectiveKind, Output, OutputItem, Sensitivity, Transmission};

use std::sync::Arc;

use super::forces::{Element, Force, Gravity, Mass, Reaction, Torque};
use super::formula::{Expression, Name};
use super::scope::Spellings;
use crate::diagnostic::{Attachment, Span};
use crate::units::OutputUnits;

/// A file: its inner documentation and its mechanism.
#[derive(Debug, Clone, PartialEq)]
pub struct Document {
    /// The `//!` lines at the top of the file, without the slashes.
    pub docs: Vec<String>,
    /// The files that it names, as far as they could be read.
    pub attachments: Vec<Attachment>,
    /// Units in which values are reported, whatever the statements say; `None` if these decide.
    pub units: Option<OutputUnits>,
    /// The mechanism that the file describes, its last one; its parts are written out.
    pub mechanism: MechanismItem,
    /// How names are written that are called otherwise; shared by all motions.
    pub spellings: Arc<Spellings>,
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
    Directive(Directive),
    /// `units mm, deg;`
    Units(Units),
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
            Statement::Directive(statement) => statement.span,
            Statement::Units(statement) => statement.span,
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
