//! Parses masses and loads: `mass 1 = 2kg at S inertia 0.03;`, `gravity = (0, -9.81);`, `spring (1.P, 2.Q) = 4530
//! free 78mm;`, `force on 1.P = (0, -20N);`.
//!
//! Names of points are not resolved.

use proc_macro2::Delimiter;

use super::document::Statement;
use super::expression::{coordinates, expression};
use super::formula::{Expression, Name, Pair, Reference};
use super::reader::Outcome;
use super::reference::{body_name, identifier, operands, reference};
use super::statement::{equals, semicolon};
use super::tokens::Tokens;
use crate::diagnostic::Span;

/// `mass BODY = MASS [at PLACE] [inertia MOMENT];`
#[derive(Debug, Clone, PartialEq)]
pub struct Mass {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// Body with this mass.
    pub body: Name,
    /// Mass.
    pub mass: Expression,
    /// Center of mass; `None` if it is the origin of the body's frame.
    pub center: Option<Center>,
    /// Moment of inertia about the center of mass; `None` if not given.
    pub inertia: Option<Expression>,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// A center of mass.
#[derive(Debug, Clone, PartialEq)]
pub enum Center {
    /// A point of the body.
    Point(Name),
    /// `(X, Y)` in the body's frame.
    Local(Pair),
}

/// `gravity = (X, Y);`
#[derive(Debug, Clone, PartialEq)]
pub struct Gravity {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// Acceleration of free fall.
    pub acceleration: Pair,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// Kind of an element: it stores or dissipates energy.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ElementKind {
    /// `spring`.
    Spring,
    /// `damper`.
    Damper,
}

/// `spring [NAME](POINT, POINT) = STIFFNESS [free LENGTH] [preload FORCE];`, `spring [NAME] about (BODY, BODY) = …`, and `damper`
/// in the same form without a free length and a preload.
#[derive(Debug, Clone, PartialEq)]
pub struct Element {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// Spring or damper.
    pub kind: ElementKind,
    /// Name of the element; `None` if it has none.
    pub name: Option<Name>,
    /// Location of the word `about` of a rotational element; `None` for a translational one.
    pub about: Option<Span>,
    /// Operands in the parentheses.
    pub operands: Vec<Reference>,
    /// Stiffness of a spring, or coefficient of a damper.
    pub value: Expression,
    /// Free length or angle of a spring; `None` if not written.
    pub free: Option<Expression>,
    /// Force or torque at the free length or angle; `None` if not written.
    pub preload: Option<Expression>,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// `force on BODY.POINT = (X, Y) [in BODY];`
#[derive(Debug, Clone, PartialEq)]
pub struct Force {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// Point of application.
    pub point: Reference,
    /// Components of the force.
    pub components: Pair,
    /// Body whose frame has these components; `None` for the global frame.
    pub frame: Option<Name>,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// `torque on BODY = VALUE;`
#[derive(Debug, Clone, PartialEq)]
pub struct Torque {
    /// The `///` lines above it.
    pub docs: Vec<String>,
    /// Body on which the torque acts.
    pub body: Name,
    /// Torque, positive counterclockwise.
    pub value: Expression,
    /// The whole statement with its semicolon.
    pub span: Span,
}

/// Parses a `mass` statement after its first word.
pub(super) fn mass(tokens: &mut Tokens<'_>, docs: Vec<String>, start: Span) -> Outcome<Statement> {
    let body = body_name(tokens, "the name of a body")?;
    equals(tokens)?;
    let mass = expression(tokens)?;
    let center = match tokens.keyword("at") {
        None => None,
        Some(_) if tokens.peek_group(Delimiter::Parenthesis) => {
            Some(Center::Local(coordinates(tokens, 2)?.0))
        }
        Some(_) => Some(Center::Point(identifier(
            tokens,
            "a point of the body or `(X, Y)`",
        )?)),
    };
    let inertia = valued(tokens, "inertia")?;
    let span = start.to(semicolon(tokens, start)?);
    Ok(Statement::Mass(Mass {
        docs,
        body,
        mass,
        center,
        inertia,
        span,
    }))
}

/// Parses a `gravity` statement after its first word.
pub(super) fn gravity(
    tokens: &mut Tokens<'_>,
    docs: Vec<String>,
    start: Span,
) -> Outcome<Statement> {
    equals(tokens)?;
    let (acceleration, _) = coordinates(tokens, 2)?;
    let span = start.to(semicolon(tokens, start)?);
    Ok(Statement::Gravity(Gravity {
        docs,
        acceleration,
        span,
    }))
}

const SPRING: &str = "a spring has its free length, then its preload behind its stiffness: `spring (1.P, 2.Q) = 4kN/m free 20cm preload 5N;`";

/// Parses a `spring` or `damper` statement after its first word.
pub(super) fn element(
    tokens: &mut Tokens<'_>,
    docs: Vec<String>,
    kind: ElementKind,
    start: Span,
) -> Outcome<Statement> {
    let mut about = tokens.keyword("about");
    let mut name = None;
    if about.is_none() && !tokens.peek_group(Delimiter::Parenthesis) {
        name = Some(identifier(tokens, "a name, `about` or `(`")?);
        about = tokens.keyword("about");
    }
    let operands = operands(tokens)?;
    equals(tokens)?;
    let value = expression(tokens)?;
    let (free, preload) = match kind {
        ElementKind::Spring => (valued(tokens, "free")?, valued(tokens, "preload")?),
        ElementKind::Damper => (None, None),
    };
    if kind == ElementKind::Spring && tokens.peek_word().is_some() {
        return Err(tokens.unexpected("`free`, `preload` or `;`", SPRING));
    }
    let span = start.to(semicolon(tokens, start)?);
    Ok(Statement::Element(Element {
        docs,
        kind,
        name,
        about,
        operands,
        value,
        free,
        preload,
        span,
    }))
}

/// Parses a `force` statement after its first word.
pub(super) fn force(tokens: &mut Tokens<'_>, docs: Vec<String>, start: Span) -> Outcome<Statement> {
    on(tokens, "a force acts on a point: `force on 1.P = (X, Y);`")?;
    let point = reference(tokens, "a point of a body")?;
    equals(tokens)?;
    let (components, _) = coordinates(tokens, 2)?;
    let frame = match tokens.keyword("in") {
        Some(_) => Some(body_name(tokens, "the name of a body")?),
        None => None,
    };
    let span = start.to(semicolon(tokens, start)?);
    Ok(Statement::Force(Force {
        docs,
        point,
        components,
        frame,
        span,
    }))
}

/// Parses a `torque` statement after its first word.
pub(super) fn torque(
    tokens: &mut Tokens<'_>,
    docs: Vec<String>,
    start: Span,
) -> Outcome<Statement> {
    on(tokens, "a torque acts on a body: `torque on 1 = 5Nm;`")?;
    let body = body_name(tokens, "the name of a body")?;
    equals(tokens)?;
    let value = expression(tokens)?;
    let span = start.to(semicolon(tokens, start)?);
    Ok(Statement::Torque(Torque {
        docs,
        body,
        value,
        span,
    }))
}

/// Parses the expression after a keyword; `None` if the keyword is not written.
pub(super) fn valued(tokens: &mut Tokens<'_>, word: &str) -> Outcome<Option<Expression>> {
    match tokens.keyword(word) {
        Some(_) => expression(tokens).map(Some),
        None => Ok(None),
    }
}

fn on(tokens: &mut Tokens<'_>, help: &str) -> Outcome<()> {
    match tokens.keyword("on") {
        Some(_) => Ok(()),
        None => Err(tokens.unexpected("`on`", help)),
    }
}
