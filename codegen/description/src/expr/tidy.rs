//! Shortens constant expressions.
//!
//! The constructors do not expand products, so a unit vector equal to (1, 0) may be a page of quotients. Here products of short
//! sums are expanded, and terms over one denominator are added. A sum that is a multiple of its divisor becomes a number.
//! Perpendicular and parallel directions and equal points thus give zeros and ones. A result that is longer than the original
//! is discarded.

use super::graph::Graph;
use super::hashing::BuildExprHasher;
use super::node::{ExprId, Factor, Node};
use super::number::Number;
use super::product::Monomial;
use super::rational::Rational;
use std::collections::HashSet;

/// Maximum number of terms of an expanded product.
const MAX_PRODUCT_TERMS: usize = 16;

/// Maximum number of angles of a sum whose direction is expanded.
const MAX_ANGLES: usize = 4;

/// Maximum depth of an expression.
const MAX_DEPTH: u32 = 64;

/// Maximum number of subexpressions.
const MAX_NODE_COUNT: usize = 128;

/// Tolerance between the values of two forms, relative to their terms; rounding is far below it.
const FORM_TOLERANCE: f64 = 1e-9;

/// A numerator over roots and reciprocals.
struct Fraction {
    terms: Vec<(Number, ExprId)>,
    /// Product of all non-polynomial factors: negative and non-integer powers.
    rest: ExprId,
}

impl Graph {
    /// Returns a shorter form of a constant, or the constant itself. Other expressions are returned unchanged.
    pub fn tidied(&mut self, expr: ExprId) -> ExprId {
        let is_plain = matches!(self.node(expr), Node::Number(_) | Node::Pi);
        if is_plain || !self.is_constant(expr) || self.depth(expr) > MAX_DEPTH {
            return expr;
        }
        if let Some(&known) = self.tidied.get(&expr) {
            return known;
        }
        if self.is_large(expr) {
            return expr;
        }
        let candidate = self.spread(expr);
        let is_shorter = self.is_finite(candidate)
            && self.written_length(candidate) < self.written_length(expr)
            && self.agrees(expr, candidate);
        let result = if is_shorter { candidate } else { expr };
        self.tidied.insert(expr, result);
        result
    }

    /// True if a constant is too large to be transformed.
    fn is_large(&self, expr: ExprId) -> bool {
        let mut held: HashSet<ExprId, BuildExprHasher> = HashSet::default();
        let mut stack = vec![expr];
        while let Some(expr) = stack.pop() {
            if held.len() > MAX_NODE_COUNT || stack.len() > MAX_NODE_COUNT {
                return true;
            }
            if held.insert(expr) {
                self.node(expr).each_operand(|operand| stack.push(operand));
            }
        }
        false
    }

    /// True if two forms of a constant have equal values, up to the rounding of the first.
    fn agrees(&self, expr: ExprId, found: ExprId) -> bool {
        let (before, after) = (self.worth(expr).value, self.worth(found).value);
        let size = match self.node(expr) {
            Node::Sum(terms) => terms
                .iter()
                .map(|term| (term.coefficient.to_f64() * self.worth(term.expr).value).abs())
                .sum(),
            Node::Sin(_) | Node::Cos(_) => 1.0,
            _ => before.abs(),
        };
        (before - after).abs() <= FORM_TOLERANCE * size
    }

    /// Returns the constant with all products expanded and fractions added.
    fn spread(&mut self, expr: ExprId) -> ExprId {
        match *self.node(expr) {
            Node::Sin(angle) => {
                let angle = self.tidied(angle);
                let sine = self.sin(angle);
                self.direction(angle)
                    .map_or(sine, |[_, sine]| self.tidied(sine))
            }
            Node::Cos(angle) => {
                let angle = self.tidied(angle);
                let cosine = self.cos(angle);
                self.direction(angle)
                    .map_or(cosine, |[cosine, _]| self.tidied(cosine))
            }
            Node::Atan2(y, x) => {
                let (y, x) = (self.tidied(y), self.tidied(x));
                self.atan2(y, x)
            }
            Node::Sum(_) | Node::Product(_) => {
                let mut groups: Vec<Fraction> = Vec::new();
                for fraction in self.fractions(expr) {
                    match groups.iter_mut().find(|group| group.rest == fraction.rest) {
                        Some(group) => group.terms.extend(fraction.terms),
                        None => groups.push(fraction),
                    }
                }
                let parts: Vec<ExprId> = groups
                    .into_iter()
                    .map(|group| self.added_up(group))
                    .collect();
                self.sum(&parts)
            }
            _ => expr,
        }
    }

