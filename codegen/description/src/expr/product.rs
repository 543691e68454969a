//! Products and powers: *factors in any order* → *the canonical product with its coefficient*.
//!
//! Powers of one base are merged, numbers and the contents of sums are collected in one coefficient, which ends up in the
//! term of a sum. A product of sums is not multiplied out.
//!
//! `(x^a)^b` becomes `x^(ab)` where both agree for every real x at which the left side has a value: for a whole b, and
//! for any b unless a is a whole even number (`√(x²)` is |x|). `(x·y)^b` is split for a whole b only: x and y may both
//! be negative. A positive number leaves a root where its own root is exact; where it is not, as 3 in a fourth root, roots of
//! different multiples of one expression stay apart, and not every equality between them is seen.

use super::graph::Graph;
use super::node::{ExprId, Factor, Node};
use super::number::Number;
use super::rational::Rational;

/// A product under construction.
#[derive(Debug)]
pub(super) struct Monomial {
    pub(super) coefficient: Number,
    pub(super) factors: Vec<Factor>,
    /// Whether an exponent did not fit.
    overflow: bool,
}

impl Monomial {
    pub(super) fn new(coefficient: Number) -> Monomial {
        Monomial {
            coefficient,
            factors: Vec::new(),
            overflow: false,
        }
    }

    fn scale(&mut self, coefficient: Number) {
        self.coefficient = self.coefficient.mul(coefficient);
    }

    pub(super) fn push(&mut self, base: ExprId, exponent: Rational) {
        self.factors.push(Factor { base, exponent });
    }
}

impl Graph {
    /// `a · b`.
    pub fn multiply(&mut self, a: ExprId, b: ExprId) -> ExprId {
        match (self.as_number(a), self.as_number(b)) {
            (Some(coefficient), _) => self.scale(coefficient, b),
            (_, Some(coefficient)) => self.scale(coefficient, a),
            _ => self.product(&[a, b]),
        }
    }

    /// `a / b`; NaN for a constant zero b.
    pub fn divide(&mut self, a: ExprId, b: ExprId) -> ExprId {
        let reciprocal = self.power(b, -Rational::ONE);
        self.multiply(a, reciprocal)
    }

    /// The product of all factors; 1 for none.
    pub fn product(&mut self, factors: &[ExprId]) -> ExprId {
        if let [factor] = factors {
            return *factor;
        }
        if self.any_non_finite(factors) {
            return self.not_a_number();
        }
        let mut monomial = Monomial::new(Number::ONE);
        for &factor in factors {
            self.push_power(&mut monomial, factor, Rational::ONE);
        }
        self.finish(monomial)
    }

    /// `base ^ exponent`. 1 for the exponent 0; a constant zero to a negative power and a negative number to a power that is
    /// not whole give a non-finite number.
    pub fn power(&mut self, base: ExprId, exponent: Rational) -> ExprId {
        if exponent == Rational::ONE {
            return base;
        }
        if !self.is_finite(base) {
            return self.not_a_number();
        }
        if let Some(value) = self.as_number(base) {
            return self.number(value.pow(exponent));
        }
        let mut monomial = Monomial::new(Number::ONE);
        self.push_power(&mut monomial, base, exponent);
        self.finish(monomial)
    }

    /// The square root.
    pub fn sqrt(&mut self, radicand: ExprId) -> ExprId {
        self.power(radicand, Rational::HALF)
    }

    /// Multiplies by `base ^ exponent`, taken apart as far as that is valid.
    pub(super) fn push_power(&mut self, monomial: &mut Monomial, base: ExprId, exponent: Rational) {
        if exponent.is_zero() {
            return;
        }
        match self.node(base) {
            Node::Number(value) => monomial.scale(value.pow(exponent)),
            Node::Sum(terms) => {
                let (content, size) = match terms[..] {
                    [term] => (term.coefficient, 1),
                    _ => (self.content(terms), terms.len()),
                };
                self.ledger.touch(size);
                self.push_scaled(monomial, base, content, exponent);
            }
            Node::Product(factors) => {
                let factors = factors.clone();
                self.push_product(monomial, base, &factors, exponent);
            }
            _ => monomial.push(base, exponent),
        }
    }

