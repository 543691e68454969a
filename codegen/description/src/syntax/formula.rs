//! *The formulas of a description, as written*, with the names and points that they mention.
//!
//! Chains of `+ -` and of `* /` are one node each, so a sum of a thousand terms is flat; the depth of a formula is bounded by
//! [`DEEPEST`](super::DEEPEST), so it can be walked by recursion. The tree does not know quantities, functions or units.

use crate::diagnostic::Span;

/// An identifier, or the integer that names a body.
#[derive(Debug, Clone, PartialEq)]
pub struct Name {
    /// The characters as written.
    pub text: String,
    /// Its place.
    pub span: Span,
}

/// `(X, Y)`.
#[derive(Debug, Clone, PartialEq)]
pub struct Pair {
    /// The first component.
    pub x: Expression,
    /// The second component.
    pub y: Expression,
    /// From the opening to the closing parenthesis.
    pub span: Span,
}

/// `NAME` or `BODY.NAME`.
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    /// The body before the dot.
    pub body: Option<Name>,
    /// The body, point or constant.
    pub name: Name,
    /// Both with the dot.
    pub span: Span,
}

/// `A -> B`.
#[derive(Debug, Clone, PartialEq)]
pub struct Direction {
    /// Where the arrow starts.
    pub from: Reference,
    /// Where the arrow ends.
    pub to: Reference,
    /// Both with the arrow.
    pub span: Span,
}

/// A formula.
#[derive(Debug, Clone, PartialEq)]
pub struct Expression {
    /// What it is.
    pub kind: ExpressionKind,
    /// Its place; for a formula in parentheses, with the parentheses.
    pub span: Span,
}

/// What a formula is made of.
#[derive(Debug, Clone, PartialEq)]
pub enum ExpressionKind {
    /// `30deg`: a decimal literal such as `12`, `0.05` or `1e-3`, and its unit.
    Number {
        /// ASCII digits with at most one point and one exponent, without `_`: `f64` reads it, and so does an exact decimal.
        digits: String,
        /// The suffix; whether such a unit exists is not checked here.
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
        /// The name before the parentheses; whether such a function exists is not checked here.
        function: Name,
        /// The arguments in written order.
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
    /// Left of the comparison.
    pub left: Expression,
    /// How both sides are compared.
    pub comparison: Comparison,
    /// Right of the comparison.
    pub right: Expression,
    /// The value where the comparison holds.
    pub holds: Expression,
    /// The value elsewhere.
    pub otherwise: Expression,
    /// The comparison with both sides.
    pub condition: Span,
}

/// The sign between both sides of a condition.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Comparison {
    /// `<`
    Less,
    /// `<=`
    LessOrEqual,
    /// `>`
    Greater,
    /// `>=`
    GreaterOrEqual,
}

/// `BODY.POINT.COMPONENT`
#[derive(Debug, Clone, PartialEq)]
pub struct Component {
    /// The point of a body.
    pub point: Reference,
    /// `x` or `y`, as far as the parser knows any word.
    pub axis: Name,
}

/// The sign before a term.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sign {
    /// `+`
    Plus,
    /// `-`
    Minus,
}

/// The operation before a factor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Operation {
    /// `*`
    Times,
    /// `/`
    Over,
}