    /// Returns cosine and sine of a sum of a few angles, in terms of those of the angles.
    fn direction(&mut self, angle: ExprId) -> Option<[ExprId; 2]> {
        let Node::Sum(terms) = self.node(angle) else {
            return None;
        };
        let is_short = terms.len() <= MAX_ANGLES
            && terms
                .iter()
                .any(|it| matches!(self.node(it.expr), Node::Atan2(..)));
        if terms.len() < 2 || !is_short {
            return None;
        }
        let terms = terms.clone();
        let mut whole = [self.one(), self.zero()];
        for term in terms.iter() {
            let part = self.scale(term.coefficient, term.expr);
            let (cosine, sine) = (self.cos(part), self.sin(part));
            let [along, across] = [(cosine, sine), (sine, cosine)].map(|(first, second)| {
                let first = self.multiply(whole[0], first);
                (first, self.multiply(whole[1], second))
            });
            whole = [
                self.subtract(along.0, along.1),
                self.add(across.0, across.1),
            ];
        }
        Some(whole)
    }

    /// Returns the addends of an expression as fractions.
    fn fractions(&mut self, expr: ExprId) -> Vec<Fraction> {
        match self.node(expr) {
            Node::Sum(terms) => {
                let terms = terms.clone();
                let mut fractions = Vec::with_capacity(terms.len());
                for term in terms.iter() {
                    let mut fraction = self.fraction(term.expr);
                    for part in &mut fraction.terms {
                        part.0 = part.0.mul(term.coefficient);
                    }
                    fractions.push(fraction);
                }
                fractions
            }
            _ => vec![self.fraction(expr)],
        }
    }

    /// Returns a product as one fraction, with its polynomial part expanded.
    fn fraction(&mut self, expr: ExprId) -> Fraction {
        let one = self.one();
        let mut fraction = Fraction {
            terms: vec![(Number::ONE, one)],
            rest: one,
        };
        let factors: Vec<Factor> = match self.node(expr) {
            Node::Product(factors) => factors.to_vec(),
            _ => vec![Factor {
                base: expr,
                exponent: Rational::ONE,
            }],
        };
        for Factor { base, exponent } in factors {
            // A sum has been expanded by itself.
            let base = match self.node(base) {
                Node::Sum(_) | Node::Product(_) => self.spread(base),
                _ => self.tidied(base),
            };
            if !self.multiplied(&mut fraction.terms, base, exponent) {
                let power = self.power(base, exponent);
                fraction.rest = self.multiply(fraction.rest, power);
            }
        }
        fraction
    }

    /// Multiplies terms by an integer power; returns false, without a change, for other powers and for too many terms.
    fn multiplied(
        &mut self,
        terms: &mut Vec<(Number, ExprId)>,
        base: ExprId,
        exponent: Rational,
    ) -> bool {
        if exponent.is_negative() || !exponent.is_integer() {
            return false;
        }
        let mut addends = Vec::new();
        self.gather(Number::ONE, base, &mut addends);
        let count = u32::try_from(exponent.numerator()).ok();
        let most = count.and_then(|count| addends.len().checked_pow(count));
        if most.is_none_or(|most| most.saturating_mul(terms.len()) > MAX_PRODUCT_TERMS) {
            return false;
        }
        if addends.len() == 1 {
            let power = self.power(base, exponent);
            for (_, expr) in terms.iter_mut() {
                *expr = self.multiply(*expr, power);
            }
            return true;
        }
        for _ in 0..exponent.numerator() {
            let before = std::mem::take(terms);
            for (coefficient, expr) in before {
                for addend in &addends {
                    let product = self.multiply(expr, addend.expr);
                    terms.push((coefficient.mul(addend.coefficient), product));
                }
            }
        }
        true
    }

    /// Returns a fraction as an expression, with common factors of numerator and denominator cancelled.
    fn added_up(&mut self, fraction: Fraction) -> ExprId {
        let mut numerator = self.combine(&fraction.terms);
        let rest = match self.node(fraction.rest) {
            Node::Product(factors) => factors.to_vec(),
            _ => return self.multiply(numerator, fraction.rest),
        };
        let mut monomial = Monomial::new(Number::ONE);
        for Factor { base, exponent } in rest {
            let share = self.multiple_of(numerator, base);
            match (share, exponent.checked_add(Rational::ONE)) {
                (Some(share), Some(left)) if exponent.is_negative() => {
                    numerator = self.number(share);
                    self.push_power(&mut monomial, base, left);
                }
                _ => self.push_power(&mut monomial, base, exponent),
            }
        }
        let rest = self.finish(monomial);
        self.multiply(numerator, rest)
    }

    /// Returns the k of a sum that is k times another sum; `None` for other sums.
    fn multiple_of(&mut self, sum: ExprId, of: ExprId) -> Option<Number> {
        let (Node::Sum(terms), Node::Sum(others)) = (self.node(sum), self.node(of)) else {
            return None;
        };
        let (first, other) = (terms.first()?, others.first()?);
        if terms.len() != others.len() || others.len() < 2 || first.expr != other.expr {
            return None;
        }
        let share = first.coefficient.mul(other.coefficient.recip());
        let is_exact = matches!(share, Number::Exact { .. });
        (is_exact && self.scale(share, of) == sum).then_some(share)
    }
}