    /// Multiplies by the power of a sum, of which `content` can be taken out.
    fn push_scaled(
        &mut self,
        monomial: &mut Monomial,
        base: ExprId,
        content: Number,
        exponent: Rational,
    ) {
        let removed = if exponent.is_integer() {
            content
        } else {
            positive_root(content.absolute(), exponent)
        };
        if removed.is_one() {
            return match self.node(base) {
                Node::Sum(terms) if terms.len() > 1 => monomial.push(base, exponent),
                _ => self.push_root(monomial, base, exponent),
            };
        }
        let rest = match *self.node(base) {
            // Divided without rounding, which a float coefficient would not survive.
            Node::Sum(ref terms) if terms.len() == 1 && removed == content => terms[0].expr,
            Node::Sum(ref terms) if terms.len() == 1 && removed == content.neg() => {
                let expr = terms[0].expr;
                self.negate(expr)
            }
            _ => self.scale(removed.recip(), base),
        };
        monomial.scale(removed.pow(exponent));
        match self.node(rest) {
            // What cannot leave the root stays in it; the content of a primitive sum has been taken out.
            Node::Sum(terms) if terms.len() > 1 => monomial.push(rest, exponent),
            Node::Sum(_) => self.push_root(monomial, rest, exponent),
            _ => self.push_power(monomial, rest, exponent),
        }
    }

    fn push_product(
        &mut self,
        monomial: &mut Monomial,
        base: ExprId,
        factors: &[Factor],
        exponent: Rational,
    ) {
        let even = |power: Rational| power.is_integer() && power.numerator() % 2 == 0;
        let splits = match factors {
            _ if exponent.is_integer() => true,
            [factor] => !even(factor.exponent),
            _ => false,
        };
        if !splits {
            return self.push_root(monomial, base, exponent);
        }
        for factor in factors {
            match factor.exponent.checked_mul(exponent) {
                // A canonical factor stays canonical unless it is or becomes a root.
                Some(power) if power.is_integer() && factor.exponent.is_integer() => {
                    monomial.push(factor.base, power);
                }
                Some(power) => self.push_power(monomial, factor.base, power),
                None => monomial.overflow = true,
            }
        }
    }

    /// Multiplies by a power, not a whole one, of a base that comes apart under a whole power. The whole part of the
    /// exponent is taken apart, so that x·y·√(x·y) and (x·y)^(3/2) are the same.
    fn push_root(&mut self, monomial: &mut Monomial, base: ExprId, exponent: Rational) {
        let whole = exponent.numerator().div_euclid(exponent.denominator());
        let fraction = exponent.numerator().rem_euclid(exponent.denominator());
        match (
            Rational::new(whole, 1),
            Rational::new(fraction, exponent.denominator()),
        ) {
            (Some(whole), Some(fraction)) => {
                monomial.push(base, fraction);
                self.push_power(monomial, base, whole);
            }
            _ => monomial.overflow = true,
        }
    }

    /// The expression of a product; NaN where it is undefined or an exponent does not fit.
    pub(super) fn finish(&mut self, mut monomial: Monomial) -> ExprId {
        self.ledger.touch(monomial.factors.len());
        while self.merge_powers(&mut monomial) {}
        self.join_roots(&mut monomial);
        if monomial.overflow || !monomial.coefficient.is_finite() {
            return self.not_a_number();
        }
        let expr = self.monomial(monomial.factors);
        self.scale(monomial.coefficient, expr)
    }

