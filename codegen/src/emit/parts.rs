//! Splits a term of a sum into the factors of a textbook fraction.

use crate::expr::{ExprId, Factor, Graph, MAX_EXACT_LENGTH, Node, Number, Rational, Term};
use crate::program::ConstantPart;
use crate::system::WrittenOrder;

/// Term without its sign: a fraction.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Fraction {
    /// Factors above the bar; empty for 1.
    pub numerators: Vec<Part>,
    /// Factors below the bar; empty for 1.
    pub denominators: Vec<Part>,
}

impl Fraction {
    /// Multiplies by a power; a negative one goes below the bar.
    pub(super) fn push(&mut self, factor: Factor) {
        if factor.exponent.is_negative() {
            self.denominators
                .push(Part::Power(factor.base, -factor.exponent));
        } else {
            self.numerators
                .push(Part::Power(factor.base, factor.exponent));
        }
    }
}

/// Factor of a product.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Part {
    /// A number in digits.
    Digits(String),
    /// The square root of an integer.
    Root(u128),
    /// A positive power of an expression.
    Power(ExprId, Rational),
}

/// Terms of an expression in written order; an expression other than a sum is its own only term.
pub(super) fn terms(expr: ExprId, graph: &Graph, order: &WrittenOrder<'_>) -> Vec<Term> {
    match graph.node(expr) {
        Node::Sum(terms) => order.terms(terms),
        Node::Number(number) => vec![Term {
            coefficient: *number,
            expr: graph.one(),
        }],
        _ => vec![Term {
            coefficient: Number::ONE,
            expr,
        }],
    }
}

/// Term as written, with its sign.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Addend {
    /// True if it is subtracted.
    pub negative: bool,
    /// The term without its sign.
    pub fraction: Fraction,
}

/// Terms in their order: constants exactly if that is short, otherwise as decimals. Expressions for which `is_whole`
/// holds are not split.
pub(super) fn addends(
    terms: &[Term],
    graph: &Graph,
    order: &WrittenOrder<'_>,
    is_whole: &dyn Fn(ExprId) -> bool,
) -> Vec<Addend> {
    let is_constant = |term: &&Term| graph.is_constant(term.expr);
    let constants: Vec<Term> = terms.iter().filter(is_constant).copied().collect();
    let mut together = (!graph.is_sum_within(&constants, MAX_EXACT_LENGTH))
        .then(|| decimal_addend(&ConstantPart::Sum(constants), Fraction::default(), graph));
    let is_together = together.is_some();
    let mut addends = Vec::with_capacity(terms.len());
    for term in terms {
        match graph.is_constant(term.expr) && is_together {
            true => addends.extend(together.take()),
            false => addends.push(addend(term, graph, order, is_whole)),
        }
    }
    addends
}

fn addend(
    term: &Term,
    graph: &Graph,
    order: &WrittenOrder<'_>,
    is_whole: &dyn Fn(ExprId) -> bool,
) -> Addend {
    let (factors, is_whole) = match graph.node(term.expr) {
        Node::Product(_) if is_whole(term.expr) => (&[][..], true),
        Node::Product(factors) => (&**factors, false),
        _ => (&[][..], false),
    };
    let is_constant = |factor: &&Factor| graph.is_constant(factor.base);
    let constants: Vec<Factor> = factors.iter().filter(is_constant).copied().collect();
    if graph.is_product_within(term.coefficient, &constants, MAX_EXACT_LENGTH) {
        return Addend {
            negative: term.coefficient.is_negative(),
            fraction: match is_whole {
                true => whole_fraction(term, graph),
                false => fraction(term, graph, order),
            },
        };
    }
    let mut variable = Fraction::default();
    match factors {
        [] if term.expr != graph.one() => variable
            .numerators
            .push(Part::Power(term.expr, Rational::ONE)),
        factors => {
            let moving = order
                .factors(factors)
                .into_iter()
                .filter(|factor| !is_constant(&factor));
            moving.for_each(|factor| variable.push(factor));
        }
    }
    decimal_addend(
        &ConstantPart::Product(term.coefficient, constants),
        variable,
        graph,
    )
}

