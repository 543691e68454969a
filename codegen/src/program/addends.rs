//! An expression → the additions, multiplications and divisions that compute it.
//!
//! What has a name of its own is not taken apart again.

use super::constants::ConstantPart;
use crate::expr::{ExprId, Factor, Graph, Node, Number, Rational, Term};
use crate::system::WrittenOrder;

/// One term of a sum as it is computed.
#[derive(Clone, Debug, PartialEq)]
pub struct Addend {
    /// Whether it is subtracted.
    pub negative: bool,
    /// The constant factor, or the whole of a constant term.
    pub constant: Option<ConstantPart>,
    /// What is multiplied.
    pub factors: Vec<Power>,
    /// What is divided by.
    pub divisors: Vec<Power>,
}

/// A positive power of an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Power {
    /// What is raised.
    pub base: ExprId,
    /// To which power.
    pub exponent: Rational,
}

/// The addends of an expression in written order. `named` tells which expressions have a name; the expression itself is
/// always taken apart.
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
    let constant_terms: Vec<Term> = terms
        .iter()
        .copied()
        .filter(|term| graph.is_constant(term.expr))
        .collect();
    let mut addends = Vec::with_capacity(terms.len());
    let mut constants_placed = false;
    for term in &terms {
        if !graph.is_constant(term.expr) {
            // Only the expression itself is taken apart although it has a name.
            let whole = term.expr != expr && named(term.expr);
            addends.push(variable_addend(term, whole, graph, order));
        } else if !constants_placed {
            constants_placed = true;
            addends.push(constant_addend(&constant_terms));
        }
    }
    addends
}

/// All constant terms of a sum as one.
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
