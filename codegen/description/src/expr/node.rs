//! The node kinds: *an id* → *what it stands for*.
//!
//! The invariants named on each kind are kept by the constructors of [`Graph`](super::Graph), the only code that makes
//! nodes. This file does not know how they are kept.

use std::sync::Arc;

use super::number::Number;
use super::rational::Rational;
use super::spline::SplineId;

/// An expression of one [`Graph`](super::Graph). Operands always have smaller ids than what is built from them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ExprId(pub(super) u32);

impl ExprId {
    /// The position in creation order, from 0.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A symbol of one [`Graph`](super::Graph).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SymbolId(pub(super) u32);

impl SymbolId {
    /// The position in order of declaration, from 0: the index into the values given to
    /// [`Tape::evaluate`](super::Tape::evaluate).
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// One term of a sum: `coefficient · expr`. The constant part has `expr == Graph::one()`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Term {
    /// The numeric factor, never zero, always finite.
    pub coefficient: Number,
    /// What it multiplies: never a sum, and a number only where it is [`Graph::one`](super::Graph::one).
    pub expr: ExprId,
}

/// One factor of a product: `base ^ exponent`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Factor {
    /// What is raised. A product or a sum with a numeric content only under an exponent that is not an integer.
    pub base: ExprId,
    /// The exponent, never zero. A base that is negative under a non-integer exponent has no value.
    pub exponent: Rational,
}

/// What an expression is at its top. Copies share their terms and factors.
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
    /// Two factors or more, or one whose exponent is not one. Sorted by base, bases distinct, no numeric factor:
    /// coefficients live in the enclosing sum's term.
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
    /// The largest whole number that is not greater than the operand.
    Floor(ExprId),
    /// One of two expressions. The condition is not constant, and the arms differ.
    Choose {
        /// Decides: negative or not.
        condition: ExprId,
        /// The value where the condition is negative.
        below: ExprId,
        /// The value elsewhere.
        otherwise: ExprId,
    },
    /// A spline, or one of its derivatives, at an argument that holds a symbol.
    Spline {
        /// Which one.
        spline: SplineId,
        /// Which derivative, from 0 to 3.
        order: u8,
        /// Where.
        argument: ExprId,
    },
}

impl Node {
    /// Calls `visit` with everything that it is made of, in its order.
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

    /// How many terms or factors it holds; 1 for any other node.
    pub(super) fn size(&self) -> usize {
        match self {
            Node::Sum(terms) => terms.len(),
            Node::Product(factors) => factors.len(),
            _ => 1,
        }
    }
}