    /// Sorts by base and adds exponents; answers whether roots were merged, so that what was under them may have come apart
    /// into factors that must be merged again.
    fn merge_powers(&mut self, monomial: &mut Monomial) -> bool {
        let mut factors = std::mem::take(&mut monomial.factors);
        factors.sort_unstable_by_key(|factor| factor.base);
        let mut merged_roots = false;
        let has_root =
            |same_base: &[Factor]| same_base.iter().any(|factor| !factor.exponent.is_integer());
        for same_base in factors.chunk_by(|left, right| left.base == right.base) {
            let Factor { base, exponent } = same_base[0];
            let total = same_base[1..]
                .iter()
                .try_fold(exponent, |total, factor| total.checked_add(factor.exponent));
            match total {
                None => monomial.overflow = true,
                Some(total) if total.is_zero() => {}
                Some(total) if same_base.len() > 1 && has_root(same_base) => {
                    merged_roots = true;
                    self.push_power(monomial, base, total);
                }
                Some(total) => monomial.push(base, total),
            }
        }
        merged_roots
    }

    /// Joins whole powers of a primitive sum to a root of its multiple, (x - y)·√(y - x) = -(y - x)^(3/2): then a root and
    /// its derivatives need one sum, not two.
    ///
    /// Among several roots of multiples of one primitive sum the whole powers go to that of the sum itself, if there is one,
    /// otherwise to the first.
    fn join_roots(&mut self, monomial: &mut Monomial) {
        let mut roots = Vec::new();
        for (place, factor) in monomial.factors.iter().enumerate() {
            let (content, size) = match self.node(factor.base) {
                Node::Sum(terms) if terms.len() > 1 && !factor.exponent.is_integer() => {
                    (self.content(terms), terms.len())
                }
                _ => continue,
            };
            self.ledger.touch(size);
            if !content.is_one() {
                let primitive = self.scale(content.recip(), factor.base);
                roots.push((primitive, place, content));
            }
        }
        roots.sort_unstable_by_key(|&(primitive, place, _)| (primitive, place));
        for same_primitive in roots.chunk_by(|left, right| left.0 == right.0) {
            if join_same_primitive(monomial, same_primitive).is_none() {
                monomial.overflow = true;
            }
        }
        monomial.factors.retain(|factor| !factor.exponent.is_zero());
    }

    /// The expression of canonical factors.
    pub(super) fn monomial(&mut self, factors: Vec<Factor>) -> ExprId {
        match factors[..] {
            [] => self.one(),
            [factor] if factor.exponent == Rational::ONE => factor.base,
            _ => self.intern(Node::Product(factors.into())),
        }
    }
}

/// Gives the whole powers of these roots, and those of their primitive sum, to one of them. `None` where an exponent does
/// not fit.
fn join_same_primitive(monomial: &mut Monomial, roots: &[(ExprId, usize, Number)]) -> Option<()> {
    let (primitive, first, first_content) = roots[0];
    let own = monomial
        .factors
        .binary_search_by_key(&primitive, |factor| factor.base)
        .ok();
    let mut total = own.map_or(Rational::ZERO, |own| monomial.factors[own].exponent);
    for &(_, place, content) in roots {
        let exponent = monomial.factors[place].exponent;
        let whole = Rational::new(exponent.numerator().div_euclid(exponent.denominator()), 1)?;
        monomial.factors[place].exponent = exponent.checked_sub(whole)?;
        monomial.scale(content.pow(whole));
        total = total.checked_add(whole)?;
    }
    if total.is_integer() {
        let exponent = &mut monomial.factors[first].exponent;
        *exponent = exponent.checked_add(total)?;
        monomial.scale(first_content.pow(-total));
        total = Rational::ZERO;
    }
    // A zero marks a factor that is removed later: places must not move yet. Without a factor of its own the primitive sum
    // has a whole total, which has been given away.
    if let Some(own) = own {
        monomial.factors[own].exponent = total;
    }
    Some(())
}

/// The largest part of a positive number whose power is exact: all of it, or its rational factor, or nothing. A float has
/// no exact root and leaves whole.
fn positive_root(content: Number, exponent: Rational) -> Number {
    if content.exact_pow(exponent).is_some() || matches!(content, Number::Float(_)) {
        return content;
    }
    let rational = match content {
        Number::Exact { rational, .. } => Number::rational(rational),
        Number::Float(_) => Number::ONE,
    };
    if rational.exact_pow(exponent).is_some() {
        rational
    } else {
        Number::ONE
    }
}
