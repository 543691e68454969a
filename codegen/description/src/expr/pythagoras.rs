//! sin² + cos² = 1 within a sum: *merged terms* → *equal terms with smaller coefficients*.
//!
//! For a monomial m and an angle u the three coefficients of m, m·sin²u and m·cos²u are determined only up to a shift
//! (a + k, b - k, c - k), because m = m·sin²u + m·cos²u. The representative is the one with the least |a| + |b| + |c|; it is
//! unique, k being the median of -a, b and c. It turns sin² + cos² into 1, 1 - sin² into cos², 1 + tan² into 1/cos², and
//! leaves 5 + sin² as it is. Where terms belong to two such triples at once, the earlier one in the order of terms is
//! reduced first; such sums are equal in value but need not have equal ids when built in different steps.

use super::graph::Graph;
use super::node::{ExprId, Factor, Node, Term};
use super::number::Number;
use super::rational::Rational;
use super::sum::find_term;

/// A longer product takes no part: each of its factors would be looked for among all terms.
const LONGEST_PRODUCT: usize = 16;

/// A monomial m and the angle u.
struct Triple {
    monomial: Vec<Factor>,
    angle: ExprId,
    radicand: u128,
}

impl Graph {
    /// Reduces every triple once; answers whether anything changed, so that the terms must be merged again.
    ///
    /// It ends: each change makes the sum of the coefficients' magnitudes smaller, and they are whole multiples of one
    /// common fraction. Floats, which are not, take no part.
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

    /// The triples a term takes part in. A negative power of sine or cosine is the m of 1/cos² = 1 + tan².
    fn triples(&self, term: &Term) -> Vec<Triple> {
        let (Number::Exact { radicand, .. }, Node::Product(factors)) =
            (term.coefficient, self.node(term.expr))
        else {
            return Vec::new();
        };
        if factors.len() > LONGEST_PRODUCT {
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
        // A zero in place keeps its radicand, so that the terms stay sorted until they are merged.
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

    /// The expression of canonical factors, if it exists.
    fn find_monomial(&self, factors: &[Factor]) -> Option<ExprId> {
        match factors {
            [] => Some(self.one()),
            [factor] if factor.exponent == Rational::ONE => Some(factor.base),
            _ => self.find(&Node::Product(factors.into())),
        }
    }
}

/// The factors times `base ^ exponent`; `None` where the exponent does not fit.
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