/// The decimal value of a constant in front of a fraction.
fn decimal_addend(constant: &ConstantPart, mut fraction: Fraction, graph: &Graph) -> Addend {
    let value = constant.value(graph);
    let digits = Part::Digits(format!("{:?}", value.abs()));
    fraction.numerators.insert(0, digits);
    Addend {
        negative: value < 0.0,
        fraction,
    }
}

/// A term whose expression is one part, without its sign.
fn whole_fraction(term: &Term, graph: &Graph) -> Fraction {
    let mut fraction = Fraction::default();
    push_number(
        term.coefficient.absolute(),
        holds_pi(term.expr, graph),
        &mut fraction,
    );
    fraction
        .numerators
        .push(Part::Power(term.expr, Rational::ONE));
    fraction
}

/// The absolute value of a term as a fraction.
pub(super) fn fraction(term: &Term, graph: &Graph, order: &WrittenOrder<'_>) -> Fraction {
    let mut fraction = Fraction::default();
    push_number(
        term.coefficient.absolute(),
        holds_pi(term.expr, graph),
        &mut fraction,
    );
    if term.expr == graph.one() {
        return fraction;
    }
    match graph.node(term.expr) {
        Node::Product(factors) => {
            for factor in order.factors(factors) {
                fraction.push(factor);
            }
        }
        _ => fraction
            .numerators
            .push(Part::Power(term.expr, Rational::ONE)),
    }
    fraction
}

/// True if π is a factor: multiples of π are written as fractions.
fn holds_pi(expr: ExprId, graph: &Graph) -> bool {
    match graph.node(expr) {
        Node::Pi => true,
        Node::Product(factors) => factors
            .iter()
            .any(|factor| *graph.node(factor.base) == Node::Pi),
        _ => false,
    }
}

fn push_number(number: Number, beside_pi: bool, fraction: &mut Fraction) {
    match number {
        Number::Float(value) => fraction.numerators.push(Part::Digits(format!("{value:?}"))),
        Number::Exact { rational, radicand } => {
            let (numerator, denominator) = (rational.numerator(), rational.denominator());
            let short = if beside_pi || radicand != 1 {
                None
            } else {
                decimal(numerator, denominator)
            };
            if let Some(decimal) = short {
                fraction.numerators.push(Part::Digits(decimal));
            } else {
                if numerator != 1 {
                    fraction
                        .numerators
                        .push(Part::Digits(numerator.to_string()));
                }
                if denominator != 1 {
                    fraction
                        .denominators
                        .push(Part::Digits(denominator.to_string()));
                }
            }
            if radicand != 1 {
                fraction.numerators.push(Part::Root(radicand));
            }
        }
    }
}

/// Decimal digits of a fraction; `None` for a whole number or too many digits.
fn decimal(numerator: i128, denominator: i128) -> Option<String> {
    const MAX_DECIMALS: usize = 12;
    if denominator == 1 {
        return None;
    }
    let digits =
        (1..=MAX_DECIMALS).find(|&digits| 10_i128.pow(digits as u32) % denominator == 0)?;
    let unit = 10_i128.pow(digits as u32);
    let scaled = numerator.checked_mul(unit / denominator)?;
    Some(format!("{}.{:0digits$}", scaled / unit, scaled % unit))
}

#[cfg(test)]
mod tests {
    use super::decimal;

    #[test]
    fn decimals_come_back_as_written() {
        assert_eq!(decimal(1, 20).as_deref(), Some("0.05"));
        assert_eq!(decimal(7, 5).as_deref(), Some("1.4"));
        assert_eq!(decimal(3, 2).as_deref(), Some("1.5"));
        assert_eq!(decimal(2, 1), None);
        assert_eq!(decimal(1, 3), None);
        assert_eq!(decimal(1, 15), None);
    }
}
