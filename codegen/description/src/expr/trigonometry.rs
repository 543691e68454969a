//! Constructs sine, cosine and their inverses in canonical form.
//!
//! A canonical angle has a positive leading term, and a rational multiple of π in (-1/4, 1/4]. So sin(-u) = -sin u, cos(-u) =
//! cos u and shifts by π/2 are all recognized. Multiples of π/12 give exact surds. Angles of constant vectors are exact on the
//! axes and at multiples of 30° and 45°. Tangent, arcsine, arccosine and arctangent are expressed by sine, cosine and the angle
//! of a vector, without further kinds of nodes.

use super::content::common_divisor;
use super::graph::Graph;
use super::node::{ExprId, Node, Term};
use super::number::Number;
use super::rational::Rational;

/// An angle `u`, decomposed as `±(core + quarters·π/2)`.
struct Angle {
    negative: bool,
    core: ExprId,
    /// Quarter turns modulo 4.
    quarters: i128,
    /// Core in twelfths of π, from 0 to 3; `None` if it is not a whole number of them.
    twelfths: Option<i128>,
}

impl Graph {
    /// Returns the sine of an angle in radians.
    pub fn sin(&mut self, angle: ExprId) -> ExprId {
        if !self.is_finite(angle) {
            return self.not_a_number();
        }
        let angle = self.take_apart(angle);
        let sine = self.sine_of(&angle, angle.quarters);
        if angle.negative {
            self.negate(sine)
        } else {
            sine
        }
    }

    /// Returns the cosine of an angle in radians.
    pub fn cos(&mut self, angle: ExprId) -> ExprId {
        if !self.is_finite(angle) {
            return self.not_a_number();
        }
        let angle = self.take_apart(angle);
        self.sine_of(&angle, angle.quarters + 1)
    }

    /// Returns the tangent, as sine over cosine.
    pub fn tan(&mut self, angle: ExprId) -> ExprId {
        let (sine, cosine) = (self.sin(angle), self.cos(angle));
        self.divide(sine, cosine)
    }

    /// Returns the arcsine, as the angle of (√(1 - x²), x).
    pub fn asin(&mut self, x: ExprId) -> ExprId {
        let across = self.cathetus(x);
        self.atan2(x, across)
    }

    /// Returns the arccosine, as the angle of (x, √(1 - x²)).
    pub fn acos(&mut self, x: ExprId) -> ExprId {
        let across = self.cathetus(x);
        self.atan2(across, x)
    }

    /// Returns the arctangent, as the angle of (1, x).
    pub fn atan(&mut self, x: ExprId) -> ExprId {
        let one = self.one();
        self.atan2(x, one)
    }

    /// Returns the angle of the vector (x, y), in (-π, π]; NaN for the constant zero vector.
    pub fn atan2(&mut self, y: ExprId, x: ExprId) -> ExprId {
        if self.any_non_finite(&[y, x]) {
            return self.not_a_number();
        }
        let (Some(y_value), Some(x_value)) = (self.as_number(y), self.as_number(x)) else {
            return self.intern(Node::Atan2(y, x));
        };
        if let Some((twelfths, denominator)) = exact_direction(y_value, x_value) {
            let Some(turn) = Rational::new(twelfths, denominator) else {
                return self.not_a_number();
            };
            let pi = self.pi();
            return self.scale(Number::rational(turn), pi);
        }
        // Only the ratio matters: 3:4 and 6:8 are one direction.
        let terms = [y_value, x_value].map(|coefficient| Term {
            coefficient,
            expr: self.one(),
        });
        let shrink = common_divisor(&terms).unwrap_or(Number::ONE).recip();
        let (y, x) = (
            self.number(y_value.mul(shrink)),
            self.number(x_value.mul(shrink)),
        );
        self.intern(Node::Atan2(y, x))
    }

    /// Returns √(1 - x²).
    fn cathetus(&mut self, x: ExprId) -> ExprId {
        let square = self.power(x, Rational::integer(2));
        let one = self.one();
        let rest = self.subtract(one, square);
        self.sqrt(rest)
    }

    /// Returns (y, x) of the angle of a vector that is known to be nonzero. The vector qualifies if both components are
    /// constant, if one is a number, or if the length is a number (as in an arcsine). It also qualifies if both consist of
    /// parameters whose defaults give a direction. For others, y/√(x² + y²) would lose the value at the origin.
    fn constant_direction(&mut self, angle: ExprId) -> Option<(ExprId, ExprId)> {
        let Node::Atan2(y, x) = *self.node(angle) else {
            return None;
        };
        let has_number = [y, x]
            .iter()
            .any(|&part| self.as_number(part).is_some_and(|value| !value.is_zero()));
        if has_number || self.is_constant(angle) {
            return Some((y, x));
        }
        let square = self.square_of_length(y, x);
        if self.is_fixed(angle) {
            let nominal = self.constant_value(square);
            return nominal.is_some_and(|value| value > 0.0).then_some((y, x));
        }
        self.as_number(square)
            .is_some_and(|value| !value.is_zero())
            .then_some((y, x))
    }

    fn square_of_length(&mut self, y: ExprId, x: ExprId) -> ExprId {
        let squares = [y, x].map(|part| self.power(part, Rational::integer(2)));
        let square = self.sum(&squares);
        self.tidied(square)
    }

    /// Returns `part / √(x² + y²)`.
    fn over_length(&mut self, part: ExprId, y: ExprId, x: ExprId) -> ExprId {
        let square = self.square_of_length(y, x);
        let reciprocal = self.power(square, -Rational::HALF);
        self.multiply(part, reciprocal)
    }

