//! Choices between two expressions: *a condition and two arms* → *the canonical expression*.
//!
//! A choice is its first arm where the condition is negative and its second arm elsewhere. Its derivative is the choice
//! between the derivatives of the arms: exact wherever the arms join; a jump between them is not differentiated, so whoever
//! builds a choice answers for the join. An argument brought into one period needs the number of whole periods, whose
//! derivative is zero for the same reason.

use super::graph::Graph;
use super::node::{ExprId, Node, Term};
use super::number::Number;

/// The largest floor that becomes a whole number: larger numbers are whole anyway, and too large to be counted exactly.
const LARGEST_COUNTED: f64 = 1e15;

/// A condition as a person writes it: `left < right`, or `left > right`, without negative variable terms.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// The terms on the left; never empty.
    pub left: Vec<Term>,
    /// Whether the sign is `<`, and not `>`.
    pub is_less: bool,
    /// The terms on the right; empty for 0.
    pub right: Vec<Term>,
}

impl Graph {
    /// `below` where `condition` is negative, `otherwise` elsewhere.
    pub fn choose(&mut self, condition: ExprId, below: ExprId, otherwise: ExprId) -> ExprId {
        if self.any_non_finite(&[condition, below, otherwise]) {
            return self.not_a_number();
        }
        // A symbol with a nominal value keeps the choice open.
        if self.is_constant(condition)
            && let Some(value) = self.constant_value(condition)
        {
            return if value < 0.0 { below } else { otherwise };
        }
        // An arm that asks the same question has its answer already.
        let below = match *self.node(below) {
            Node::Choose {
                condition: same,
                below,
                ..
            } if same == condition => below,
            _ => below,
        };
        let otherwise = match *self.node(otherwise) {
            Node::Choose {
                condition: same,
                otherwise,
                ..
            } if same == condition => otherwise,
            _ => otherwise,
        };
        if below == otherwise {
            return below;
        }
        self.intern(Node::Choose {
            condition,
            below,
            otherwise,
        })
    }

    /// |x|, as a choice between −x and x.
    pub fn magnitude(&mut self, x: ExprId) -> ExprId {
        if self.magnitude_of(x).is_some() {
            return x;
        }
        let negated = self.negate(x);
        match self.is_constant(x) {
            true if self.constant_value(x).is_some_and(|value| value < 0.0) => negated,
            true => x,
            // −x has the same magnitude, and one of them is written.
            false => {
                let x = x.min(negated);
                let negated = self.negate(x);
                self.choose(x, negated, x)
            }
        }
    }

    /// What an expression is the magnitude of, if it is one.
    pub fn magnitude_of(&self, expr: ExprId) -> Option<ExprId> {
        match *self.node(expr) {
            Node::Choose {
                condition,
                below,
                otherwise,
            } if condition == otherwise && self.is_negation(below, condition) => Some(condition),
            _ => None,
        }
    }

    /// Whether two expressions differ in the sign of every term alone.
    fn is_negation(&self, one: ExprId, other: ExprId) -> bool {
        let (mut of_one, mut of_other) = (Vec::new(), Vec::new());
        self.gather(Number::ONE, one, &mut of_one);
        self.gather(Number::ONE.neg(), other, &mut of_other);
        of_one == of_other
    }

    /// The largest whole number that is not greater than the argument.
    pub fn floor(&mut self, argument: ExprId) -> ExprId {
        if !self.is_finite(argument) {
            return self.not_a_number();
        }
        if self.is_constant(argument)
            && let Some(value) = self.constant_value(argument)
        {
            let floor = value.floor();
            return if floor.abs() < LARGEST_COUNTED {
                self.integer(floor as i64)
            } else {
                self.number(Number::float(floor))
            };
        }
        self.intern(Node::Floor(argument))
    }

    /// What `condition < 0` says, with every variable term on the side where it is positive and constants on the right.
    pub fn comparison(&self, condition: ExprId) -> Comparison {
        let terms = match self.node(condition) {
            Node::Sum(terms) => terms.to_vec(),
            _ => vec![Term {
                coefficient: Number::ONE,
                expr: condition,
            }],
        };
        let variable = |term: &&Term| !self.is_constant(term.expr);
        let is_less = terms
            .iter()
            .filter(variable)
            .any(|term| !term.coefficient.is_negative());
        let mut comparison = Comparison {
            left: Vec::new(),
            is_less,
            right: Vec::new(),
        };
        for term in terms {
            let negated = Term {
                coefficient: term.coefficient.neg(),
                expr: term.expr,
            };
            let is_left = !self.is_constant(term.expr) && term.coefficient.is_negative() != is_less;
            match (is_left, is_less) {
                (true, true) => comparison.left.push(term),
                (true, false) => comparison.left.push(negated),
                (false, true) => comparison.right.push(negated),
                (false, false) => comparison.right.push(term),
            }
        }
        comparison
    }
}
