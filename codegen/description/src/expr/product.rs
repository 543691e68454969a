//! Constructs products and powers in canonical form.
//!
//! Powers of one base are merged. Numbers and the contents of sums are collected in one coefficient, which becomes that of a
//! term of a sum. A product of sums is not expanded.
//!
//! `(x^a)^b` becomes `x^(ab)` if both agree for every real x at which the left side has a value: for an integer b, and for any
//! b unless a is an even integer (`√(x²)` is |x|). `(x·y)^b` is split for an integer b only, as x and y may both be negative. A
//! positive number is moved out of a root if its own root is exact. Otherwise, as for 3 in a fourth root, roots of different
//! multiples of one expression remain separate, so some equalities are not recognized.

use super::graph::Graph;
use super::node::{ExprId, Factor, Node};
use super::number::Number;
use super::rational::Rational;

/// A product under construction.
#[derive(Debug)]
pub(super) struct Monomial {
    pub(super) coefficient: Number,
    pub(super) factors: Vec<Factor>,
    /// True if an exponent did not fit.
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
    /// Returns `a · b`.
    pub fn multiply(&mut self, a: ExprId, b: ExprId) -> ExprId {
        match (self.as_number(a), self.as_number(b)) {
            (Some(coefficient), _) => self.scale(coefficient, b),
            (_, Some(coefficient)) => self.scale(coefficient, a),
            _ => self.product(&[a, b]),
        }
    }

    /// Returns `a / b`; NaN for a constant zero b.
    pub fn divide(&mut self, a: ExprId, b: ExprId) -> ExprId {
        let reciprocal = self.power(b, -Rational::ONE);
        self.multiply(a, reciprocal)
    }

    /// Returns the product of all factors; 1 for none.
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

    /// Returns `base ^ exponent`; 1 for the exponent 0. A constant zero to a negative power and a negative number to a
    /// non-integer power give a non-finite number.
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

    /// Returns the square root.
    pub fn sqrt(&mut self, radicand: ExprId) -> ExprId {
        self.power(radicand, Rational::HALF)
    }

    /// Multiplies by `base ^ exponent`, split into factors as far as that is valid.
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

    /// Multiplies by the power of a sum from which `content` can be factored out.
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
            // The term itself, without a division, which would round a float coefficient.
            Node::Sum(ref terms) if terms.len() == 1 && removed == content => terms[0].expr,
            Node::Sum(ref terms) if terms.len() == 1 && removed == content.neg() => {
                let expr = terms[0].expr;
                self.negate(expr)
            }
            _ => self.scale(removed.recip(), base),
        };
        monomial.scale(removed.pow(exponent));
        match self.node(rest) {
            // The rest stays under the root; the content of a primitive sum has been removed.
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

    /// Multiplies by a non-integer power of a base that splits under integer powers. The integer part of the exponent is split
    /// off, so that x·y·√(x·y) and (x·y)^(3/2) are equal.
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

    /// Returns the expression of a product; NaN if it is undefined or an exponent does not fit.
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

    /// Sorts by base and adds exponents. Returns true if roots were merged: their radicands may then have split into factors
    /// that must be merged again.
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

    /// Joins integer powers of a primitive sum to a root of its multiple, (x - y)·√(y - x) = -(y - x)^(3/2). A root and its
    /// derivatives then share one sum.
    ///
    /// Among several roots of multiples of one primitive sum, the root of the sum itself receives the integer powers. Without
    /// such a root, the first root does.
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

    /// Returns the expression of canonical factors.
    pub(super) fn monomial(&mut self, factors: Vec<Factor>) -> ExprId {
        match factors[..] {
            [] => self.one(),
            [factor] if factor.exponent == Rational::ONE => factor.base,
            _ => self.intern(Node::Product(factors.into())),
        }
    }
}

/// Moves the integer powers of these roots, and of their primitive sum, to one of them. `None` if an exponent does not fit.
fn join_same_primitive(monomial: &mut Monomial, roots: &[(ExprId, usize, Number)]) -> Option<()> {
    let (primitive, first, first_content) = roots[0];
    let own_factor = monomial
        .factors
        .binary_search_by_key(&primitive, |factor| factor.base)
        .ok();
    let mut total = own_factor.map_or(Rational::ZERO, |own_factor| {
        monomial.factors[own_factor].exponent
    });
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
    // A zero marks a factor for later removal, so that indices remain valid. Without a factor of its own, the primitive sum has
    // an integer total, which has been moved.
    if let Some(own_factor) = own_factor {
        monomial.factors[own_factor].exponent = total;
    }
    Some(())
}

/// Returns the greatest part of a positive number whose power is exact: the number, its rational factor, or 1. A float has no
/// exact root and is split off completely.
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