    fn take_apart(&mut self, angle: ExprId) -> Angle {
        let mut terms = Vec::new();
        self.gather(Number::ONE, angle, &mut terms);
        self.ledger.touch(terms.len());
        let mut negative = self.is_negative_lead(&terms);
        let mut core = if negative { self.negate(angle) } else { angle };
        let phase = terms
            .iter()
            .find_map(|term| self.as_phase(term))
            .map(|phase| if negative { -phase } else { phase });
        let Some((phase, quarters, rest)) =
            phase.and_then(|phase| reduce_phase(phase, terms.len() == 1))
        else {
            return Angle {
                negative,
                core,
                quarters: 0,
                twelfths: (core == self.zero()).then_some(0),
            };
        };
        if rest != phase {
            let pi = self.pi();
            let removed = match rest.checked_sub(phase) {
                Some(difference) => Number::rational(difference),
                None => return self.whole(negative, core),
            };
            core = self.combine(&[(Number::ONE, core), (removed, pi)]);
        }
        let mut twelfths = None;
        let mut quarters = quarters;
        if terms.len() == 1 {
            // For a multiple of π alone, the remainder is made positive, which negates the angle.
            if rest.is_negative() {
                core = self.negate(core);
                negative = !negative;
                quarters = -quarters;
            }
            twelfths = rest
                .absolute()
                .checked_mul(Rational::integer(12))
                .filter(|twelfths| twelfths.is_integer())
                .map(Rational::numerator);
        }
        Angle {
            negative,
            core,
            quarters,
            twelfths,
        }
    }

    /// Returns an angle without reduction.
    fn whole(&self, negative: bool, core: ExprId) -> Angle {
        Angle {
            negative,
            core,
            quarters: 0,
            twelfths: None,
        }
    }

    /// Returns sin(core + quarters·π/2).
    fn sine_of(&mut self, angle: &Angle, quarters: i128) -> ExprId {
        let is_sine = quarters.rem_euclid(2) == 0;
        let value = if let Some(twelfths) = angle.twelfths {
            self.table(if is_sine { twelfths } else { 6 - twelfths })
        } else if let Some((y, x)) = self.constant_direction(angle.core) {
            self.over_length(if is_sine { y } else { x }, y, x)
        } else if is_sine {
            self.intern(Node::Sin(angle.core))
        } else {
            self.intern(Node::Cos(angle.core))
        };
        if quarters.rem_euclid(4) >= 2 {
            self.negate(value)
        } else {
            value
        }
    }

    /// Returns sin(k·π/12) for k from 0 to 6.
    fn table(&mut self, twelfths: i128) -> ExprId {
        let surd = |numerator: i64, denominator: i64, radicand: u128| {
            let rational = Rational::new(i128::from(numerator), i128::from(denominator));
            Number::surd(rational.unwrap_or(Rational::ZERO), radicand)
        };
        let one = self.one();
        match twelfths {
            0 => self.zero(),
            1 => self.combine(&[(surd(1, 4, 6), one), (surd(-1, 4, 2), one)]),
            2 => self.number(surd(1, 2, 1)),
            3 => self.number(surd(1, 2, 2)),
            4 => self.number(surd(1, 2, 3)),
            5 => self.combine(&[(surd(1, 4, 6), one), (surd(1, 4, 2), one)]),
            _ => one,
        }
    }
}

/// Returns `(phase, quarters, rest)` with phase = quarters/2 + rest, in units of π; the quarters are modulo 4.
///
/// Beside a variable, only a whole number of quarter turns, or else of half turns, is split off. So sin(u - π/3) is not
/// rewritten as a cosine. The rest is then in (-1/2, 1/2]. A phase that is `alone` is reduced to (-1/4, 1/4].
fn reduce_phase(phase: Rational, alone: bool) -> Option<(Rational, i128, Rational)> {
    let (quarters, rest) = reduce_by(phase, Rational::HALF)?;
    if alone || rest.is_zero() {
        return Some((phase, quarters.rem_euclid(4), rest));
    }
    let (halves, rest) = reduce_by(phase, Rational::ONE)?;
    Some((phase, halves.checked_mul(2)?.rem_euclid(4), rest))
}

/// Returns `(count, rest)` with phase = count·step + rest and the rest in (-step/2, step/2].
fn reduce_by(phase: Rational, step: Rational) -> Option<(i128, Rational)> {
    let shifted = phase.checked_div(step)?.checked_sub(Rational::HALF)?;
    // The ceiling is the negated floor of the negated value.
    let count = -(-shifted.numerator()).div_euclid(shifted.denominator());
    let rest =
        phase.checked_sub(step.checked_mul(Rational::integer(i64::try_from(count).ok()?))?)?;
    Some((count, rest))
}

/// Returns the angle of (x, y) as a fraction of π, numerator and denominator; `None` if it is not exact, and 0/0 for the zero
/// vector.
fn exact_direction(y: Number, x: Number) -> Option<(i128, i128)> {
    if y.is_zero() || x.is_zero() {
        return Some(match (y.is_zero(), x.is_zero()) {
            (true, true) => (0, 0),
            (true, false) => (i128::from(x.is_negative()), 1),
            _ => (if y.is_negative() { -1 } else { 1 }, 2),
        });
    }
    let slope = y.mul(x.recip()).absolute();
    let root = |numerator, denominator| {
        Rational::new(numerator, denominator).map(|rational| Number::surd(rational, 3))
    };
    let acute = if slope == Number::ONE {
        3
    } else if Some(slope) == root(1, 1) {
        4
    } else if Some(slope) == root(1, 3) {
        2
    } else {
        return None;
    };
    let upper = if x.is_negative() { 12 - acute } else { acute };
    Some((if y.is_negative() { -upper } else { upper }, 12))
}
