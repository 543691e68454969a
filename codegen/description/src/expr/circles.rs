//! Reduces polynomials over unit circles to a normal form, in which no sine is squared.
//!
//! With s² = r² − c², a polynomial has only one form, so a polynomial that vanishes on the circles becomes zero. Expressions
//! that are not polynomials of the symbols, or too long, have no normal form.

use std::collections::BTreeMap;

use super::graph::Graph;
use super::node::{ExprId, Factor, Node, SymbolId};
use super::number::Number;
use super::rational::Rational;

/// Maximum number of terms of a polynomial.
const MAX_TERMS: usize = 512;

/// Maximum depth of an expression.
const MAX_DEPTH: u32 = 64;

/// Two symbols that are components of a vector of known length.
#[derive(Clone, Copy, Debug)]
pub struct Circle {
    /// First component.
    pub cosine: SymbolId,
    /// Second component.
    pub sine: SymbolId,
    /// Square of the length.
    pub square: ExprId,
}

/// Distinct factors with their powers, ascending.
type Powers = Vec<(ExprId, u32)>;

/// Powers of a monomial, and the radicand of its coefficient.
type Monomial = (Powers, u128);

/// Nonzero coefficients by monomial.
type Polynomial = BTreeMap<Monomial, Number>;

impl Graph {
    /// Returns the normal form on these circles; `None` if the expression is not a polynomial, or too long.
    pub fn on_circles(&mut self, expr: ExprId, circles: &[Circle]) -> Option<ExprId> {
        let polynomial = self.polynomial(expr, circles)?;
        self.ledger.touch(polynomial.len());
        let mut terms = Vec::with_capacity(polynomial.len());
        for ((factors, _), coefficient) in polynomial {
            let mut powers = Vec::with_capacity(factors.len());
            for (base, power) in factors {
                powers.push(self.power(base, Rational::integer(i64::from(power))));
            }
            let product = self.product(&powers);
            terms.push(self.scale(coefficient, product));
        }
        Some(self.sum(&terms))
    }

    fn polynomial(&mut self, expr: ExprId, circles: &[Circle]) -> Option<Polynomial> {
        if self.depth(expr) > MAX_DEPTH {
            return None;
        }
        match self.node(expr).clone() {
            Node::Number(value) => plus(Polynomial::new(), Vec::new(), value),
            Node::Sum(terms) => {
                let mut sum = Polynomial::new();
                for term in terms.iter() {
                    for ((factors, _), coefficient) in self.polynomial(term.expr, circles)? {
                        let scaled = coefficient.mul(term.coefficient);
                        sum = plus(sum, factors, scaled)?;
                    }
                }
                Some(sum)
            }
            Node::Product(factors) => self.multiplied_out(&factors, circles),
            _ => plus(Polynomial::new(), vec![(expr, 1)], Number::ONE),
        }
    }

    /// Expands integer powers of sums; any other factor is kept.
    fn multiplied_out(&mut self, factors: &[Factor], circles: &[Circle]) -> Option<Polynomial> {
        let mut product = plus(Polynomial::new(), Vec::new(), Number::ONE)?;
        for &Factor { base, exponent } in factors {
            let whole = exponent.is_integer().then(|| exponent.numerator());
            match whole.and_then(|it| u32::try_from(it).ok()) {
                Some(power) => {
                    let one = self.polynomial(base, circles)?;
                    for _ in 0..power {
                        product = self.times(&product, &one, circles)?;
                    }
                }
                None => {
                    // Any other power that contains a circle's symbol is not a polynomial.
                    let is_round = |it: &Circle| {
                        [it.cosine, it.sine]
                            .iter()
                            .any(|own| self.depends_on(base, *own))
                    };
                    if circles.iter().any(is_round) {
                        return None;
                    }
                    let alone = self.power(base, exponent);
                    let alone = plus(Polynomial::new(), vec![(alone, 1)], Number::ONE)?;
                    product = self.times(&product, &alone, circles)?;
                }
            }
        }
        Some(product)
    }

