//! Constructs choices between two expressions, in canonical form.
//!
//! A choice is its first arm if the condition is negative, and its second arm otherwise. The derivative is the choice between
//! the derivatives of the arms, which is exact if the arms join. A jump between arms is not differentiated, so the caller must
//! ensure continuity. The reduction of an argument to one period uses the number of whole periods, whose derivative is zero for
//! the same reason.

use super::graph::Graph;
use super::node::{ExprId, Node, Term};
use super::number::Number;

/// Bound on floors that become whole numbers: larger numbers are whole anyway, and too large to be exact.
const MAX_COUNTED_FLOOR: f64 = 1e15;

/// A condition in handwritten form: `left < right` or `left > right`, without negative variable terms.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Terms on the left; never empty.
    pub left: Vec<Term>,
    /// True if the sign is `<`, false if it is `>`.
    pub is_less: bool,
    /// Terms on the right; empty for 0.
    pub right: Vec<Term>,
}

impl Graph {
    /// Returns `below` if `condition` is negative, and `otherwise` if not.
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
        // An arm that tests the same condition is already decided.
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

    /// Returns |x|, as a choice between −x and x.
    pub fn magnitude(&mut self, x: ExprId) -> ExprId {
        if self.magnitude_of(x).is_some() {
            return x;
        }
        let negated = self.negate(x);
        match self.is_constant(x) {
            true if self.constant_value(x).is_some_and(|value| value < 0.0) => negated,
            true => x,
            // −x has the same magnitude, and only one of them is used.
            false => {
                let x = x.min(negated);
                let negated = self.negate(x);
                self.choose(x, negated, x)
            }
        }
    }

    /// Returns the x of an expression |x|; `None` for other expressions.
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

    /// True if two expressions differ only in the signs of all terms.
    fn is_negation(&self, one: ExprId, other: ExprId) -> bool {
        let (mut of_one, mut of_other) = (Vec::new(), Vec::new());
        self.gather(Number::ONE, one, &mut of_one);
        self.gather(Number::ONE.neg(), other, &mut of_other);
        of_one == of_other
    }

    /// Returns the greatest whole number that does not exceed the argument.
    pub fn floor(&mut self, argument: ExprId) -> ExprId {
        if !self.is_finite(argument) {
            return self.not_a_number();
        }
        if self.is_constant(argument)
            && let Some(value) = self.constant_value(argument)
        {
            let floor = value.floor();
            return if floor.abs() < MAX_COUNTED_FLOOR {
                self.integer(floor as i64)
            } else {
                self.number(Number::float(floor))
            };
        }
        self.intern(Node::Floor(argument))
    }

    /// Returns `condition < 0` as a comparison, with every variable term on the side where it is positive, and constants on the
    /// right.
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
