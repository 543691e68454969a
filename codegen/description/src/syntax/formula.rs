//! Represents formulas of a description, with the names and points that they mention.
//!
//! A chain of `+ -` or of `* /` is one node, so a sum of a thousand terms is flat. [`MAX_DEPTH`](super::MAX_DEPTH) bounds the
//! depth, so recursive walks are safe. Quantities, functions and units are not resolved.

use crate::diagnostic::Span;

/// An identifier, or the integer that names a body.
#[derive(Debug, Clone, PartialEq)]
pub struct Name {
    /// Characters as written.
    pub text: String,
    /// Source location.
    pub span: Span,
}

/// `(X, Y)`.
#[derive(Debug, Clone, PartialEq)]
pub struct Pair {
    /// First component.
    pub x: Expression,
    /// Second component.
    pub y: Expression,
    /// From the opening to the closing parenthesis.
    pub span: Span,
}

/// `NAME` or `BODY.NAME`.
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    /// Body before the dot; `None` without a dot.
    pub body: Option<Name>,
    /// Body, point or constant.
    pub name: Name,
    /// Location of both with the dot.
    pub span: Span,
}

/// `A -> B`.
#[derive(Debug, Clone, PartialEq)]
pub struct Direction {
    /// Start of the arrow.
    pub from: Reference,
    /// End of the arrow.
    pub to: Reference,
    /// Location of both with the arrow.
    pub span: Span,
}

/// A formula.
#[derive(Debug, Clone, PartialEq)]
pub struct Expression {
    /// Kind and operands.
    pub kind: ExpressionKind,
    /// Source location, including any parentheses around the formula.
    pub span: Span,
}

/// Kind of a formula, with its operands.
#[derive(Debug, Clone, PartialEq)]
pub enum ExpressionKind {
    /// `30deg`: a decimal literal such as `12`, `0.05` or `1e-3`, and its unit.
    Number {
        /// ASCII digits with at most one point and one exponent, without `_`, as `f64` and exact decimals parse them.
        digits: String,
        /// Suffix; not checked against the known units. `None` if there is none.
        unit: Option<Name>,
    },
    /// A constant, a point, a body's point or a point's component.
    Reference(Reference),
    /// `BODY.POINT.COMPONENT`
    Component(Box<Component>),
    /// Two or more terms; the first has the sign `Plus` (a leading minus is a [`ExpressionKind::Negative`] term).
    Sum(Vec<(Sign, Expression)>),
    /// Two or more factors; the first has the operation `Times`.
    Product(Vec<(Operation, Expression)>),
    /// `-x`, which is weaker than a power: `-x^2` is the negative of `x^2`.
    Negative(Box<Expression>),
    /// `base ^ exponent`, grouped from the right.
    Power(Box<Expression>, Box<Expression>),
    /// `function(arguments)`.
    Call {
        /// Name before the parentheses, not checked against the known functions.
        function: Name,
        /// Arguments in source order.
        arguments: Vec<Expression>,
    },
    /// `(x, y)` or `(x, y, z)`, as an argument of a call only.
    Components(Vec<Expression>),
    /// `if left < right { holds } else { otherwise }`.
    Choice(Box<Choice>),
}

/// `if left < right { holds } else { otherwise }`; `else if` is a choice in `otherwise`.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    /// Left side of the comparison.
    pub left: Expression,
    /// Comparison operator.
    pub comparison: Comparison,
    /// Right side of the comparison.
    pub right: Expression,
    /// Value if the comparison holds.
    pub holds: Expression,
    /// Value otherwise.
    pub otherwise: Expression,
    /// Location of the comparison with both sides.
    pub condition: Span,
}

/// Comparison operator of a condition.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Comparison {
    /// Less than: `<`.
    Less,
    /// Less than or equal: `<=`.
    LessOrEqual,
    /// Greater than: `>`.
    Greater,
    /// Greater than or equal: `>=`.
    GreaterOrEqual,
}

/// `BODY.POINT.COMPONENT`
#[derive(Debug, Clone, PartialEq)]
pub struct Component {
    /// Point of a body.
    pub point: Reference,
    /// `x` or `y`; the parser accepts any word.
    pub axis: Name,
}

/// Sign before a term.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sign {
    /// Plus: `+`.
    Plus,
    /// Minus: `-`.
    Minus,
}

/// Operation before a factor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Operation {
    /// Multiplication: `*`.
    Times,
    /// Division: `/`.
    Over,
}
