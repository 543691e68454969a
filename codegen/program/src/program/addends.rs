//! Splits expressions into the additions, multiplications and divisions that compute them.
//!
//! A named expression is used by its name and not split again.

use super::passes::constants::ConstantPart;
use crate::expr::{Comparison, ExprId, Factor, Graph, Node, Number, Rational, Term};
use crate::system::WrittenOrder;

/// Term of a sum as it is computed.
#[derive(Clone, Debug, PartialEq)]
pub struct Addend {
    /// True if the term is subtracted.
    pub negative: bool,
    /// Constant factor, or the whole of a constant term.
    pub constant: Option<ConstantPart>,
    /// Factors of the numerator.
    pub factors: Vec<Power>,
    /// Factors of the denominator.
    pub divisors: Vec<Power>,
}

/// Positive power of an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Power {
    /// Base of the power.
    pub base: ExprId,
    /// Exponent.
    pub exponent: Rational,
}

/// Returns the addends of an expression in written order. `named` is true for named expressions; the expression itself is always
/// split.
pub fn addends(
    expr: ExprId,
    graph: &Graph,
    order: &WrittenOrder<'_>,
    named: &dyn Fn(ExprId) -> bool,
) -> Vec<Addend> {
    let terms = match graph.node(expr) {
        Node::Sum(terms) => order.terms(terms),
        Node::Number(number) => vec![Term {
            coefficient: *number,
            expr: graph.one(),
        }],
        _ => vec![Term {
            coefficient: Number::ONE,
            expr,
        }],
    };
    // Only the expression itself is split although it has a name.
    addends_of(&terms, graph, order, &|term| term != expr && named(term))
}

/// Condition as it is computed: two sides, of which the second may be empty for 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Compared {
    /// Left side.
    pub left: Vec<Addend>,
    /// True if the sign is `<`, and not `>`.
    pub is_less: bool,
    /// Right side.
    pub right: Vec<Addend>,
}

/// Returns both sides of `condition < 0` in written order.
pub fn compared(
    condition: ExprId,
    graph: &Graph,
    order: &WrittenOrder<'_>,
    named: &dyn Fn(ExprId) -> bool,
) -> Compared {
    let Comparison {
        left,
        is_less,
        right,
    } = graph.comparison(condition);
    let [left, right] =
        [left, right].map(|terms| addends_of(&order.terms(&terms), graph, order, named));
    Compared {
        left,
        is_less,
        right,
    }
}

/// Returns the addends of terms in their order, with all constant terms in one.
fn addends_of(
    terms: &[Term],
    graph: &Graph,
    order: &WrittenOrder<'_>,
    named: &dyn Fn(ExprId) -> bool,
) -> Vec<Addend> {
    let constant_terms: Vec<Term> = terms
        .iter()
        .copied()
        .filter(|term| graph.is_constant(term.expr))
        .collect();
    let mut addends = Vec::with_capacity(terms.len());
    let mut constants_placed = false;
    for term in terms {
        if !graph.is_constant(term.expr) {
            addends.push(variable_addend(term, named(term.expr), graph, order));
        } else if !constants_placed {
            constants_placed = true;
            addends.push(constant_addend(&constant_terms));
        }
    }
    addends
}

/// Returns the bases of the powers in these addends.
pub(super) fn bases(parts: &[Addend]) -> impl Iterator<Item = ExprId> {
    let powers = parts
        .iter()
        .flat_map(|part| part.factors.iter().chain(&part.divisors));
    powers.map(|power| power.base)
}

/// Returns all constant terms of a sum as one.
fn constant_addend(terms: &[Term]) -> Addend {
    let negative = terms[0].coefficient.is_negative();
    let signed = |term: &Term| Term {
        coefficient: if negative {
            term.coefficient.neg()
        } else {
            term.coefficient
        },
        expr: term.expr,
    };
    let part = ConstantPart::Sum(terms.iter().map(signed).collect());
    Addend {
        negative,
        constant: Some(part),
        factors: Vec::new(),
        divisors: Vec::new(),
    }
}

fn variable_addend(term: &Term, whole: bool, graph: &Graph, order: &WrittenOrder<'_>) -> Addend {
    let negative = term.coefficient.is_negative();
    let magnitude = if negative {
        term.coefficient.neg()
    } else {
        term.coefficient
    };
    let factors = match graph.node(term.expr) {
        Node::Product(factors) if !whole => order.factors(factors),
        _ => vec![Factor {
            base: term.expr,
            exponent: Rational::ONE,
        }],
    };
    let (constant, variable): (Vec<Factor>, Vec<Factor>) = factors
        .into_iter()
        .partition(|factor| graph.is_constant(factor.base));
    let constant = match constant.as_slice() {
        [] if magnitude == Number::ONE => None,
        [only] if only.exponent == Rational::ONE => Some(ConstantPart::Sum(vec![Term {
            coefficient: magnitude,
            expr: only.base,
        }])),
        [] => Some(ConstantPart::Sum(vec![Term {
            coefficient: magnitude,
            expr: graph.one(),
        }])),
        _ => Some(ConstantPart::Product(magnitude, constant)),
    };
    let (below, above): (Vec<Factor>, Vec<Factor>) = variable
        .into_iter()
        .partition(|factor| factor.exponent.is_negative());
    let power = |factor: &Factor| Power {
        base: factor.base,
        exponent: factor.exponent,
    };
    let reciprocal = |factor: &Factor| Power {
        base: factor.base,
        exponent: -factor.exponent,
    };
    Addend {
        negative,
        constant,
        factors: above.iter().map(power).collect(),
        divisors: below.iter().map(reciprocal).collect(),
    }
}
