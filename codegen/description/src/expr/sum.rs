//! Constructs sums in canonical form.
//!
//! Nested sums are flattened, like terms merged, numeric coefficients distributed, zeros removed, and sin² + cos² reduced (see
//! `pythagoras`). Products are not expanded. The result is independent of the order of the addends. With floats, it may differ
//! by rounding from the same sum built in steps.

use super::graph::Graph;
use super::node::{ExprId, Node, Term};
use super::number::Number;

impl Graph {
    /// Returns `a + b`.
    pub fn add(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.combine(&[(Number::ONE, a), (Number::ONE, b)])
    }

    /// Returns `a - b`.
    pub fn subtract(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.combine(&[(Number::ONE, a), (Number::integer(-1), b)])
    }

    /// Returns `-a`.
    pub fn negate(&mut self, a: ExprId) -> ExprId {
        self.scale(Number::integer(-1), a)
    }

    /// Returns the sum of all addends; 0 for none. One call takes time proportional to the number of terms; repeated additions
    /// take quadratic time.
    pub fn sum(&mut self, addends: &[ExprId]) -> ExprId {
        let parts: Vec<(Number, ExprId)> = addends
            .iter()
            .map(|&addend| (Number::ONE, addend))
            .collect();
        self.combine(&parts)
    }

    /// Returns `coefficient · expr`, distributed over a sum.
    pub fn scale(&mut self, coefficient: Number, expr: ExprId) -> ExprId {
        if let Some(value) = self.as_number(expr) {
            return self.number(coefficient.mul(value));
        }
        if coefficient.is_one() {
            return expr;
        }
        if let (Number::Exact { radicand: 1, .. }, Node::Sum(terms), false) =
            (coefficient, self.node(expr), coefficient.is_zero())
        {
            // A rational factor keeps radicands, and thus the order and number of terms, unless one becomes a float.
            let scaled: Vec<Term> = terms
                .iter()
                .map(|term| Term {
                    coefficient: coefficient.mul(term.coefficient),
                    expr: term.expr,
                })
                .collect();
            if scaled
                .iter()
                .all(|term| matches!(term.coefficient, Number::Exact { .. }))
            {
                return self.canonical_sum(scaled);
            }
        }
        self.combine(&[(coefficient, expr)])
    }

    /// Returns the sum of `coefficient · expr` over all parts.
    pub(super) fn combine(&mut self, parts: &[(Number, ExprId)]) -> ExprId {
        if let [(coefficient, expr)] = parts
            && coefficient.is_one()
        {
            return *expr;
        }
        let mut terms = Vec::with_capacity(parts.len());
        for &(coefficient, expr) in parts {
            if !coefficient.is_finite() || !self.is_finite(expr) {
                return self.not_a_number();
            }
            self.gather(coefficient, expr, &mut terms);
        }
        if !merge_like_terms(&mut terms) {
            return self.not_a_number();
        }
        while self.reduce_squares(&mut terms) {
            if !merge_like_terms(&mut terms) {
                return self.not_a_number();
            }
        }
        self.canonical_sum(terms)
    }

    /// Appends the terms of `coefficient · expr`.
    pub(super) fn gather(&self, coefficient: Number, expr: ExprId, terms: &mut Vec<Term>) {
        match self.node(expr) {
            Node::Number(value) => terms.push(Term {
                coefficient: coefficient.mul(*value),
                expr: self.one(),
            }),
            Node::Sum(inner) => terms.extend(inner.iter().map(|term| Term {
                coefficient: coefficient.mul(term.coefficient),
                expr: term.expr,
            })),
            _ => terms.push(Term { coefficient, expr }),
        }
    }

    /// Returns the expression for terms that are sorted, merged and not zero.
    pub(super) fn canonical_sum(&mut self, terms: Vec<Term>) -> ExprId {
        self.ledger.touch(terms.len());
        match terms[..] {
            [] => self.zero(),
            [term] if term.expr == self.one() => self.number(term.coefficient),
            [term] if term.coefficient.is_one() => term.expr,
            _ => self.intern(Node::Sum(terms.into())),
        }
    }
}

/// Returns the sort key of a term. A float absorbs all others of its expression, and comes first. Floats are sorted by their
/// bits, so that their sum is independent of the given order.
fn sort_key(term: &Term) -> (ExprId, u128, u64) {
    match term.coefficient {
        Number::Exact { radicand, .. } => (term.expr, radicand, 0),
        Number::Float(value) => (term.expr, 0, value.to_bits()),
    }
}

/// Returns the index of the term with this expression and radicand among merged terms; `None` if there is none.
pub(super) fn find_term(terms: &[Term], expr: ExprId, radicand: u128) -> Option<usize> {
    terms
        .binary_search_by(|term| {
            let (at, under, _) = sort_key(term);
            (at, under).cmp(&(expr, radicand))
        })
        .ok()
}

/// Sorts, merges like terms and removes zeros; returns false if a coefficient is not finite.
fn merge_like_terms(terms: &mut Vec<Term>) -> bool {
    terms.sort_unstable_by_key(sort_key);
    let mut finite = true;
    let mut kept = 0;
    let mut start = 0;
    let mut merged: Vec<Number> = Vec::new();
    while start < terms.len() {
        let expr = terms[start].expr;
        merged.clear();
        let mut next = start;
        while next < terms.len() && terms[next].expr == expr {
            merge_coefficient(&mut merged, terms[next].coefficient);
            next += 1;
        }
        if merged.iter().any(|part| matches!(part, Number::Float(_))) {
            let total = merged.iter().map(Number::to_f64).sum();
            merged.clear();
            merged.push(Number::float(total));
        }
        for &coefficient in merged.iter().filter(|part| !part.is_zero()) {
            finite &= coefficient.is_finite();
            terms[kept] = Term { coefficient, expr };
            kept += 1;
        }
        start = next;
    }
    terms.truncate(kept);
    finite
}

/// Adds to the last coefficient, or appends for a different radicand. Floats stay separate until all exact parts are summed.
fn merge_coefficient(merged: &mut Vec<Number>, coefficient: Number) {
    if let (Some(last @ Number::Exact { .. }), Number::Exact { .. }) =
        (merged.last_mut(), coefficient)
        && let Some(total) = last.add(coefficient)
    {
        *last = total;
    } else {
        merged.push(coefficient);
    }
}
