//! Joints, drivers, `free` and `equation`, as written: what restricts a motion or gives it.

use crate::diagnostic::Span;
use crate::syntax::formula::{Direction, Expression, Name, Reference};

/// `[redundant] KIND NAME? (OPERANDS) [along REFERENCE -> REFERENCE] [= EXPRESSION [pressure_angle EXPRESSION]];`
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
    /// The pressure angle of teeth, after `pressure_angle`; whether the kind has teeth is not checked here.
    pub pressure_angle: Option<Expression>,
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
