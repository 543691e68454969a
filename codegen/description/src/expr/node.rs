//! Defines the kinds of nodes.
//!
//! The constructors of [`Graph`](super::Graph), the only code that creates nodes, maintain the invariants stated for each kind.

use std::sync::Arc;

use super::number::Number;
use super::rational::Rational;
use super::spline::SplineId;

/// An expression of one [`Graph`](super::Graph). Operands always have smaller ids than the expressions built from them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ExprId(pub(super) u32);

impl ExprId {
    /// Returns the position in creation order, from 0.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A symbol of one [`Graph`](super::Graph).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SymbolId(pub(super) u32);

impl SymbolId {
    /// Returns the position in order of declaration, from 0: the index into the values given to
    /// [`Tape::evaluate`](super::Tape::evaluate).
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// One term of a sum: `coefficient · expr`. The constant part has `expr == Graph::one()`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Term {
    /// Numeric factor; never zero, always finite.
    pub coefficient: Number,
    /// Multiplied expression; never a sum, and a number only if it is [`Graph::one`](super::Graph::one).
    pub expr: ExprId,
}

/// One factor of a product: `base ^ exponent`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Factor {
    /// Base. A product, or a sum with a numeric content, only if the exponent is not an integer.
    pub base: ExprId,
    /// Exponent; never zero. A negative base with a non-integer exponent has no value.
    pub exponent: Rational,
}

/// Top of an expression. Copies share their terms and factors.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// A number; the only node that may be non-finite.
    Number(Number),
    /// The number π.
    Pi,
    /// A variable.
    Symbol(SymbolId),
    /// At least two terms, or one term whose coefficient is not one. Sorted by expression, then by the radicand of the
    /// coefficient; like terms are merged.
    Sum(Arc<[Term]>),
    /// At least two factors, or one whose exponent is not one. Sorted by base, with distinct bases and without numeric factors:
    /// coefficients are in the terms of the enclosing sum.
    Product(Arc<[Factor]>),
    /// The sine of an angle in radians.
    Sin(ExprId),
    /// The cosine of an angle in radians.
    Cos(ExprId),
    /// `Atan2(y, x)`: the angle of the vector (x, y), in (-π, π].
    Atan2(ExprId, ExprId),
    /// The exponential function.
    Exp(ExprId),
    /// The natural logarithm.
    Ln(ExprId),
    /// Greatest whole number that does not exceed the operand.
    Floor(ExprId),
    /// One of two expressions. The condition is not constant, and the arms differ.
    Choose {
        /// Condition: negative or not.
        condition: ExprId,
        /// Value if the condition is negative.
        below: ExprId,
        /// Value otherwise.
        otherwise: ExprId,
    },
    /// A spline, or one of its derivatives, at an argument that contains a symbol.
    Spline {
        /// Spline.
        spline: SplineId,
        /// Order of the derivative, from 0 to 3.
        order: u8,
        /// Argument.
        argument: ExprId,
    },
}

impl Node {
    /// Calls `visit` with every operand, in order.
    pub(super) fn each_operand(&self, mut visit: impl FnMut(ExprId)) {
        match self {
            Node::Number(_) | Node::Pi | Node::Symbol(_) => {}
            Node::Sum(terms) => terms.iter().for_each(|term| visit(term.expr)),
            Node::Product(factors) => factors.iter().for_each(|factor| visit(factor.base)),
            Node::Sin(x) | Node::Cos(x) | Node::Exp(x) | Node::Ln(x) | Node::Floor(x) => visit(*x),
            Node::Atan2(y, x) => [*y, *x].into_iter().for_each(visit),
            Node::Choose {
                condition,
                below,
                otherwise,
            } => [*condition, *below, *otherwise].into_iter().for_each(visit),
            Node::Spline { argument, .. } => visit(*argument),
        }
    }

    /// Returns the number of terms or factors; 1 for any other node.
    pub(super) fn size(&self) -> usize {
        match self {
            Node::Sum(terms) => terms.len(),
            Node::Product(factors) => factors.len(),
            _ => 1,
        }
    }
}
