//! Differentiation: *an expression and a symbol* → *the partial derivative*.
//!
//! Memoized per node and symbol, so that shared parts are differentiated once; parts without the symbol are not visited.
//! The recursion is as deep as the expression. Rules: d(f^n) = n·f^(n-1)·df, and d atan2(y, x) = (x·dy - y·dx)/(x² + y²). A choice
//! is differentiated arm by arm.

use super::graph::Graph;
use super::node::{ExprId, Factor, Node, SymbolId, Term};
use super::number::Number;
use super::product::Monomial;
use super::rational::Rational;

impl Graph {
    /// The partial derivative of the expression with respect to the symbol. That of a non-finite number is NaN.
    pub fn derivative(&mut self, expr: ExprId, symbol: SymbolId) -> ExprId {
        if !self.is_finite(expr) {
            return self.not_a_number();
        }
        if !self.depends_on(expr, symbol) {
            return self.zero();
        }
        if let Some(&known) = self.derivatives.get(&(expr, symbol)) {
            return known;
        }
        let result = match self.node(expr) {
            Node::Number(_) | Node::Pi => self.zero(),
            Node::Symbol(_) => self.one(),
            Node::Sum(terms) => {
                let dependent: Vec<Term> = terms
                    .iter()
                    .filter(|term| self.depends_on(term.expr, symbol))
                    .copied()
                    .collect();
                self.sum_derivative(&dependent, symbol)
            }
            Node::Product(factors) => {
                let factors = factors.clone();
                self.product_derivative(&factors, symbol)
            }
            Node::Sin(angle) => {
                let angle = *angle;
                let outer = self.cos(angle);
                self.chain(outer, angle, symbol)
            }
            Node::Cos(angle) => {
                let angle = *angle;
                let sine = self.sin(angle);
                let outer = self.negate(sine);
                self.chain(outer, angle, symbol)
            }
            Node::Exp(exponent) => {
                let exponent = *exponent;
                self.chain(expr, exponent, symbol)
            }
            Node::Ln(argument) => {
                let argument = *argument;
                let outer = self.power(argument, -Rational::ONE);
                self.chain(outer, argument, symbol)
            }
            Node::Atan2(y, x) => {
                let (y, x) = (*y, *x);
                self.direction_derivative(y, x, symbol)
            }
            Node::Floor(_) => self.zero(),
            Node::Choose {
                condition,
                below,
                otherwise,
            } => {
                let (condition, below, otherwise) = (*condition, *below, *otherwise);
                let below = self.derivative(below, symbol);
                let otherwise = self.derivative(otherwise, symbol);
                self.choose(condition, below, otherwise)
            }
            Node::Spline {
                spline,
                order,
                argument,
            } => {
                let (spline, order, argument) = (*spline, *order, *argument);
                let outer = self.spline(spline, order + 1, argument);
                self.chain(outer, argument, symbol)
            }
        };
        self.derivatives.insert((expr, symbol), result);
        result
    }

    fn chain(&mut self, outer: ExprId, inner: ExprId, symbol: SymbolId) -> ExprId {
        let inner = self.derivative(inner, symbol);
        self.multiply(outer, inner)
    }

    fn sum_derivative(&mut self, dependent: &[Term], symbol: SymbolId) -> ExprId {
        let parts: Vec<(Number, ExprId)> = dependent
            .iter()
            .map(|term| (term.coefficient, self.derivative(term.expr, symbol)))
            .collect();
        self.combine(&parts)
    }

    fn product_derivative(&mut self, factors: &[Factor], symbol: SymbolId) -> ExprId {
        let mut parts = Vec::new();
        for (place, factor) in factors.iter().enumerate() {
            if !self.depends_on(factor.base, symbol) {
                continue;
            }
            let Some(lowered) = factor.exponent.checked_sub(Rational::ONE) else {
                return self.not_a_number();
            };
            let inner = self.derivative(factor.base, symbol);
            if !self.is_finite(inner) {
                return self.not_a_number();
            }
            let mut monomial = Monomial::new(Number::rational(factor.exponent));
            for (other_place, other) in factors.iter().enumerate() {
                if other_place != place {
                    monomial.push(other.base, other.exponent);
                }
            }
            self.push_power(&mut monomial, factor.base, lowered);
            self.push_power(&mut monomial, inner, Rational::ONE);
            parts.push(self.finish(monomial));
        }
        self.sum(&parts)
    }

    fn direction_derivative(&mut self, y: ExprId, x: ExprId, symbol: SymbolId) -> ExprId {
        let (dy, dx) = (self.derivative(y, symbol), self.derivative(x, symbol));
        let (forward, backward) = (self.multiply(x, dy), self.multiply(y, dx));
        let across = self.subtract(forward, backward);
        let squares = [y, x].map(|part| self.power(part, Rational::integer(2)));
        let length = self.sum(&squares);
        self.divide(across, length)
    }
}
