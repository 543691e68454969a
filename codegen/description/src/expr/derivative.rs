//! Differentiates expressions partially with respect to symbols.
//!
//! Derivatives are memoized per node and symbol, so shared parts are differentiated once; parts without the symbol are not
//! visited. Deeply nested expressions are differentiated from the inside out. Rules: d(f^n) = n·f^(n-1)·df, and d atan2(y, x) =
//! (x·dy - y·dx)/(x² + y²). A choice is differentiated arm by arm.
//!
//! The derivative of b·S^r is b'·S^r + r·b·S^(r-1)·S'. Its terms cancel if one term of S is proportional to b^(-1/r) and the
//! rest of S is constant: x/√(x² + c) has the derivative 1/√(x² + c) - x²/(x² + c)^(3/2). With S = k·b^(-1/r) + c the
//! derivative equals b'·c·S^(r-1), which is used instead.
//!
//! The product rule turns n factors into n products of n factors, and the next derivative into n² products. A long product is
//! therefore split into halves, whose derivatives are separate sums: n log n factors, and n log² n for the next derivative.

use super::graph::Graph;
use super::hashing::BuildExprHasher;
use super::node::{ExprId, Factor, Node, SymbolId, Term};
use super::number::Number;
use super::product::Monomial;
use super::rational::Rational;
use std::collections::HashMap;

/// Depth from which operands are differentiated first.
const OPERANDS_FIRST_DEPTH: u32 = 32;

/// Number of terms from which a sum has an index of its symbols, unless each term contains more symbols than this.
const INDEXED_TERM_COUNT: usize = 64;
const MAX_OCCURRENCES: usize = 16;

/// Indices of the terms of a sum by symbol; never iterated.
pub(super) type TermIndex = HashMap<SymbolId, Vec<u32>, BuildExprHasher>;

/// Maximum number of dependent factors of a product that is not halved.
const MAX_FLAT_FACTORS: usize = 8;

/// Indices of the root S^r among the factors of a product, and of k·b^(-1/r) among the terms of S.
struct Level {
    root: usize,
    varying: usize,
}

