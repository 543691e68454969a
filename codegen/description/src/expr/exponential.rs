//! Constructs exponential functions, logarithms and general powers, in canonical form.
//!
//! `ln(exp u)` is u. `exp(ln u)` is u only if u is a positive number; otherwise u may be negative and the left side undefined.
//! A power whose exponent is not a rational number is exp(exponent·ln(base)).

use super::graph::Graph;
use super::node::{ExprId, Node};
use super::number::Number;

impl Graph {
    /// Returns the exponential function.
    pub fn exp(&mut self, exponent: ExprId) -> ExprId {
        if !self.is_finite(exponent) {
            return self.not_a_number();
        }
        if exponent == self.zero() {
            return self.one();
        }
        if let Some(power) = self.power_of_number(exponent) {
            return self.number(power);
        }
        self.intern(Node::Exp(exponent))
    }

    /// Returns the natural logarithm; non-finite for a number that is not positive.
    pub fn ln(&mut self, argument: ExprId) -> ExprId {
        match *self.node(argument) {
            Node::Exp(exponent) => exponent,
            Node::Number(value) if value.is_one() => self.zero(),
            Node::Number(value) if value.is_zero() => self.number(Number::Float(f64::NEG_INFINITY)),
            Node::Number(value) if value.is_negative() || !value.is_finite() => self.not_a_number(),
            _ => self.intern(Node::Ln(argument)),
        }
    }

    /// Returns `base ^ exponent` for any exponent: [`Graph::power`] for a rational number, otherwise exp(exponent·ln(base)).
    pub fn raise(&mut self, base: ExprId, exponent: ExprId) -> ExprId {
        if self.any_non_finite(&[base, exponent]) {
            return self.not_a_number();
        }
        if let Node::Number(Number::Exact {
            rational,
            radicand: 1,
        }) = *self.node(exponent)
        {
            return self.power(base, rational);
        }
        let logarithm = self.ln(base);
        let product = self.multiply(exponent, logarithm);
        self.exp(product)
    }

    /// Returns n^c for an exponent c·ln(n) with a positive number n and a rational c; `None` if it is not exact.
    fn power_of_number(&self, exponent: ExprId) -> Option<Number> {
        let (coefficient, logarithm) = match self.node(exponent) {
            Node::Sum(terms) if terms.len() == 1 => (terms[0].coefficient, terms[0].expr),
            _ => (Number::ONE, exponent),
        };
        let Node::Ln(argument) = *self.node(logarithm) else {
            return None;
        };
        match (coefficient, self.as_number(argument)?) {
            (
                Number::Exact {
                    rational,
                    radicand: 1,
                },
                base,
            ) => base.exact_pow(rational),
            _ => None,
        }
    }
}
