//! Computes the content of a sum: the number that can be factored out of all terms.
//!
//! x - y, y - x and 2·x - 2·y have the contents 1, -1 and 2, and one common primitive part. Products and powers are built on
//! primitive parts.

use super::graph::Graph;
use super::node::Term;
use super::number::Number;
use super::rational::{Rational, greatest_common_divisor};

impl Graph {
    /// Returns the content. The primitive part has whole coefficients without a common divisor, the leading one positive. A
    /// common square root belongs to the content.
    ///
    /// Only the sign is factored out of rational coefficients of different magnitude, which keeps sums of a mechanism as
    /// written: x + 3/20·cos φ, not 20·x + 3·cos φ. This also applies to sums with floats, and if the numbers become too large.
    pub(super) fn content(&self, terms: &[Term]) -> Number {
        let first = terms.first().map(|term| term.coefficient.absolute());
        let equal = terms
            .iter()
            .all(|term| Some(term.coefficient.absolute()) == first);
        let divisor = common_divisor(terms).filter(|divisor| equal || !divisor.is_rational());
        let magnitude = divisor.unwrap_or(Number::ONE);
        if self.is_negative_lead(terms) {
            magnitude.neg()
        } else {
            magnitude
        }
    }

    /// True if the leading term is negative. A rational multiple of π leads only if it is the only term, so that a phase shift
    /// does not determine the sign of an angle.
    pub(super) fn is_negative_lead(&self, terms: &[Term]) -> bool {
        let lead = terms
            .iter()
            .find(|term| self.as_phase(term).is_none())
            .or(terms.first());
        lead.is_some_and(|term| term.coefficient.is_negative())
    }

    /// Returns the r of a term r·π with a rational r; `None` for other terms.
    pub(super) fn as_phase(&self, term: &Term) -> Option<Rational> {
        match term.coefficient {
            Number::Exact {
                rational,
                radicand: 1,
            } if term.expr == self.pi() => Some(rational),
            _ => None,
        }
    }
}

/// Returns the greatest positive number of which all coefficients are whole multiples; `None` if it is not exact.
pub(super) fn common_divisor(terms: &[Term]) -> Option<Number> {
    let (mut above, mut below) = (0, 1u128);
    let mut shared_radicand = None;
    let mut same_radicand = true;
    for term in terms {
        let Number::Exact { rational, radicand } = term.coefficient else {
            return None;
        };
        above = greatest_common_divisor(above, rational.numerator().unsigned_abs());
        let denominator = rational.denominator().unsigned_abs();
        below = (below / greatest_common_divisor(below, denominator)).checked_mul(denominator)?;
        same_radicand &= *shared_radicand.get_or_insert(radicand) == radicand;
    }
    Some(Number::Exact {
        rational: Rational::new(i128::try_from(above).ok()?, i128::try_from(below).ok()?)?,
        radicand: if same_radicand { shared_radicand? } else { 1 },
    })
}