impl Graph {
    /// Returns the partial derivative of the expression with respect to the symbol; NaN for a non-finite number.
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
        if self.depth(expr) > OPERANDS_FIRST_DEPTH {
            for operand in self.open_below(expr, symbol) {
                self.differentiate(operand, symbol);
            }
        }
        self.differentiate(expr, symbol)
    }

    /// Returns the subexpressions that depend on the symbol and are not yet differentiated, operands first.
    fn open_below(&self, expr: ExprId, symbol: SymbolId) -> Vec<ExprId> {
        self.open_operands(expr, |operand| {
            self.depends_on(operand, symbol) && !self.derivatives.contains_key(&(operand, symbol))
        })
    }

    /// Differentiates an expression that depends on the symbol, given the derivatives of its operands.
    fn differentiate(&mut self, expr: ExprId, symbol: SymbolId) -> ExprId {
        let result = match self.node(expr) {
            Node::Number(_) | Node::Pi => self.zero(),
            Node::Symbol(_) => self.one(),
            Node::Sum(terms) => {
                let dependent = match terms.len() {
                    0..INDEXED_TERM_COUNT => self.dependent_terms(terms, symbol),
                    _ => self.indexed_terms(expr, symbol),
                };
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

    fn dependent_terms(&self, terms: &[Term], symbol: SymbolId) -> Vec<Term> {
        let dependent = terms
            .iter()
            .filter(|term| self.depends_on(term.expr, symbol));
        dependent.copied().collect()
    }

    /// Returns the terms of a long sum that contain the symbol. Such a sum is mostly differentiated by many symbols, so their
    /// occurrences are indexed once.
    fn indexed_terms(&mut self, expr: ExprId, symbol: SymbolId) -> Vec<Term> {
        let Node::Sum(terms) = self.node(expr) else {
            return Vec::new();
        };
        let indexed = |index: &TermIndex| {
            let places = index.get(&symbol).into_iter().flatten();
            places.map(|&place| terms[place as usize]).collect()
        };
        if let Some(index) = self.term_indices.get(&expr) {
            return indexed(index);
        }
        let occurrences: usize = terms.iter().map(|it| self.symbols(it.expr).len()).sum();
        if occurrences > MAX_OCCURRENCES * terms.len() {
            // Testing whether a term depends on the symbol costs a fraction of adding the term.
            let looked_at = 1 + terms.len() / 8;
            let dependent = self.dependent_terms(terms, symbol);
            self.ledger.touch(looked_at);
            return dependent;
        }
        let mut index = TermIndex::default();
        for (place, term) in (0u32..).zip(terms.iter()) {
            for &symbol in self.symbols(term.expr) {
                index.entry(symbol).or_default().push(place);
            }
        }
        let dependent = indexed(&index);
        self.ledger.store(occurrences / 8);
        self.term_indices.insert(expr, index);
        dependent
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
        let (dependent, constant): (Vec<Factor>, Vec<Factor>) = factors
            .iter()
            .copied()
            .partition(|factor| self.depends_on(factor.base, symbol));
        if dependent.len() > MAX_FLAT_FACTORS {
            return self.halved_derivative(&dependent, &constant, symbol);
        }
        if let Some(level) = self.level(&dependent, symbol) {
            return self.level_derivative(&dependent, &constant, level, symbol);
        }
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

    /// Returns the root S^r among factors b·S^r with S = k·b^(-1/r) + c and constants k and c; `None` if there is none.
    fn level(&self, dependent: &[Factor], symbol: SymbolId) -> Option<Level> {
        if dependent.len() < 2 {
            return None;
        }
        (0..dependent.len()).find_map(|root| {
            let Factor { base, exponent } = dependent[root];
            let Node::Sum(terms) = self.node(base) else {
                return None;
            };
            if exponent.is_integer() || terms.len() < 2 {
                return None;
            }
            let mut varying =
                (0..terms.len()).filter(|it| self.depends_on(terms[*it].expr, symbol));
            let (varying, None) = (varying.next()?, varying.next()) else {
                return None;
            };
            let power = -Rational::ONE.checked_div(exponent)?;
            let others = (0..dependent.len()).filter(|it| *it != root);
            let expected: Option<Vec<Factor>> = others
                .map(|it| {
                    let exponent = dependent[it].exponent.checked_mul(power)?;
                    let base = dependent[it].base;
                    Some(Factor { base, exponent })
                })
                .collect();
            let varying_factors: Vec<Factor> = match self.node(terms[varying].expr) {
                Node::Product(factors) => {
                    let factors = factors.iter().copied();
                    factors
                        .filter(|it| self.depends_on(it.base, symbol))
                        .collect()
                }
                _ => vec![Factor {
                    base: terms[varying].expr,
                    exponent: Rational::ONE,
                }],
            };
            (varying_factors == expected?).then_some(Level { root, varying })
        })
    }

    /// Returns b'·c·S^(r-1), times the constant factors.
    fn level_derivative(
        &mut self,
        dependent: &[Factor],
        constant: &[Factor],
        level: Level,
        symbol: SymbolId,
    ) -> ExprId {
        let Factor { base, exponent } = dependent[level.root];
        let (Node::Sum(terms), Some(lowered)) =
            (self.node(base), exponent.checked_sub(Rational::ONE))
        else {
            return self.not_a_number();
        };
        let mut rest = terms.to_vec();
        rest.remove(level.varying);
        let rest = self.canonical_sum(rest);
        let mut others = dependent.to_vec();
        others.remove(level.root);
        let others = self.monomial(others);
        let inner = self.derivative(others, symbol);
        if !self.is_finite(inner) {
            return self.not_a_number();
        }
        let mut monomial = Monomial::new(Number::ONE);
        for kept in constant {
            monomial.push(kept.base, kept.exponent);
        }
        self.push_power(&mut monomial, base, lowered);
        self.push_power(&mut monomial, rest, Rational::ONE);
        self.push_power(&mut monomial, inner, Rational::ONE);
        self.finish(monomial)
    }

    /// Returns c·(a·b)' = c·b·a' + c·a·b' with the halves a and b of the dependent factors.
    fn halved_derivative(
        &mut self,
        dependent: &[Factor],
        constant: &[Factor],
        symbol: SymbolId,
    ) -> ExprId {
        let (first, second) = dependent.split_at(dependent.len() / 2);
        let mut parts = Vec::with_capacity(2);
        for (half, other) in [(first, second), (second, first)] {
            let half = self.monomial(half.to_vec());
            let inner = self.derivative(half, symbol);
            if !self.is_finite(inner) {
                return self.not_a_number();
            }
            let mut monomial = Monomial::new(Number::ONE);
            for kept in constant.iter().chain(other) {
                monomial.push(kept.base, kept.exponent);
            }
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
