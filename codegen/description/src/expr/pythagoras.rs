//! Reduces sin² + cos² = 1 within a sum to smaller coefficients.
//!
//! For a monomial m and an angle u, the three coefficients of m, m·sin²u and m·cos²u are determined only up to a shift (a + k,
//! b - k, c - k), because m = m·sin²u + m·cos²u. The representative has the least |a| + |b| + |c|. It is unique, as k is the
//! median of -a, b and c. The reduction turns sin² + cos² into 1, 1 - sin² into cos² and 1 + tan² into 1/cos², and leaves 5 +
//! sin² unchanged. If terms belong to two such triples, the earlier one in the order of terms is reduced first. Such sums have
//! equal values, but may have different ids if they are built in different steps.

use super::graph::Graph;
use super::node::{ExprId, Factor, Node, Term};
use super::number::Number;
use super::rational::Rational;
use super::sum::find_term;

/// Maximum number of factors of a product that is examined: each factor is looked up among all terms.
const MAX_FACTORS: usize = 16;

/// A monomial m with an angle u.
struct Triple {
    monomial: Vec<Factor>,
    angle: ExprId,
    radicand: u128,
}

impl Graph {
    /// Reduces every triple once; returns true if a term changed, so that the terms must be merged again.
    ///
    /// The reduction terminates: each change decreases the sum of the coefficients' magnitudes, and these are whole multiples
    /// of a common fraction. Floats lack this property and are excluded.
    pub(super) fn reduce_squares(&mut self, terms: &mut Vec<Term>) -> bool {
        let triples: Vec<Triple> = terms.iter().flat_map(|term| self.triples(term)).collect();
        let mut added = Vec::new();
        let mut changed = false;
        for triple in &triples {
            changed |= self.reduce(triple, terms, &mut added);
        }
        terms.append(&mut added);
        changed
    }

    /// Returns the triples of a term. A negative power of sine or cosine is the m of 1/cos² = 1 + tan².
    fn triples(&self, term: &Term) -> Vec<Triple> {
        let (Number::Exact { radicand, .. }, Node::Product(factors)) =
            (term.coefficient, self.node(term.expr))
        else {
            return Vec::new();
        };
        if factors.len() > MAX_FACTORS {
            return Vec::new();
        }
        let mut triples = Vec::new();
        for factor in factors.iter().filter(|factor| factor.exponent.is_integer()) {
            let (Node::Sin(angle) | Node::Cos(angle)) = *self.node(factor.base) else {
                continue;
            };
            let monomial = match factor.exponent.numerator() {
                2.. => with_power(factors, factor.base, -2),
                ..0 => Some(factors.to_vec()),
                _ => None,
            };
            triples.extend(monomial.map(|monomial| Triple {
                monomial,
                angle,
                radicand,
            }));
        }
        triples
    }

    fn reduce(&mut self, triple: &Triple, terms: &mut [Term], added: &mut Vec<Term>) -> bool {
        let square = |graph: &Graph, function: Node| {
            let factors = with_power(&triple.monomial, graph.find(&function)?, 2)?;
            let expr = graph.find_monomial(&factors)?;
            find_term(terms, expr, triple.radicand)
        };
        let sine = square(self, Node::Sin(triple.angle));
        let cosine = square(self, Node::Cos(triple.angle));
        let alone = self
            .find_monomial(&triple.monomial)
            .and_then(|expr| find_term(terms, expr, triple.radicand));
        let at = |place: Option<usize>| match place.map(|place| terms[place].coefficient) {
            Some(Number::Exact { rational, .. }) => rational,
            _ => Rational::ZERO,
        };
        let (a, b, c) = (at(alone), at(sine), at(cosine));
        let shift = median(-a, b, c);
        let (Some(new_a), Some(new_b), Some(new_c)) = (
            a.checked_add(shift),
            b.checked_sub(shift),
            c.checked_sub(shift),
        ) else {
            return false;
        };
        if shift.is_zero() {
            return false;
        }
        // A zero coefficient keeps its radicand, so that the terms stay sorted until they are merged.
        let coefficient = |rational| Number::Exact {
            rational,
            radicand: triple.radicand,
        };
        let targets = [
            (alone, new_a, None),
            (sine, new_b, Some(Node::Sin(triple.angle))),
            (cosine, new_c, Some(Node::Cos(triple.angle))),
        ];
        for (place, value, function) in targets {
            match (place, function) {
                (Some(place), _) => terms[place].coefficient = coefficient(value),
                (None, _) if value.is_zero() => {}
                (None, None) => {
                    let expr = self.monomial(triple.monomial.clone());
                    self.gather(coefficient(value), expr, added);
                }
                (None, Some(function)) => {
                    let base = self.intern(function);
                    if let Some(factors) = with_power(&triple.monomial, base, 2) {
                        let expr = self.monomial(factors);
                        self.gather(coefficient(value), expr, added);
                    }
                }
            }
        }
        true
    }

    /// Returns the expression of canonical factors; `None` if it does not exist.
    fn find_monomial(&self, factors: &[Factor]) -> Option<ExprId> {
        match factors {
            [] => Some(self.one()),
            [factor] if factor.exponent == Rational::ONE => Some(factor.base),
            _ => self.find(&Node::Product(factors.into())),
        }
    }
}

/// Returns the factors times `base ^ exponent`; `None` if the exponent does not fit.
fn with_power(factors: &[Factor], base: ExprId, exponent: i64) -> Option<Vec<Factor>> {
    let mut result = factors.to_vec();
    let exponent = Rational::integer(exponent);
    match result.binary_search_by_key(&base, |factor| factor.base) {
        Ok(place) => {
            result[place].exponent = result[place].exponent.checked_add(exponent)?;
            if result[place].exponent.is_zero() {
                result.remove(place);
            }
        }
        Err(place) => result.insert(place, Factor { base, exponent }),
    }
    Some(result)
}

fn median(a: Rational, b: Rational, c: Rational) -> Rational {
    let mut values = [a, b, c];
    values.sort_unstable();
    values[1]
}
