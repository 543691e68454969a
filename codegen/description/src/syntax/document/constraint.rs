//! Defines the syntax of joints, drivers, `free` and `equation`.

use crate::diagnostic::Span;
use crate::syntax::formula::{Direction, Expression, Name, Reference};

/// `[redundant] KIND NAME? (OPERANDS) [along REFERENCE -> REFERENCE] [= EXPRESSION [pressure_angle EXPRESSION]];`
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// Location of the word `redundant`; `None` if it is not written.
    pub redundant: Option<Span>,
    /// First word of the statement, not checked against the known kinds.
    pub kind: Name,
    /// Name of the joint, which for some kinds is that of a point; `None` if not written.
    pub name: Option<Name>,
    /// Operands in the parentheses.
    pub operands: Vec<Reference>,
    /// Direction after `along`; `None` if not written.
    pub along: Option<Direction>,
    /// Value after `=`; `None` if not written.
    pub value: Option<Expression>,
    /// Pressure angle after `pressure_angle`, for any kind; `None` if not written.
    pub pressure_angle: Option<Expression>,
    /// Location where the part of this joint is placed; `None` outside parts.
    pub placed: Option<Span>,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// `drive [NAME:] QUANTITY(OPERANDS) = EXPRESSION;`, `drive [NAME:] POINT.COORDINATE = EXPRESSION;` or `drive [NAME:] ANGLE = EXPRESSION;`
#[derive(Debug, Clone, PartialEq)]
pub struct Drive {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// Name of the driver; `None` if not written.
    pub name: Option<Name>,
    /// Driven quantity, not checked against the known quantities. It is `phi` for an angle that is written alone.
    pub quantity: Name,
    /// Operands: in the parentheses, before the coordinate, or alone.
    pub operands: Vec<Reference>,
    /// Notation of the quantity and its operands.
    pub form: DrivenForm,
    /// Prescribed motion, an expression of `t`.
    pub value: Expression,
    /// Location where the part of this driver is placed; `None` outside parts.
    pub placed: Option<Span>,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// Notation of a driven quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DrivenForm {
    /// Call: `phi(BODY)`.
    Called,
    /// Coordinate: `K.x`.
    Dotted,
    /// Name alone: `ANGLE`.
    Bare,
}

/// `free NAME: QUANTITY(OPERANDS) = START [rate RATE];`: a quantity that forces move.
#[derive(Debug, Clone, PartialEq)]
pub struct Free {
    /// Name of the free coordinate.
    pub name: Name,
    /// Equivalent driver; its value is the initial value.
    pub drive: Drive,
    /// Initial rate; `None` if not written.
    pub rate: Option<Expression>,
}

/// `[redundant] equation [NAME:] EXPRESSION = EXPRESSION;`
#[derive(Debug, Clone, PartialEq)]
pub struct Equation {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// Location of the word `redundant`; `None` if it is not written.
    pub redundant: Option<Span>,
    /// Name of the equation; `None` if not written.
    pub name: Option<Name>,
    /// Left side.
    pub left: Expression,
    /// Right side.
    pub right: Expression,
    /// The whole statement with its semicolon.
    pub span: Span,
}