    fn times(
        &mut self,
        one: &Polynomial,
        other: &Polynomial,
        circles: &[Circle],
    ) -> Option<Polynomial> {
        let mut product = Polynomial::new();
        self.ledger.touch(one.len() * other.len());
        for ((left, _), by) in one {
            for ((right, _), with) in other {
                let factors = merged(left, right);
                let coefficient = by.mul(*with);
                for (factors, sign) in self.on_circle(factors, circles)? {
                    product = plus(product, factors, coefficient.mul(sign))?;
                }
            }
        }
        Some(product)
    }

    /// Replaces squares of sines in a monomial by s² = r² − c².
    fn on_circle(&mut self, factors: Powers, circles: &[Circle]) -> Option<Vec<(Powers, Number)>> {
        let squared = circles.iter().find_map(|circle| {
            let sine = self.variable(circle.sine);
            let at = factors
                .iter()
                .position(|&(base, power)| base == sine && power > 1)?;
            Some((at, *circle))
        });
        let Some((at, circle)) = squared else {
            return Some(vec![(factors, Number::ONE)]);
        };
        let mut rest = factors;
        rest[at].1 -= 2;
        rest.retain(|factor| factor.1 > 0);
        let cosine = self.variable(circle.cosine);
        let minus = merged(&rest, &[(cosine, 2)]);
        let mut terms = Vec::new();
        for (factors, coefficient) in self.on_circle(minus, circles)? {
            terms.push((factors, coefficient.neg()));
        }
        for ((square, _), coefficient) in self.polynomial(circle.square, &[])? {
            let plus = merged(&rest, &square);
            for (factors, sign) in self.on_circle(plus, circles)? {
                terms.push((factors, coefficient.mul(sign)));
            }
        }
        Some(terms)
    }
}

/// Returns the product of two monomials.
fn merged(one: &[(ExprId, u32)], other: &[(ExprId, u32)]) -> Powers {
    let mut all = one.to_vec();
    for &(base, power) in other {
        match all.binary_search_by_key(&base, |factor| factor.0) {
            Ok(at) => all[at].1 += power,
            Err(at) => all.insert(at, (base, power)),
        }
    }
    all
}

/// Adds a term to a polynomial; roots of different radicands are separate.
fn plus(mut polynomial: Polynomial, factors: Powers, coefficient: Number) -> Option<Polynomial> {
    let radicand = match coefficient {
        Number::Exact { radicand, .. } => radicand,
        Number::Float(_) => 0,
    };
    let place = (factors, radicand);
    let sum = match polynomial.get(&place) {
        Some(known) => known.add(coefficient)?,
        None => coefficient,
    };
    if sum.is_zero() {
        polynomial.remove(&place);
    } else {
        polynomial.insert(place, sum);
    }
    (polynomial.len() <= MAX_TERMS).then_some(polynomial)
}

#[cfg(test)]
mod tests {
    use super::{Circle, Graph};

    #[test]
    fn a_turned_vector_keeps_its_length() {
        let mut graph = Graph::new();
        let [c, s, d, r, a, b] = ["c", "s", "d", "r", "a", "b"].map(|it| graph.symbol(it));
        let one = graph.one();
        let circles = [(c, s), (d, r)].map(|(cosine, sine)| Circle {
            cosine,
            sine,
            square: one,
        });
        let [c, s, d, r, a, b] = [c, s, d, r, a, b].map(|it| graph.variable(it));
        // R_y(p) R_x(q) (0, a, b)
        let g = {
            let [ra, db] = [graph.multiply(r, a), graph.multiply(d, b)];
            graph.add(ra, db)
        };
        let y = {
            let [da, rb] = [graph.multiply(d, a), graph.multiply(r, b)];
            graph.subtract(da, rb)
        };
        let parts = [graph.multiply(s, g), y, graph.multiply(c, g)];
        let squares = parts.map(|it| graph.multiply(it, it));
        let length = graph.sum(&squares);
        let [aa, bb] = [graph.multiply(a, a), graph.multiply(b, b)];
        let square = graph.add(aa, bb);
        assert_eq!(graph.on_circles(length, &circles), Some(square));
        let gap = graph.subtract(length, square);
        assert_eq!(graph.on_circles(gap, &circles), Some(graph.zero()));
    }
}
